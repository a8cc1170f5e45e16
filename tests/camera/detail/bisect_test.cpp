// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/camera/detail/bisect.hpp>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEMPLATE_TEST_CASE("bisection finds neighbouring numbers in any interval", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  for (const Scalar root : {Scalar(1e-6), Scalar(0.3), Scalar(1), Scalar(7), Scalar(1e30)}) {
    int calls = 0;
    const auto f = [&](const Scalar& x) {
      ++calls;
      return root - x;
    };
    const Scalar found = bisect<Scalar>(f, 0, std::numeric_limits<Scalar>::max());
    CHECK(std::abs(found - root) <= 2 * eps * root);
    CHECK(calls < 120);
  }
}
