// SPDX-License-Identifier: MIT
/// Evaluation at knots and at the ends of the domain, and one unit in the last place beside them.
#include <chrono>
#include <string>

#include "extremes.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace extremes;
using std::chrono::nanoseconds;

namespace {

template <typename Time>
Time next(Time t, int direction) {
  if constexpr (std::floating_point<Time>) {
    return std::nextafter(
        t, direction > 0 ? std::numeric_limits<Time>::infinity() : -std::numeric_limits<Time>::infinity());
  } else {
    return t + Time{direction};
  }
}

/// How far apart two evaluations are that are one unit of time apart: no more than the next derivative moves them in
/// that time, and rounding. The largest of all, of what is allowed.
template <int Order, typename G, typename Time>
double largest_jump(const Spline<G, Order, UniformKnots<Time>>& curve) {
  using Scalar = ScalarOf<G>;
  double worst = 0;
  const auto compare = [&](Time a, Time b) {
    const auto m = curve.template at<3>(a), n = curve.template at<3>(b);
    const auto [first, basis] = curve.knots().template basis<Long, Order, 3>(b, curve.control_points().size());
    std::array<Wide<G>, Order> points;
    for (std::size_t i = 0; i < Order; ++i) points[i] = Layout<G>::widen(curve.control_points()[first + i]);
    const auto sizes = reference_from<Order>(points, basis);
    // A time that is rounded moves the place between knots by a unit, too.
    const Long step = 2 * to_seconds<Long>(b - a);
    const auto judge = [&](std::size_t order, const auto& difference) {
      if (static_cast<int>(order) > Order - 2) return;  // jumps are its nature
      for (const bool turns : {true, false}) {
        const auto& size = turns ? sizes.rotation : sizes.translation;
        const Long jump = turns ? turning<Wide<G>>(difference).norm() : moving<Wide<G>>(difference).norm();
        // Sizes are of the largest component, jumps of vectors, two evaluations: 2√3, about 4.
        const Long allowed = 4 * limit * eps<Scalar> * size[order] + (order < 3 ? step * size[order + 1] : 0);
        if (jump > 0) worst = std::max(worst, static_cast<double>(jump / allowed));
        if (std::isnan(jump)) worst = std::numeric_limits<double>::infinity();
      }
    };
    judge(0, increment<G>(m.value, n.value).template cast<Long>().eval());
    judge(1, (m.velocity - n.velocity).template cast<Long>().eval());
    judge(2, (m.acceleration - n.acceleration).template cast<Long>().eval());
  };
  for (std::size_t i = 0; i <= curve.segments(); ++i) {
    Time knot;
    if constexpr (std::floating_point<Time>) {
      knot = curve.knots().start + static_cast<Time>(i) * curve.knots().interval;
    } else {
      knot = curve.knots().start + static_cast<typename Time::rep>(i) * curve.knots().interval;
    }
    if (i > 0) compare(next(knot, -1), knot);
    if (i < curve.segments()) compare(knot, next(knot, 1));
  }
  return worst;
}

template <typename G, typename Time>
void check_ends(Time start, Time interval) {
  testing::Random random(23);
  const auto points = random.walk<G>(13, 1);
  for_orders([&]<int Order>() {
    const Spline<G, Order, UniformKnots<Time>> curve({start, interval}, points);
    INFO("order " << Order << ", start " << seconds_or_ticks(start) << ", interval " << seconds_or_ticks(interval));
    CHECK_NOTHROW(curve.template at<3>(curve.start()));
    CHECK_NOTHROW(curve.template at<3>(curve.end()));
    CHECK_THROWS_AS(curve.template at<3>(next(curve.start(), -1)), std::out_of_range);
    CHECK_THROWS_AS(curve.template at<3>(next(curve.end(), 1)), std::out_of_range);
    CHECK(largest_jump<Order>(curve) <= 1);
    // The ends of the whole curve are those of its first and last segment on their own.
    const auto last = curve.template at<3>(curve.end()).value;
    const Spline<G, Order, UniformKnots<Time>> tail({start, interval}, {points.end() - Order, points.end()});
    const auto alone = tail.template at<3>(tail.end()).value;
    const auto tolerance = 64 * std::numeric_limits<ScalarOf<G>>::epsilon();
    if (std::abs(to_seconds<double>(start)) < 1e3) CHECK(increment<G>(last, alone).norm() < tolerance);
  });
}

}  // namespace

TEST_CASE("Knots and ends, time in double") {
  for (const double start : {0.0, -3.0, 1.0 / 3, 1e-9, 1e6, 1.4e9}) {
    check_ends<Sophus::SO3d>(start, 0.1);
    check_ends<Sophus::SO3d>(start, 1.0 / 3);
    check_ends<Sophus::SO3d>(start, 1.0);
  }
}

TEST_CASE("Knots and ends, time and scalar in float") {
  for (const float start : {0.0F, -3.0F, 1.F / 3}) check_ends<Sophus::SO3f>(start, 0.1F);
}

TEST_CASE("Knots and ends, time and scalar in long double") {
  for (const long double start : {0.0L, -3.0L, 1.L / 3, 1.4e9L}) check_ends<Sophus::SO3<long double>>(start, 0.1L);
}

TEST_CASE("Knots and ends, time in nanoseconds") {
  check_ends<Sophus::SO3d>(nanoseconds{0}, nanoseconds{5});
  check_ends<Sophus::SO3d>(nanoseconds{1'403'715'524'907'143'168}, nanoseconds{100'000'000});
}
