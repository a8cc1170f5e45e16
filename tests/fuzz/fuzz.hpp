// SPDX-License-Identifier: MIT
/// What fuzz targets share. A target is a function of bytes with a name:
///
///   const Target target{"tum", [](Input input) { … }};
///
/// It makes files or values of the bytes, calls the library, and holds what comes back against what is documented.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <splinertia/detail/message.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

namespace splinertia::fuzz {

using namespace splinertia::detail;

/// Bytes as values, from the first on. Behind the last byte all values are zero.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : bytes_(reinterpret_cast<const char*>(data), size) {}

  [[nodiscard]] bool empty() const { return bytes_.empty(); }

  /// What is left.
  [[nodiscard]] std::string_view rest() const { return bytes_; }

  /// What is left up to the next '\n', which is dropped.
  [[nodiscard]] std::string_view line() {
    const std::string_view line = bytes_.substr(0, bytes_.find('\n'));
    bytes_.remove_prefix(std::min(line.size() + 1, bytes_.size()));
    return line;
  }

  /// As many bytes as the number has.
  template <typename T>
  [[nodiscard]] T bits() {
    T value{};
    const std::size_t size = std::min(sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return value;
  }

  [[nodiscard]] bool flag() { return (bits<std::uint8_t>() & 1) != 0; }

  /// From `least` to `most`, at most 256 values.
  [[nodiscard]] int integer(int least, int most) { return least + bits<std::uint8_t>() % (most - least + 1); }

  /// From -limit to limit, in steps of 1/32768 of it.
  [[nodiscard]] double moderate(double limit) { return bits<std::int16_t>() * (limit / 32768); }

  /// Mostly moderate, of any size, or one of those that are special: infinite, NaN, the ends of the range.
  [[nodiscard]] double real() {
    using Limits = std::numeric_limits<double>;
    constexpr std::array special{0.0,           -0.0, Limits::denorm_min(), Limits::min(),      Limits::epsilon(),  1.0,
                                 Limits::max(), -1.0, Limits::lowest(),     Limits::infinity(), Limits::quiet_NaN()};
    const int kind = integer(0, 15);
    if (kind < 10) return moderate(kind < 5 ? 1 : 1000);
    if (kind < 12) return moderate(1) * std::pow(10.0, integer(-128, 127));
    if (kind < 14) return bits<double>();
    return special[static_cast<std::size_t>(integer(0, static_cast<int>(special.size()) - 1))];
  }

 private:
  std::string_view bytes_;
};

/// A target, known by its name to the program that it is compiled into.
struct Target {
  Target(const char* name_, void (*run_)(Input)) : name(name_), run(run_) { all().push_back(this); }

  [[nodiscard]] static std::vector<const Target*>& all() {
    static std::vector<const Target*> targets;
    return targets;
  }

  const char* name;
  void (*run)(Input);
};

/// What the library did wrong. Not a std::exception, which the library may throw.
struct Fault {
  std::string text;
};

template <typename... Parts>
void expect(bool good, const Parts&... parts) {
  if (!good) throw Fault{message(parts...)};
}

/// Holds a refusal against what is documented: one of three exceptions, not derived ones, whose text is one line that
/// begins with `subject`.
template <typename Documented>
void expect_refusal(const Documented& error, std::string_view subject) {
  const std::string_view text = error.what();
  expect(typeid(error) == typeid(Documented), "an undocumented exception: ", typeid(error).name(), ": ", text);
  expect(text.size() > subject.size() && text.starts_with(subject), "a message that does not name its subject: ", text);
  for (const char c : text) expect(static_cast<unsigned char>(c) >= ' ', "a message with control characters: ", text);
}

/// Does the work; false if it was refused properly.
template <typename Work>
[[nodiscard]] bool accepted(std::string_view subject, const Work& work) {
  try {
    work();
    return true;
  } catch (const std::runtime_error& error) {
    expect_refusal(error, subject);
  } catch (const std::invalid_argument& error) {
    expect_refusal(error, subject);
  } catch (const std::out_of_range& error) {
    expect_refusal(error, subject);
  }
  return false;
}

}  // namespace splinertia::fuzz
