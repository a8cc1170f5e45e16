// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

/// A number as text: the fewest digits, but at least six, that read back to the same value, without trailing zeros.
[[nodiscard]] std::string short_number(double value);

/// One part of a text: a text, a character or a number.
template <typename Part>
[[nodiscard]] std::string part_text(const Part& part) {
  if constexpr (std::convertible_to<const Part&, std::string_view>) {
    return std::string(std::string_view(part));
  } else if constexpr (std::is_same_v<Part, char>) {
    return std::string(1, part);
  } else if constexpr (std::floating_point<Part>) {
    return short_number(static_cast<double>(part));
  } else {
    static_assert(std::integral<Part>);
    return std::to_string(part);
  }
}

/// Joins texts, characters and numbers into one text.
template <typename... Parts>
[[nodiscard]] std::string concat(const Parts&... parts) {
  return (std::string() + ... + part_text(parts));
}
