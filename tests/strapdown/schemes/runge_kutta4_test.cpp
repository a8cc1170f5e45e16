// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "strapdown/stamp_patterns.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("Runge and Kutta's method converges with order 2 on interpolated samples") {
  testing::check_order<RungeKutta4>(2, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<RungeKutta4>(2);
  CHECK(testing::aggressive_error<RungeKutta4>(testing::regular_stamps(200)) < 0.5);
}

TEST_CASE("Runge and Kutta's method converges with order 4 over two intervals, equal or not") {
  testing::check_order<RungeKutta4DoubleStep>(4, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<RungeKutta4DoubleStep>(4);
  CHECK(testing::aggressive_error<RungeKutta4DoubleStep>(testing::regular_stamps(200)) < 7.5e-4);
}

TEST_CASE("A single interval at the end of double steps keeps order 4") {
  const auto odd = [](double rate) {
    auto stamps = testing::regular_stamps(rate);
    stamps.pop_back();
    return stamps;
  };
  testing::check_order<RungeKutta4DoubleStep>(4, odd);
}

TEST_CASE("A double step's middle comes from the cubic through four samples") {
  // A body that does not turn, with a cubic force: Simpson's rule is exact for its velocity.
  using Sample = ImuSample<>;
  const auto at = [](double t) { return Sample{t, {0, 0, 0}, {1 + t * (2 + t * (3 - 5 * t)), 0, 0}}; };
  const auto velocity = [](double t) { return t + t * t + t * t * t - 1.25 * t * t * t * t; };
  const std::array<Sample, 4> window{at(0.1), at(0.4), at(0.6), at(1)};
  for (const auto& [from, end] : {std::pair<std::size_t, std::size_t>{0, 2}, {1, 3}, {2, 3}}) {
    const auto step = step_increment<RungeKutta4DoubleStep, double>(window, from);
    CHECK(step.interval == window[end].time - window[from].time);
    CHECK_THAT(step.velocity.x(), WithinAbs(velocity(window[end].time) - velocity(window[from].time), 1e-14));
  }
}

TEMPLATE_TEST_CASE("Double steps are off by at most twice as much as Midpoint, whatever the stamps", "", float,
                   double) {
  testing::check_never_amplifies<RungeKutta4DoubleStep, Midpoint, TestType>();
}
