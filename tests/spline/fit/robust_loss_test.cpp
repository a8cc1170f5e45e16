// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/spline/fit/robust_loss.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEMPLATE_TEST_CASE("The weight of a loss is the derivative of its cost", "", double, long double) {
  using Scalar = TestType;
  for (const RobustLoss& loss : {RobustLoss::squares(), RobustLoss::huber(), RobustLoss::huber(0.3),
                                 RobustLoss::cauchy(), RobustLoss::cauchy(10)}) {
    for (const double square : {1e-3, 0.08, 0.5, 1.7, 1.9, 30.0, 1e6}) {
      INFO("square " << square);
      // Central differences: truncation 1e-8 relative, rounding 1e-16/1e-4.
      const auto s = static_cast<Scalar>(square), h = s / 10000;
      const Scalar slope = (loss.cost(s + h) - loss.cost(s - h)) / (2 * h);
      CHECK(std::abs(slope - loss.weight(s)) <= Scalar(1e-7) * loss.weight(s));
    }
    CHECK(loss.cost(Scalar(0)) == 0);
    CHECK(loss.weight(Scalar(0)) == 1);
  }
}

TEST_CASE("What each loss costs") {
  CHECK(RobustLoss::squares().cost(9.0) == 9);
  CHECK(RobustLoss::squares().weight(1e9) == 1);
  CHECK(RobustLoss::huber(2).cost(4.0) == 4);       // squares up to the limit
  CHECK(RobustLoss::huber(2).cost(25.0) == 2 * 8);  // 2·limit·r − limit², linear beyond
  CHECK(RobustLoss::huber(2).weight(25.0) == 2. / 5);
  CHECK_THAT(RobustLoss::cauchy(2).cost(4 * (std::exp(1.0) - 1)), WithinRel(4.0, 1e-15));
  CHECK(RobustLoss::cauchy(2).weight(12.0) == 0.25);
  // Outliers pull by r·weight: not at all in the end, or like one at the limit.
  CHECK(1e6 * RobustLoss::cauchy(2).weight(1e12) < 1e-5);
  CHECK_THAT(1e6 * RobustLoss::huber(2).weight(1e12), WithinRel(2.0, 1e-15));
  CHECK(RobustLoss::squares().is_squares());
  CHECK_FALSE(RobustLoss::huber().is_squares());
  CHECK_FALSE(RobustLoss::cauchy().is_squares());
}

TEST_CASE("A limit that is none is refused") {
  CHECK_THROWS_WITH(RobustLoss::huber(0), "RobustLoss: limit is 0, expected a finite number > 0");
  CHECK_THROWS_WITH(RobustLoss::cauchy(-1), "RobustLoss: limit is -1, expected a finite number > 0");
  CHECK_THROWS_AS(RobustLoss::huber(std::nan("")), std::invalid_argument);
  CHECK_THROWS_AS(RobustLoss::cauchy(std::numeric_limits<double>::infinity()), std::invalid_argument);
}
