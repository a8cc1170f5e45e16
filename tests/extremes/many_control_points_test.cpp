// SPDX-License-Identifier: MIT
/// A million control points: 14 hours at 20 Hz.
#include <chrono>
#include <cmath>
#include <string>

#include "extremes.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace extremes;
using std::chrono::nanoseconds;

namespace {

constexpr std::size_t million = 1'000'000;

/// A walk that turns by a radian and goes on by a metre with every ten control points.
template <typename Scalar>
std::vector<SO3xR3<Scalar>> long_walk() {
  std::vector<SO3xR3<Scalar>> points;
  points.reserve(million);
  for (std::size_t i = 0; i < million; ++i) {
    const double a = 0.1 * static_cast<double>(i);
    const Eigen::Vector3d phi(std::sin(a), std::cos(0.7 * a), std::sin(0.3 * a));
    const Eigen::Quaterniond q = rotation_exp<double>(phi);
    points.push_back({rotation_from_unit_quaternion<Scalar>(q.cast<Scalar>()),
                      Eigen::Vector3<Scalar>(Scalar(a), Scalar(std::sin(a)), Scalar(1))});
  }
  return points;
}

template <typename Curve>
void check_everywhere(const Curve& curve, const std::string& what) {
  Worst worst;
  const auto start = curve.start(), end = curve.end();
  const auto length = end - start;
  for (const auto t : {start, start + curve.knots().interval / 3, start + length / 2, start + length / 7 * 5,
                       end - curve.knots().interval / 3, end}) {
    compare_at<4>(worst, curve, t);
  }
  worst.require("a million control points, " + what);
}

}  // namespace

TEST_CASE("A million control points") {
  const auto points = long_walk<double>();
  {
    const Spline<SO3xR3<double>, 4> curve({.start = 12.5, .interval = 0.05}, points);
    CHECK(curve.segments() == million - 3);
    check_everywhere(curve, "time in seconds");
  }
  using Knots = UniformKnots<nanoseconds>;
  const Spline<SO3xR3<double>, 4, Knots> curve({nanoseconds{1'403'715'524'907'143'168}, nanoseconds{50'000'000}},
                                               points);
  check_everywhere(curve, "time in nanoseconds");
  // The millionth segment is where it should be, to the nanosecond.
  const auto at = curve.knots().basis<double, 4, 0>(curve.end() - nanoseconds{1}, million);
  CHECK(at.first == million - 4);
  CHECK(curve.knots().basis<double, 4, 0>(curve.end() - nanoseconds{50'000'001}, million).first == million - 5);
}

TEST_CASE("A million control points in float") {
  // Places to 1e5 m, which float tells apart by 8 mm: increments are those of the rounded points, exactly.
  const Spline<SO3xR3<float>, 4> curve({.start = 0, .interval = 0.05}, long_walk<float>());
  check_everywhere(curve, "float, time in seconds");
}
