// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <type_traits>

namespace splinertia::detail {

/// One part of a message as text, independent of the global locale. A floating-point number gets only as many digits as
/// it takes to read back the same value.
template <typename Part>
[[nodiscard]] std::string message_part(const Part& part) {
  std::string result;
  int digits = 6;
  bool exact = false;
  while (!exact) {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << part;
    result = text.str();
    if constexpr (std::is_floating_point_v<Part>) {
      Part read{};
      text >> read;  // libc++ reads a subnormal number, but reports it as out of range
      exact = read == part || ++digits > std::numeric_limits<Part>::max_digits10;
    } else {
      exact = true;
    }
  }
  return result;
}

/// Joins its arguments into one text, mostly that of an error.
template <typename... Parts>
[[nodiscard]] std::string message(const Parts&... parts) {
  return (std::string() + ... + message_part(parts));
}

}  // namespace splinertia::detail
