// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace splinertia {

/// How a format lays out a table whose rows are a time and some numbers. The first column is the time.
/// Objects are `const`, not `constexpr`: g++ finds std::span not to be constant where its debug mode checks the pointer
/// under -fsanitize=undefined.
struct TableLayout {
  enum class Stamp { seconds, nanoseconds };

  std::string_view format;                    // as it is called in messages
  std::span<const std::string_view> columns;  // their names
  std::size_t fewest_columns;                 // rows may end after this many, all rows alike
  Stamp stamp;
  char separator;  // ' ' takes blanks only; ',' takes commas or blanks
  bool header;     // whether a writer begins with a line "#names"

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
