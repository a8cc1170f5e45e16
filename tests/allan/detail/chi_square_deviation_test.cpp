// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/chi_square_deviation.hpp>

#include "allan/detail/chi_square_tails.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;

TEST_CASE("Tails of the deviation are those of the normal distribution") {
  for (const double freedom : {1.0, 2.0, 4.0, 7.5, 30.0, 1000.0, 1e6}) {
    // As stated: 13 % for one, 3 % from four on.
    const double tolerance = freedom < 4 ? 0.13 : 0.03;
    for (const double probability : {0.1, 1e-2, 1e-4, 1e-7}) {
      INFO(freedom << " degrees of freedom, probability " << probability);
      const double above = chi_square_deviation(chi_square_upper_quantile(probability, freedom) / freedom, freedom);
      const double below = chi_square_deviation(chi_square_quantile(probability, freedom) / freedom, freedom);
      CHECK(above > 0);
      CHECK(below < 0);
      CHECK_THAT(std::erfc(above / std::numbers::sqrt2) / 2, WithinRel(probability, tolerance));
      CHECK_THAT(std::erfc(-below / std::numbers::sqrt2) / 2, WithinRel(probability, tolerance));
    }
  }
}

TEMPLATE_TEST_CASE("The deviation rises with the ratio, and is finite", "", float, double, long double) {
  using Scalar = TestType;
  for (const Scalar freedom : {Scalar(1), Scalar(50), Scalar(1e6)}) {
    CHECK_THAT(static_cast<double>(chi_square_deviation(Scalar(1), freedom)),
               WithinRel(std::sqrt(2 / static_cast<double>(freedom)) / 3, 1e-6));
    Scalar last = chi_square_deviation(Scalar(0), freedom);
    CHECK(std::isfinite(last));
    for (const double ratio :
         {1e-30, 1e-3, 0.5, 0.937, 0.938, 0.999, 0.99999, 1.0, 1.00001, 1.001, 1.062, 1.063, 2.0, 1e6}) {
      const Scalar next = chi_square_deviation(static_cast<Scalar>(ratio), freedom);
      INFO("ratio " << ratio);
      CHECK(std::isfinite(next));
      CHECK(next > last);
      last = next;
    }
  }
}
