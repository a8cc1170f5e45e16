// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <splinertia/allan/detail/compensated_sum.hpp>

#include "support/catch.hpp"

using splinertia::allan::detail::CompensatedSum;

namespace {

template <typename Scalar>
constexpr Scalar sum_of(auto... summands) {
  CompensatedSum<Scalar> sum;
  (sum.add(static_cast<Scalar>(summands)), ...);
  return sum.value();
}

}  // namespace

TEMPLATE_TEST_CASE("What an addition rounds away is not lost", "", float, double, long double) {
  using Scalar = TestType;
  constexpr Scalar big = 2 / std::numeric_limits<Scalar>::epsilon(), huge = big * big;
  CHECK(CompensatedSum<Scalar>{}.value() == 0);
  STATIC_CHECK(sum_of<Scalar>(big, 1, -big) == 1);
  STATIC_CHECK(sum_of<Scalar>(1, big, 1, -big) == 2);  // where Kahan's sum is 0 or 1
  STATIC_CHECK(sum_of<Scalar>(-big, 3, big, 4) == 7);
  CHECK(sum_of<Scalar>(1, huge, 1, -huge) == 2);
}

TEMPLATE_TEST_CASE("The error of a sum does not grow with its length", "", float, double, long double) {
  using Scalar = TestType;
  constexpr int n = 1'000'000;
  // Multiples of 2^−20 of 20 bits: all sums of them are integers in this unit, far beyond what float can hold.
  std::mt19937_64 bits(5);
  const Scalar unit = std::ldexp(Scalar(1), -20);
  CompensatedSum<Scalar> positive, alternating;
  std::int64_t exact_positive = 0, exact_alternating = 0;
  for (int i = 0; i < n; ++i) {
    const auto x = static_cast<std::int64_t>(bits() >> 44);
    const std::int64_t sign = i % 2 == 0 ? 1 : -1;
    exact_positive += x;
    exact_alternating += sign * x;
    positive.add(static_cast<Scalar>(x) * unit);
    alternating.add(static_cast<Scalar>(sign * x) * unit);
  }
  CHECK(positive.value() == static_cast<Scalar>(exact_positive) * unit);
  CHECK(alternating.value() == static_cast<Scalar>(exact_alternating) * unit);
}
