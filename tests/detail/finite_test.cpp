// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/detail/finite.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEMPLATE_TEST_CASE("A number is finite, infinity and NaN are not", "", float, double, long double) {
  using Limits = std::numeric_limits<TestType>;
  STATIC_CHECK(is_finite(TestType(0)));
  STATIC_CHECK(is_finite(Limits::max()));
  STATIC_CHECK(is_finite(Limits::lowest()));
  STATIC_CHECK(is_finite(Limits::denorm_min()));
  STATIC_CHECK(!is_finite(Limits::infinity()));
  STATIC_CHECK(!is_finite(-Limits::infinity()));
  STATIC_CHECK(!is_finite(Limits::quiet_NaN()));
}

TEST_CASE("Integer times are always finite") {
  STATIC_CHECK(is_finite(std::chrono::nanoseconds::max()));
  STATIC_CHECK(is_finite(std::chrono::milliseconds::min()));
}
