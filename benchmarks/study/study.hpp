// SPDX-License-Identifier: MIT
/// The speed/accuracy study: its parts, and what they share. A part measures one thing on this machine and writes one
/// csv file; benchmarks/study.py makes plots and docs/speed_and_accuracy.md of them.
#pragma once

#include <time.h>  // clock_gettime

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace study {

struct Options {
  std::filesystem::path output;  // folder that PART.csv is written into
  int repetitions = 5;           // of every time
  bool quick = false;            // seconds instead of minutes: to see that it works
  std::filesystem::path data;    // ground truth of a real motion, csv as EuRoC has it or TUM; empty: none
};

// The parts. Each writes options.output/NAME.csv and says on stderr how far it is. They throw std::runtime_error or
// std::invalid_argument with a message for people.
void representation(const Options& options);
void integrators(const Options& options);
void error_terms(const Options& options);
void allan(const Options& options);

/// One line on stderr.
template <typename... Parts>
void progress(const Parts&... parts) {
  std::fputs((splinertia::detail::message(parts...) + '\n').c_str(), stderr);
}

/// A csv file, there when it is complete (commit()) or not at all. Doubles with six digits, which is more than they are
/// good for; an optional that has no value is an empty cell. Texts may have no comma.
///
///   Table table(options.output / "allan.csv", {"grid", "ns_min", "coverage"});
///   table.row("octaves", 0.25, std::optional<double>());
///   table.commit();
class Table {
 public:
  Table(const std::filesystem::path& path, std::initializer_list<std::string_view> columns)
      : file_(path), columns_(columns.size()) {
    char separator = 0;
    for (const std::string_view column : columns) {
      if (separator) file_.append(separator);
      file_.append(column);
      separator = ',';
    }
    file_.append('\n');
  }

  template <typename... Cells>
  void row(const Cells&... cells) {
    if (sizeof...(cells) != columns_) {
      throw std::logic_error(splinertia::detail::message("Table: ", sizeof...(cells), " cells, expected ", columns_));
    }
    std::size_t column = 0;
    (((column++ > 0 ? file_.append(',') : void()), append(cells)), ...);
    file_.append('\n');
  }

  void commit() { file_.commit(); }

 private:
  void append(std::string_view text) { file_.append(text); }
  void append(std::floating_point auto value) {
    const auto real = static_cast<double>(value);
    if (!std::isfinite(real)) file_.refuse(real);
    char text[32];
    file_.append(std::string_view(
        text, static_cast<std::size_t>(
                  std::to_chars(text, text + sizeof text, real, std::chars_format::general, 6).ptr - text)));
  }
  void append(std::integral auto value) { file_.append_integer(static_cast<std::int64_t>(value)); }
  template <typename T>
  void append(const std::optional<T>& value) {
    if (value) append(*value);
  }

  splinertia::AtomicFile file_;
  std::size_t columns_;
};

/// Makes the compiler believe that somebody reads *value.
inline void keep(const auto& value) { asm volatile("" : : "r"(&value) : "memory"); }

/// Does so many times, one after the other, what is measured.
using Kernel = std::function<void(std::size_t calls)>;

struct Times {
  double min = 0, median = 0, max = 0;  // ns a call
};

/// CPU time of this process: what else runs on the machine disturbs it less than a clock on the wall.
[[nodiscard]] inline std::chrono::nanoseconds cpu_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Times of several kernels in turn, so that what else the machine does meets all of them. Each is called so often that
/// a repetition takes at least `least`.
inline std::vector<Times> paired(const std::vector<Kernel>& kernels, int repetitions,
                                 std::chrono::nanoseconds least = std::chrono::milliseconds(5)) {
  const auto duration = [](const Kernel& kernel, std::size_t calls) {
    const auto start = cpu_time();
    kernel(calls);
    return cpu_time() - start;
  };
  std::vector<std::size_t> calls;
  for (const Kernel& kernel : kernels) {
    std::size_t enough = 1;
    while (duration(kernel, enough) < least) enough *= 2;
    calls.push_back(enough);
  }
  std::vector<std::vector<double>> times(kernels.size());
  for (int repetition = 0; repetition < std::max(repetitions, 1); ++repetition) {
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      times[k].push_back(static_cast<double>(duration(kernels[k], calls[k]).count()) / static_cast<double>(calls[k]));
    }
  }
  std::vector<Times> result;
  for (auto& t : times) {
    std::sort(t.begin(), t.end());
    result.push_back({t.front(), t[t.size() / 2], t.back()});
  }
  return result;
}

/// Root mean square and largest of what it is given.
class ErrorStatistics {
 public:
  void add(double error) {
    squares_ += error * error;
    max_ = std::max(max_, std::abs(error));
    ++count_;
  }
  [[nodiscard]] double rms() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0; }
  [[nodiscard]] double max() const { return max_; }

 private:
  double squares_ = 0, max_ = 0;
  std::size_t count_ = 0;
};

}  // namespace study
