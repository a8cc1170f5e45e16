// SPDX-License-Identifier: MIT
// Curves of any knots and control points, at any time.
#include <algorithm>
#include <cmath>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/group/parameters.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/sample.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "fuzz/motions.hpp"

namespace splinertia::fuzz::spline_target {

using namespace splinertia::detail;

template <typename G>
G point(Numbers& numbers) {
  if constexpr (std::same_as<G, SO3xR3<double>>) {
    return {numbers.rotation(), numbers.vector()};
  } else {
    G x;
    for (auto& element : x) element = static_cast<typename G::Scalar>(numbers());
    return x;
  }
}

template <typename Time>
UniformKnots<Time> knots(Numbers& numbers, std::size_t, int, UniformKnots<Time>) {
  const Time start = numbers.time<Time>();
  return {start, numbers.time<Time>()};
}
/// Ascending but for where a difference overflows.
template <typename Time>
NonUniformKnots<Time> knots(Numbers& numbers, std::size_t count, int order, NonUniformKnots<Time>) {
  std::vector<Time> times(count + static_cast<std::size_t>(order));
  for (Time& time : times) time = numbers.time<Time>();
  if (numbers.input.flag()) std::sort(times.begin(), times.end());
  return {std::move(times)};
}

template <typename G, int D>
std::vector<double> numbers_of(const Motion<G, D>& m) {
  std::array<ScalarOf<G>, static_cast<std::size_t>(parameter_count<G>)> value;
  write_parameters(m.value, value.data());
  std::vector<double> all(value.begin(), value.end());
  if constexpr (D >= 1) all.insert(all.end(), m.velocity.begin(), m.velocity.end());
  if constexpr (D >= 2) all.insert(all.end(), m.acceleration.begin(), m.acceleration.end());
  return all;
}

template <typename G>
std::vector<double> numbers_of(const G& value) {
  Motion<G, 0> motion;
  motion.value = value;
  return numbers_of(motion);
}

void expect_finite(const std::vector<double>& numbers, const char* what) {
  for (const double x : numbers) expect(std::isfinite(x), what, " gives ", x);
}

/// The same but for rounding, which is relative to `size`.
void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance, const char* what) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    expect(std::abs(a[i] - b[i]) <= tolerance, what, " gives ", b[i], ", evaluate ", a[i]);
  }
}

template <typename Curve>
void use(Input& input) {
  using G = typename Curve::Group;
  using Time = typename Curve::Time;
  using Scalar = typename Curve::Scalar;
  Numbers numbers{input};
  const auto count = static_cast<std::size_t>(input.integer(0, Curve::order + 6));
  std::vector<G> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(point<G>(numbers));
  (void)accepted("", [&] {
    const Curve curve(knots(numbers, count, Curve::order, std::remove_cvref_t<decltype(curve.knots())>{}), points);
    const Time start = curve.start(), end = curve.end();
    expect(start < end, "an empty domain was accepted");
    // What a derivative can be: no segment is shorter than what clocks tell apart.
    double shortest = std::numeric_limits<double>::infinity(), largest = 1;
    for (std::size_t s = 0; s < curve.segments(); ++s) {
      const double length =
          to_seconds<double>(curve.knots().knot(s + 1, Curve::order) - curve.knots().knot(s, Curve::order));
      if (length > 0) shortest = std::min(shortest, length);
    }
    for (const auto& d : curve.increments()) largest = std::max(largest, static_cast<double>(d.norm()));
    for (const G& x : curve.control_points()) {
      for (const double number : numbers_of(x)) largest = std::max(largest, std::abs(number));
    }
    const bool usual = numbers.usual && shortest > 1e-6;
    const double rounding = 100 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * largest;
    const auto at = [&](double share) {
      return std::clamp(after(start, share * to_seconds<double>(end - start)), start, end);
    };
    for (int i = 0; i < 6; ++i) {
      const Time t = i == 0 ? start : i == 1 ? end : at(input.bits<std::uint16_t>() / 65535.0);
      const auto motion = numbers_of(curve.template evaluate<2>(t));
      if (usual) expect_finite(motion, "evaluate");
      expect(!usual || numbers_of(curve.template at<2>(t)) == motion, "at() is not evaluate()");
      const auto linearized = curve.template linearize<1>(t);
      expect(linearized.first + Curve::order <= count, "control points from ", linearized.first, " on");
      if (usual)
        expect_near(numbers_of(curve.template evaluate<0>(t)), numbers_of(linearized.value), rounding, "linearize");
    }
    const Time outside = numbers.time<Time>();
    const bool inside = outside >= start && outside <= end;
    expect(accepted("Spline: ", [&] { (void)curve.template at<1>(outside); }) == inside, "at(",
           seconds_or_ticks(outside), ")");
    const auto size = static_cast<std::size_t>(input.integer(1, 40));
    const Time interval = numbers.time<Time>();
    (void)accepted("sample: ", [&] {
      const auto samples = sample<1>(curve, outside, interval, size);
      for (std::size_t i = 0; i < size && usual; ++i) {
        const Time t = std::clamp(SampleTimes{outside, interval}(i), start, end);
        const double slope = largest / shortest + 1;
        expect_near(numbers_of(curve.template evaluate<1>(t)), numbers_of(samples[i]), rounding * slope * slope,
                    "sample");
      }
    });
  });
}

using std::chrono::nanoseconds;

const Target target{"spline", [](Input input) {
                      switch (input.integer(0, 5)) {
                        case 0:
                          return use<Spline<Eigen::Vector2d, 4>>(input);
                        case 1:
                          return use<Spline<Eigen::Vector2d, 3, NonUniformKnots<double>>>(input);
                        case 2:
                          return use<Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>>>(input);
                        case 3:
                          return use<Spline<SO3xR3<double>, 4, NonUniformKnots<nanoseconds>>>(input);
                        case 4:
                          return use<Spline<Eigen::Matrix<float, 1, 1>, 2, UniformKnots<nanoseconds>>>(input);
                        default:
                          return use<Spline<Eigen::Vector2d, 8, NonUniformKnots<double>>>(input);
                      }
                    }};

}  // namespace splinertia::fuzz::spline_target
