// SPDX-License-Identifier: MIT
#include <array>
#include <splinertia/io/table_layout.hpp>
#include <string_view>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("the names of the columns make a line of the table") {
  static constexpr std::array<std::string_view, 3> columns{"t [s]", "x", "y"};
  TableLayout layout{.format = "points",
                     .columns = columns,
                     .fewest_columns = 3,
                     .stamp = TableLayout::Stamp::seconds,
                     .separator = ',',
                     .header = true};
  CHECK(layout.names() == "t [s],x,y");
  layout.separator = ' ';
  CHECK(layout.names() == "t [s] x y");
}
