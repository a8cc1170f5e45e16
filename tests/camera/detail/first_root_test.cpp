// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <splinertia/camera/detail/first_root.hpp>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEMPLATE_TEST_CASE("the first positive root of a polynomial", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar most = std::numeric_limits<Scalar>::max(), tolerance = 8 * std::numeric_limits<Scalar>::epsilon();
  const auto root = [&](auto... a) {
    return first_root(std::array<Scalar, sizeof...(a)>{static_cast<Scalar>(a)...}, most);
  };
  CHECK_FALSE(root(1, 2, 3));
  CHECK_FALSE(root(1, -1, 1));
  REQUIRE(root(1, -4));
  CHECK(std::abs(*root(1, -4) - Scalar(0.25)) <= tolerance);
  CHECK(std::abs(*root(6, -11, 6, -1) - 1) <= tolerance);  // (1 − x)(2 − x)(3 − x)
  CHECK(std::abs(*root(1, 0, 0, -8) - Scalar(0.5)) <= tolerance);
  CHECK(std::abs(*root(1e12, -1) / Scalar(1e12) - 1) <= tolerance);
  CHECK(std::abs(*root(1, -1e12) * Scalar(1e12) - 1) <= tolerance);
  CHECK_FALSE(first_root(std::array<Scalar, 2>{1, -1}, Scalar(0.5)));
}
