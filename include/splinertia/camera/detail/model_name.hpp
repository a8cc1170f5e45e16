// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <splinertia/detail/cpp20.hpp>
#include <string_view>

namespace splinertia::detail {

/// A string literal as a template argument.
template <std::size_t Size>
struct NamePrefix {
  char text[Size]{};

  constexpr NamePrefix(const char (&literal)[Size]) {
    for (std::size_t i = 0; i < Size; ++i) text[i] = literal[i];
  }
};

/// The prefix followed by Distortion::name, ended by a zero: "pinhole-" and "radtan" make "pinhole-radtan".
template <NamePrefix prefix, typename Distortion>
inline constexpr auto model_name = [] {
  constexpr std::string_view first = prefix.text, second = Distortion::name;
  std::array<char, first.size() + second.size() + 1> text{};
  for (std::size_t i = 0; i < first.size(); ++i) text[i] = first[i];
  for (std::size_t i = 0; i < second.size(); ++i) text[first.size() + i] = second[i];
  return text;
}();

}  // namespace splinertia::detail
