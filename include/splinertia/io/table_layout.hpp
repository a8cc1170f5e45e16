// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace splinertia {

/// The layout of a table whose rows are a time, in the first column, and some numbers.
/// Objects are `const`, not `constexpr`: under -fsanitize=undefined g++ does not accept a std::span as constant where
/// its debug mode checks the pointer.
struct TableLayout {
  enum class Stamp { seconds, nanoseconds };

  std::string_view format;                    // its name in messages
  std::span<const std::string_view> columns;  // their names
  std::size_t fewest_columns;                 // rows may have only this many, if all do
  Stamp stamp;
  char separator;  // ' ' accepts blanks only; ',' accepts commas or blanks
  bool header;     // whether writers begin with a line "#names"

  /// The names of the columns as a line of the table: "t tx ty …".
  [[nodiscard]] std::string names() const {
    std::string text;
    for (const std::string_view name : columns) {
      if (!text.empty()) text += separator;
      text += name;
    }
    return text;
  }
};

}  // namespace splinertia
