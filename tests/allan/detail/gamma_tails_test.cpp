// SPDX-License-Identifier: MIT
// The accuracy against 50 digits is tested through the chi-square distribution: chi_square_test.cpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/allan/detail/gamma_tails.hpp>

#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;

TEMPLATE_TEST_CASE("The tails of neighbouring shapes differ by the density", "", double, long double) {
  const TestType epsilon = std::numeric_limits<TestType>::epsilon();
  // P(a, x) = P(a + 1, x) + x^a e^-x/Γ(a + 1): across series, continued fraction and, from a = 30 on, the expansion.
  for (TestType a : {TestType(0.1L), TestType(1), TestType(7.5L), TestType(29.5L), TestType(30), TestType(400)}) {
    for (TestType part : {TestType(0.3L), TestType(0.9L), TestType(1), TestType(1.2L), TestType(2)}) {
      const TestType x = a * part;
      INFO("a = " << a << ", x = " << x);
      const GammaTails<TestType> here = gamma_tails(a, x), next = gamma_tails(a + 1, x);
      const TestType tolerance = 200 * epsilon * (1 + std::abs(a - x));  // the condition of x
      CHECK(std::abs(here.lower - next.lower - gamma_prefactor(a, x)) <= tolerance * here.lower);
      CHECK(std::abs(next.upper - here.upper - gamma_prefactor(a, x)) <= tolerance * next.upper);
      CHECK(std::abs(here.lower + here.upper - 1) <= 4 * epsilon);
    }
  }
}

TEST_CASE("The quantile is the inverse of the tails") {
  for (double a : {0.05, 0.5, 3.0, 29.9, 30.1, 5e4}) {
    for (double probability : {1e-12, 1e-3, 0.2, 0.5}) {
      INFO("a = " << a << ", probability " << probability);
      const double lower = gamma_quantile(a, probability, false), upper = gamma_quantile(a, probability, true);
      CHECK_THAT(gamma_tails(a, upper).upper, WithinRel(probability, 1e-13 * std::max(1.0, std::sqrt(a))));
      if (lower > 1e-300)
        CHECK_THAT(gamma_tails(a, lower).lower, WithinRel(probability, 1e-13 * std::max(1.0, std::sqrt(a))));
      CHECK(lower <= upper * (1 + 1e-14));
    }
  }
}
