// SPDX-License-Identifier: MIT
// With assertions on, a time outside the domain ends the program (outside_domain_assert_test.cpp).
#undef NDEBUG
#define NDEBUG
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

template <typename Scalar>
using R1 = Eigen::Matrix<Scalar, 1, 1>;

template <typename Time>
Time tenths(int n) {
  if constexpr (std::floating_point<Time>) {
    return static_cast<Time>(n) / 8;
  } else {
    return Time(n * 1000);
  }
}

/// Knots an eighth of a second (or a thousand ticks) apart; those that may be elsewhere begin and end with empty spans.
template <typename K, int Order>
K knots(std::size_t control_points, bool empty_ends) {
  using Time = typename K::Time;
  if constexpr (requires(K k) { k.interval; }) {
    return {tenths<Time>(0), tenths<Time>(1)};
  } else {
    K result;
    const int last = static_cast<int>(control_points) - Order + 1;
    for (int i = 1 - Order; i < last + Order; ++i) {
      result.knots.push_back(tenths<Time>(empty_ends ? std::clamp(i, 0, last) : i));
    }
    return result;
  }
}

/// Times far outside, infinite and none.
template <typename Time>
std::vector<Time> wild_times() {
  using Limits = std::numeric_limits<Time>;
  if constexpr (std::floating_point<Time>) {
    return {Limits::lowest(),    Limits::max(), -Limits::infinity(), Limits::infinity(),
            Limits::quiet_NaN(), Time(-1e9L),   Time(1e9L),          Time(-1e-30L)};
  } else {
    return {Time::min(), Time::max(), Time::min() + Time(1), Time::max() / 2, Time::min() / 2 - Time(1), Time(-1)};
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Outside its domain a curve goes on as its first and its last segment", "", UniformKnots<double>,
                   UniformKnots<float>, UniformKnots<long double>, UniformKnots<nanoseconds>,
                   UniformKnots<std::chrono::milliseconds>, NonUniformKnots<double>, NonUniformKnots<float>,
                   NonUniformKnots<long double>, NonUniformKnots<nanoseconds>) {
  using K = TestType;
  using Time = typename K::Time;
  using G = R1<double>;
  testing::Random random(1);
  const auto points = random.walk<G>(9, 1);
  for (const bool empty_ends : {false, true}) {
    const Spline<G, 4, K> curve(knots<K, 4>(9, empty_ends), points);
    // Four values of a cubic tell a fifth: Σ (−1)^i C(4, i) x_i = 0.
    const auto goes_on = [&](int from, int step) {
      const double weights[] = {1, -4, 6, -4, 1};
      double sum = 0;
      for (int i = 0; i < 5; ++i)
        sum += weights[i] * curve.template evaluate<0>(tenths<Time>(from + i * step)).value[0];
      return std::abs(sum);
    };
    CHECK(goes_on(1, -1) < 1e-12);  // over the start: two values inside
    CHECK(goes_on(0, -2) < 1e-10);
    CHECK(goes_on(5, 1) < 1e-12);  // over the end, 6
    CHECK(goes_on(6, 2) < 1e-10);
    CHECK(curve.template linearize<2>(tenths<Time>(-1)).first == 0);
    CHECK(curve.template linearize<2>(tenths<Time>(7)).first == 5);
    CHECK(curve.template linearize<2>(tenths<Time>(-1)).value == curve.template evaluate<2>(tenths<Time>(-1)).value);
  }
}

TEMPLATE_TEST_CASE("No time makes a curve read what it does not have", "", UniformKnots<double>, UniformKnots<float>,
                   UniformKnots<long double>, UniformKnots<nanoseconds>, UniformKnots<std::chrono::milliseconds>,
                   NonUniformKnots<double>, NonUniformKnots<float>, NonUniformKnots<long double>,
                   NonUniformKnots<nanoseconds>) {
  using K = TestType;
  using Time = typename K::Time;
  testing::Random random(2);
  const auto check = [&]<typename G, int Order>() {
    for (const std::size_t n : {std::size_t{Order}, std::size_t{Order + 5}}) {
      for (const bool empty_ends : {false, true}) {
        const Spline<G, Order, K> curve(knots<K, Order>(n, empty_ends), random.walk<G>(n, 1));
        const std::size_t first = 0, last = n - Order;
        for (const Time t : wild_times<Time>()) {
          CAPTURE(seconds_or_ticks(t));
          CHECK_FALSE(curve.contains(t));
          CHECK_THROWS_AS(curve.template at<0>(t), std::out_of_range);
          const std::size_t segment = curve.knots().segment(t, n, Order);
          if (t < curve.start()) CHECK(segment == first);
          if (t > curve.end()) CHECK(segment == last);
          CHECK(segment <= last);
          (void)curve.template evaluate<2>(t);
          const Time near = curve.clamp(t);
          CHECK(near == (t > curve.end() ? curve.end() : curve.start()));
          CHECK(curve.template evaluate<0>(near).value.matrix().allFinite());
        }
      }
    }
  };
  check.template operator()<R1<double>, 2>();
  if constexpr (std::same_as<Time, double>) check.template operator()<Sophus::SO3f, 3>();
}

TEST_CASE("Centuries outside the domain a curve in integers goes on in the same direction") {
  const std::vector<R1<double>> line{R1<double>(0), R1<double>(1), R1<double>(2), R1<double>(3)};
  const nanoseconds start{4'000'000'000'000'000'000}, interval{1'000'000'000};
  const Spline<R1<double>, 2, UniformKnots<nanoseconds>> uniform({start, interval}, line);
  const Spline<R1<double>, 2, NonUniformKnots<nanoseconds>> free(
      {{start - interval, start, start + interval, start + 2 * interval, start + 3 * interval, start + 4 * interval}},
      line);
  const auto check = [](const auto& curve) {
    CHECK_THAT(curve.template evaluate<0>(nanoseconds::min()).value[0], WithinRel(-9.223372036854775807e9, 1e-8));
    CHECK_THAT(curve.template evaluate<0>(nanoseconds::max()).value[0], WithinRel(5.223372036854775807e9, 1e-8));
    CHECK(curve.template evaluate<1>(nanoseconds::min()).velocity[0] == 1);
  };
  check(uniform);
  check(free);
}

TEST_CASE("A domain contains its ends, and the nearest of its times to any is inside") {
  const Domain<double> domain{1, 2};
  CHECK(domain.contains(1));
  CHECK(domain.contains(2));
  CHECK_FALSE(domain.contains(std::nextafter(2, 3)));
  CHECK_FALSE(domain.contains(std::nan("")));
  CHECK(domain.clamp(0.5) == 1);
  CHECK(domain.clamp(1.5) == 1.5);
  CHECK(domain.clamp(3) == 2);
  CHECK(domain.clamp(std::nan("")) == 1);
}
