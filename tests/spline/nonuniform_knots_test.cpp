// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/spline/nonuniform_knots.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

TEST_CASE("A knot belongs to the span that it begins, the end to the last span that is not empty") {
  const NonUniformKnots<double> knots{{0, 1, 2, 3, 5, 5, 6, 8, 8, 9, 10, 11}};  // order 4, domain [3, 8]
  constexpr std::size_t n = 8;
  REQUIRE_NOTHROW(knots.check(n, 4));
  CHECK(knots.domain(n, 4).start == 3);
  CHECK(knots.domain(n, 4).end == 8);
  const auto first = [&](double t) { return knots.basis<double, 4, 2>(t, n).first; };
  CHECK(first(3) == 0);
  CHECK(first(std::nextafter(5, 0)) == 0);
  CHECK(first(5) == 2);  // not 1, whose span is empty
  CHECK(first(5.5) == 2);
  CHECK(first(6) == 3);
  CHECK(first(8) == 3);
}

TEST_CASE("A domain that begins and ends with empty spans is that between them") {
  const NonUniformKnots<double> knots{{1, 1, 1, 1, 2, 3, 3, 3, 3}};  // order 3, [1, 3], spans [1, 1] and [3, 3] empty
  REQUIRE_NOTHROW(knots.check(6, 3));
  CHECK(knots.basis<double, 3, 0>(1, 6).first == 1);
  CHECK(knots.basis<double, 3, 0>(1, 6).basis.lambda[0] == std::array<double, 2>{0, 0});
  CHECK(knots.basis<double, 3, 0>(3, 6).first == 2);
  CHECK(knots.basis<double, 3, 0>(3, 6).basis.lambda[0] == std::array<double, 2>{1, 1});
}

TEST_CASE("The search finds the span of every time") {
  NonUniformKnots<double> knots;
  double knot = -3;
  for (std::size_t i = 0; i < 200; ++i) {
    knots.knots.push_back(knot);
    const double gaps[] = {0.0, 1e-9, 0.3, 1e3, 0.1};
    knot += gaps[i * i % 5];
  }
  constexpr std::size_t n = 195;
  REQUIRE_NOTHROW(knots.check(n, 5));
  for (std::size_t i = 4; i < n; ++i) {
    const double a = knots.knots[i], b = knots.knots[i + 1];
    if (a == b) continue;
    for (const double t : {a, a + (b - a) / 2, std::nextafter(b, a)}) {
      CHECK(knots.basis<double, 5, 0>(t, n).first == i - 4);
    }
  }
}

TEST_CASE("Knots in nanoseconds give the same basis at zero and at an epoch of today") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  NonUniformKnots<nanoseconds> zero, now;
  NonUniformKnots<double> seconds;
  for (const std::int64_t ns :
       {0, 10, 1'000, 2'000'000, 3'000'000, 900'000'000, 900'000'001, 901'000'000, 1'500'000'000}) {
    zero.knots.emplace_back(ns);
    now.knots.push_back(epoch + nanoseconds{ns});
    seconds.knots.push_back(static_cast<double>(ns) * 1e-9);
  }
  for (const std::int64_t ns : {2'000'000, 2'000'001, 3'000'000, 123'456'789, 900'000'000}) {
    const auto a = zero.basis<double, 4, 3>(nanoseconds{ns}, 5);
    const auto b = now.basis<double, 4, 3>(epoch + nanoseconds{ns}, 5);
    CHECK(a.first == b.first);
    CHECK(a.basis.lambda == b.basis.lambda);
    CHECK(zero.basis<float, 4, 3>(nanoseconds{ns}, 5).basis.lambda ==
          now.basis<float, 4, 3>(epoch + nanoseconds{ns}, 5).basis.lambda);
    // Seconds are doubles of the same numbers, nearly: knots a nanosecond apart at 0.9 s keep seven digits of it.
    const auto c = seconds.basis<double, 4, 1>(static_cast<double>(ns) * 1e-9, 5);
    for (std::size_t j = 0; j < 3; ++j) CHECK_THAT(a.basis.lambda[0][j], WithinAbs(c.basis.lambda[0][j], 1e-6));
  }
}

TEST_CASE("Knots that are none are refused with the place and the value") {
  const auto why = [](std::vector<double> knots, std::size_t control_points, int order) -> std::string {
    try {
      NonUniformKnots{std::move(knots)}.check(control_points, order);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  CHECK(why({0, 1, 2, 3, 4, 5, 6, 7}, 4, 4) == "accepted");
  CHECK(why({0, 1, 2, 3, 4, 5, 6}, 4, 4) == "NonUniformKnots: 7 knots, expected 8: 4 control points plus the order, 4");
  CHECK(why({}, 4, 4) == "NonUniformKnots: 0 knots, expected 8: 4 control points plus the order, 4");
  CHECK(why({0, 1, nan, 3, 4, 5, 6, 7}, 4, 4) == "NonUniformKnots: knot 2 is nan, expected a finite number");
  CHECK(why({-infinity, 1, 2, 3, 4, 5, 6, 7}, 4, 4) == "NonUniformKnots: knot 0 is -inf, expected a finite number");
  CHECK(why({0, 1, 2, 3, 4, 3.5, 6, 7}, 4, 4) ==
        "NonUniformKnots: knot 5 is 3.5, expected at least 4, the knot before it");
  CHECK(why({0, 1, 2, 3, 3, 5, 6, 7}, 4, 4) ==
        "NonUniformKnots: knots 3 and 4 are both 3, expected a non-empty domain between them");

  // Inside the domain k − 1 coinciding knots are the most, at its ends k and more are fine.
  CHECK(why({0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}, 7, 4) == "accepted");
  CHECK(why({0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}, 8, 4) ==
        "NonUniformKnots: knots 4 to 7 are all 1, which would make the curve discontinuous; expected at most 3 equal "
        "knots inside the domain, the order minus one");
  CHECK(why({0, 1, 2, 2, 3, 4}, 4, 2) ==
        "NonUniformKnots: knots 2 and 3 are both 2, which would make the curve discontinuous; expected at most 1 equal "
        "knots inside the domain, the order minus one");

  NonUniformKnots<nanoseconds> time{{nanoseconds{0}, nanoseconds{2}, nanoseconds{1}, nanoseconds{3}}};
  CHECK_THROWS_WITH(time.check(2, 2), "NonUniformKnots: knot 2 is 1, expected at least 2, the knot before it");
}

TEST_CASE("Knots begin the spans, and control points have the mean time of the knots inside their support") {
  const NonUniformKnots<double> knots{{0, 0, 0, 0, 1, 3, 7, 8, 8, 8, 8}};  // order 4, domain [0, 8]
  CHECK(knots.knot(0, 4) == 0);
  CHECK(knots.knot(2, 4) == 3);
  CHECK(knots.knot(4, 4) == knots.domain(7, 4).end);
  CHECK(knots.control_point_time(0, 4) == 0);
  CHECK_THAT(knots.control_point_time(1, 4), WithinAbs(1. / 3, 1e-15));
  CHECK_THAT(knots.control_point_time(3, 4), WithinAbs(11. / 3, 1e-15));
  CHECK(knots.control_point_time(6, 4) == 8);
  // Σ w_i(t) ξ_i = t: control points on a straight line over these times make the curve run straight.
  for (const double at : {0.0, 0.4, 2.5, 7.9}) {
    const auto place = knots.basis<double, 4, 0>(at, 7);
    double t = knots.control_point_time(place.first, 4);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i = place.first + j;
      t += place.basis.lambda[0][j] * (knots.control_point_time(i + 1, 4) - knots.control_point_time(i, 4));
    }
    CHECK_THAT(t, WithinAbs(at, 1e-14));
  }
  const nanoseconds epoch{1'403'715'524'907'143'168};
  NonUniformKnots<nanoseconds> stamps;
  for (const int ns : {0, 1, 5, 9, 10, 20}) stamps.knots.push_back(epoch + nanoseconds{ns});
  CHECK(stamps.control_point_time(1, 3) == epoch + nanoseconds{7});
  CHECK(stamps.knot(1, 3) == epoch + nanoseconds{9});
}
