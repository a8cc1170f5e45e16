// SPDX-License-Identifier: MIT
#include <splinertia/detail/flatten.hpp>

#include "support/catch.hpp"

TEST_CASE("Flattening changes nothing but the code") {
  int calls = 0;
  const auto f = [&] { return ++calls * 2.5; };
  CHECK(splinertia::detail::flattened<double>(f) == 2.5);
  CHECK(splinertia::detail::flattened<int>(f) == 5.0);  // not a floating-point scalar: called as it is
}
