// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/camera/detail/increasing_inverse.hpp>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEMPLATE_TEST_CASE("the inverse of a radial function, in few steps", "", float, double, long double) {
  using Scalar = TestType;
  int calls = 0;
  // x − x³/3 increases up to x = 1.
  const auto f = [&](const Scalar& x, Scalar& slope) {
    ++calls;
    slope = 1 - x * x;
    return x * (1 - x * x / 3);
  };
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  int most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Scalar y = static_cast<Scalar>(i) * Scalar(2) / 3000;
    calls = 0;
    const Scalar x = increasing_inverse<Scalar>(f, y, 0, 1, y);
    most = (std::max)(most, calls);
    Scalar slope;
    CHECK(std::abs(f(x, slope) - y) <= 2 * eps * y);
  }
  CHECK(most <= 12);
}

TEST_CASE("an inverse where the function overflows on the way") {
  const auto f = [](const double& x, double& slope) {
    slope = 1 + 5 * x * x * x * x;
    return x + x * x * x * x * x;
  };
  const double most = std::numeric_limits<double>::max();
  const double x = increasing_inverse<double>(f, 1e200, 0, most, 1e200);
  CHECK(std::abs(x / 1e40 - 1) < 1e-15);
}
