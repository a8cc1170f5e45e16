// SPDX-License-Identifier: MIT
/// Knots as far apart and as near together as numbers go: right, or refused.
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/sample.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

template <typename Scalar>
using R1 = Eigen::Matrix<Scalar, 1, 1>;

template <typename Scalar>
std::vector<R1<Scalar>> line(int count) {
  std::vector<R1<Scalar>> points;
  for (int i = 0; i < count; ++i) points.emplace_back(static_cast<Scalar>(i));
  return points;
}

/// Order + Order knots: one span from `start` to `end`.
template <typename Time>
NonUniformKnots<Time> one_span(int order, Time start, Time end) {
  NonUniformKnots<Time> knots;
  knots.knots.assign(static_cast<std::size_t>(order), start);
  knots.knots.insert(knots.knots.end(), static_cast<std::size_t>(order), end);
  return knots;
}

}  // namespace

TEST_CASE("Spans that overflow, or whose reciprocal does, are refused") {
  using testing::message_of;
  CHECK(message_of([] { one_span(8, -1.7e308, 1.7e308).check(8, 8); }) ==
        "NonUniformKnots: knots from -1.7e+308 to 1.7e+308 span more seconds than their time type can represent");
  CHECK(message_of([] { one_span(8, 0.0, 1e308).check(8, 8); }) ==
        "NonUniformKnots: knots span 1e+308 s, expected at most 4.49423283715579e+307 s");
  CHECK(message_of([] { one_span(2, 0.0, 1e-309).check(2, 2); }) ==
        "NonUniformKnots: the shortest span is 1e-309 s, expected at least 1.7800590868057611e-307 s");
  CHECK(message_of([] { UniformKnots{0.0, 1e-309}.check(4, 4); }) ==
        "UniformKnots: the shortest span is 1e-309 s, expected at least 1.7800590868057611e-307 s");
  CHECK(message_of([] { UniformKnots{-1e308, 0.5e308}.check(6, 4); }) ==
        "UniformKnots: knots span 1.5e+308 s, expected at most 4.49423283715579e+307 s");
  // The numbers of a curve may hold less than its time does.
  CHECK_NOTHROW(one_span(4, 0.0, 1e-50).check(4, 4));
  CHECK_THROWS_AS(one_span(4, 0.0, 1e-50).check<float>(4, 4), std::invalid_argument);
  CHECK_THROWS_AS((Spline<R1<float>, 4, NonUniformKnots<double>>(one_span(4, 0.0, 1e-50), line<float>(4))),
                  std::invalid_argument);
  CHECK_THROWS_AS((Spline<R1<float>, 4>({0, 1e-50}, line<float>(4))), std::invalid_argument);
  CHECK_THROWS_AS((Spline<R1<double>, 4, NonUniformKnots<long double>>(one_span(4, 0.0L, 1e-400L), line<double>(4))),
                  std::invalid_argument);
}

TEMPLATE_TEST_CASE("Spans up to the limits give the value, and a velocity that is finite", "", float, double,
                   long double) {
  using Time = TestType;
  using Limits = std::numeric_limits<Time>;
  const auto check = [](const auto& curve) {
    constexpr int order = std::remove_cvref_t<decltype(curve)>::order;
    // Control points 0, 1, … of one span: at its ends the first and the last of knots that coincide, in the middle
    // half.
    const Time middle = curve.start() + (curve.end() - curve.start()) / 2;
    CHECK(std::abs(curve.template evaluate<0>(middle).value[0] - Time(order - 1) / 2) <= 8 * Limits::epsilon());
    for (const Time t : {curve.start(), middle, curve.end()}) {
      CHECK(std::isfinite(curve.template at<1>(t).velocity[0]));
      CHECK(std::isfinite(curve.template at<0>(t).value[0]));
    }
  };
  const auto check_order = [&]<int Order>() {
    for (const Time length : {8 * Limits::min(), Time(1), 1 / Limits::min()}) {
      const auto points = line<Time>(Order);
      const Spline<R1<Time>, Order, NonUniformKnots<Time>> free(one_span<Time>(Order, 0, length), points);
      check(free);
      CHECK(free.template evaluate<0>(free.start()).value[0] == 0);
      CHECK(std::abs(free.template evaluate<0>(free.end()).value[0] - Time(Order - 1)) <= 8 * Limits::epsilon());
      check(Spline<R1<Time>, Order, UniformKnots<Time>>({0, length}, points));
    }
  };
  check_order.template operator()<2>();
  check_order.template operator()<4>();
  check_order.template operator()<8>();
}

TEST_CASE("Integer knots that span more than 64 bits are refused") {
  CHECK(
      testing::message_of([] { one_span(2, nanoseconds::min(), nanoseconds::max()).check(2, 2); }) ==
      "NonUniformKnots: knots from -9223372036854775808 to 9223372036854775807 span more ticks than 64 bits can count");
  const nanoseconds most = nanoseconds::max();
  CHECK_NOTHROW(one_span(2, nanoseconds{-1}, most - nanoseconds{1}).check(2, 2));
  CHECK_THROWS_AS((UniformKnots{nanoseconds::min(), most}.check(4, 2)), std::invalid_argument);
  CHECK_NOTHROW(UniformKnots{nanoseconds::min(), most}.check(2, 2));
  CHECK_THROWS_AS((UniformKnots{nanoseconds::min(), nanoseconds{1000}}.control_point_time(0, 8)), std::out_of_range);
}

TEST_CASE("Samples at the last of all nanoseconds") {
  const nanoseconds most = nanoseconds::max(), interval{1000};
  const Spline<R1<double>, 2, UniformKnots<nanoseconds>> curve({most - 3 * interval, interval}, line<double>(4));
  const auto samples = sample<1>(curve, curve.start(), interval, 4);
  CHECK(samples[3].value[0] == 3);
  CHECK_THROWS_AS(sample<1>(curve, curve.start(), interval, 5), std::out_of_range);
  CHECK_THROWS_WITH(sample<1>(curve, curve.start(), most, 1'000'000'000'000),
                    "sample: 1000000000000 samples 9223372036854775807 apart, starting at 9223372036854772807, exceed "
                    "the largest representable time");
}
