// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/camera/detail/sine_defect.hpp>

#include "support/catch.hpp"

TEMPLATE_TEST_CASE("(x − sin x)/x³ keeps its digits", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar tolerance = 4 * std::numeric_limits<Scalar>::epsilon();
  CHECK(std::abs(splinertia::detail::sine_defect<Scalar>(0) * 6 - 1) <= tolerance);
  for (Scalar x = Scalar(0.8F); x * x <= 2; x += Scalar(0.01F)) {
    // The difference itself loses 3 bits here.
    CHECK(std::abs(splinertia::detail::sine_defect<Scalar>(x * x) - (x - std::sin(x)) / (x * x * x)) <= tolerance);
  }
}
