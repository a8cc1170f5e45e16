// SPDX-License-Identifier: MIT
/// From the order in a table to the order as a template parameter.
#pragma once

#include "golden_grade.hpp"

namespace golden {

/// Calls f.operator()<Order>() for the order in column k; orders other than 2 to 8 are noted and left out.
template <typename F>
void for_order(const Row& row, Report& report, const F& f) {
  const int order = row.integer("k");
  const bool done = [&]<int... Offset>(std::integer_sequence<int, Offset...>) {
    return ((order == Offset + 2 && (f.template operator()<Offset + 2>(), true)) || ...);
  }(std::make_integer_sequence<int, 7>{});
  if (!done)
    report.note(row.table().name(), "row " + row.text("id") + ": order " + row.text("k") + " is not supported");
}

}  // namespace golden
