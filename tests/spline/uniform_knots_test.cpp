// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/spline/uniform_knots.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

TEST_CASE("A time in seconds falls into the segment that holds it, to the last bit") {
  // Dividing rounds: floor(t/0.1) is wrong for dozens of t = m/10. What counts is where the time lies, so u must be in
  // [0, 1] and give the time back.
  const UniformKnots<double> knots{.start = 0.0, .interval = 0.1};
  for (int m = 0; m <= 1000; ++m) {
    for (const double t : {m * 0.1, std::nextafter(m * 0.1, 0.0), m / 10.0}) {
      if (t > knots.domain(1001, 2).end) continue;
      const auto [first, basis] = knots.basis<double, 2, 0>(t, 1001);
      const double u = basis.lambda[0][0];
      CHECK(u >= 0);
      CHECK(u <= 1);
      CHECK(std::abs((static_cast<double>(first) + u) * 0.1 - t) <= 2 * std::numeric_limits<double>::epsilon() * t);
    }
  }
}

TEST_CASE("The end belongs to the last segment") {
  const UniformKnots<double> knots{.start = -3.0, .interval = 0.3};
  const auto [first, basis] = knots.basis<double, 2, 0>(knots.domain(8, 2).end, 8);
  CHECK(first == 6);
  // The end is start + 7 intervals rounded, by eps of the start's size, which the interval divides.
  CHECK_THAT(basis.lambda[0][0], WithinAbs(1.0, 2 * std::numeric_limits<double>::epsilon() * 3 / 0.3));
}

TEST_CASE("Nanoseconds at an epoch of today lose nothing") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const nanoseconds interval{50'000'000};
  const UniformKnots at_zero{nanoseconds{0}, interval};
  const UniformKnots at_epoch{epoch, interval};
  for (const std::int64_t t : {0LL, 1LL, 49'999'999LL, 50'000'000LL, 123'456'789LL, 5'000'000'000LL}) {
    const auto zero = at_zero.basis<double, 4, 2>(nanoseconds{t}, 103);
    const auto now = at_epoch.basis<double, 4, 2>(epoch + nanoseconds{t}, 103);
    CHECK(zero.first == now.first);
    CHECK(zero.basis.lambda == now.basis.lambda);
  }
  CHECK(at_epoch.domain(103, 4).start == epoch);
  CHECK(at_epoch.domain(103, 4).end == epoch + nanoseconds{5'000'000'000});
}

TEST_CASE("Knots that are none are refused with the value") {
  CHECK_THROWS_WITH((UniformKnots{0.0, 0.0}.check(4, 4)),
                    "UniformKnots: interval is 0, expected a positive finite number");
  CHECK_THROWS_WITH((UniformKnots{0.0, -0.5}.check(4, 4)),
                    "UniformKnots: interval is -0.5, expected a positive finite number");
  CHECK_THROWS_AS((UniformKnots{0.0, std::nan("")}.check(4, 4)), std::invalid_argument);
  CHECK_THROWS_AS((UniformKnots{std::nan(""), 1.0}.check(4, 4)), std::invalid_argument);
  CHECK_THROWS_AS((UniformKnots{nanoseconds{0}, nanoseconds{0}}.check(4, 4)), std::invalid_argument);
  CHECK_THROWS_WITH((UniformKnots{1e308, 1e308}.check(5, 4)),
                    "UniformKnots: 2 segments of 1e+308 starting at 1e+308 exceed the largest representable time");
  const nanoseconds year{31'556'952'000'000'000};
  CHECK_NOTHROW(UniformKnots{nanoseconds{0}, year}.check(292, 2));  // int64 nanoseconds hold 292 years
  CHECK_THROWS_AS((UniformKnots{nanoseconds{0}, year}.check(300, 2)), std::invalid_argument);
  CHECK_THROWS_AS((UniformKnots{50 * year, year}.check(292, 2)), std::invalid_argument);
  CHECK_NOTHROW(UniformKnots{-50 * year, year}.check(292, 2));
}

TEST_CASE("Knots closer than time can tell apart are refused") {
  CHECK_THROWS_WITH(
      (UniformKnots<double>{1.4e9, 1e-9}.check(10, 4)),
      "UniformKnots: interval is 1e-09 s, but times near 1.4e+09 s have a resolution of 3.1086244689504383e-07 s; "
      "expected a longer interval or an integer time type");
  CHECK_NOTHROW(UniformKnots<double>{1.4e9, 1e-3}.check(10, 4));
  CHECK_NOTHROW(UniformKnots<double>{0, 1e-300}.check(10, 4));
  CHECK_NOTHROW(UniformKnots<nanoseconds>{nanoseconds{1'400'000'000'000'000'000}, nanoseconds{1}}.check(10, 4));
}

TEST_CASE("Knots begin the segments, and control points have a time") {
  const UniformKnots<double> knots{2, 0.5};
  CHECK(knots.knot(0, 4) == knots.domain(9, 4).start);
  CHECK(knots.knot(3, 4) == 3.5);
  CHECK(knots.knot(6, 4) == knots.domain(9, 4).end);
  // Even orders have them at knots, as the drawing shows, odd ones between; the first and last are outside.
  CHECK(knots.control_point_time(0, 4) == 1.5);
  CHECK(knots.control_point_time(1, 4) == 2);
  CHECK(knots.control_point_time(8, 4) == 5.5);
  CHECK(knots.control_point_time(1, 3) == 2.25);
  CHECK(knots.control_point_time(0, 2) == 2);
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const UniformKnots stamps{epoch, nanoseconds{50'000'001}};
  CHECK(stamps.knot(7, 4) == epoch + nanoseconds{350'000'007});
  CHECK(stamps.control_point_time(0, 4) == epoch - nanoseconds{50'000'001});
  CHECK(stamps.control_point_time(8, 4) == epoch + nanoseconds{350'000'007});
  // Control points on a straight line over these times make the curve run straight: Σ w_i(t) ξ_i = t.
  const auto place = knots.basis<double, 5, 0>(3.3, 9);
  double t = knots.control_point_time(place.first, 5);
  for (std::size_t j = 0; j < 4; ++j) t += place.basis.lambda[0][j] * 0.5;
  CHECK_THAT(t, WithinAbs(3.3, 1e-14));
}
