// SPDX-License-Identifier: MIT
// Any poses, fitted and interpolated with any options.
#include <chrono>
#include <cmath>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/fit/interpolate.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <vector>

#include "fuzz/motions.hpp"

namespace splinertia::fuzz::fit_target {

template <typename G, typename Time>
std::vector<Stamped<G, Time>> poses_of(Numbers& numbers) {
  std::vector<Stamped<G, Time>> poses;
  Time time = numbers.time<Time>();
  while (!numbers.input.empty() && poses.size() < 16) {
    if constexpr (std::same_as<G, SO3xR3<double>>) {
      const auto rotation = numbers.rotation();
      poses.push_back({time, {rotation, numbers.vector()}});
    } else {
      poses.push_back({time, G(numbers())});
    }
    time = numbers.wild && numbers.input.integer(0, 7) == 0 ? numbers.time<Time>()
                                                            : after(time, 0.01 * numbers.input.integer(1, 20));
  }
  return poses;
}

template <typename Curve>
void expect_curve(const Curve& curve, bool usual) {
  expect(curve.start() < curve.end(), "an empty domain");
  if (!usual) return;
  for (const auto& d : curve.increments()) expect(d.allFinite(), "an increment that is not finite");
}

template <typename Curve>
void use_fit(Input& input) {
  using G = typename Curve::Group;
  FitOptions<Curve> options;
  Numbers numbers{input};
  (void)accepted("", [&] {
    // The choice of knots makes many fits: one input in eight asks for it.
    if (input.integer(0, 7) > 0) options.knot_interval = numbers.wild ? numbers() : 0.01 * input.integer(1, 100);
    if (input.flag()) options.standard_deviation = Tangent<G>::Constant(numbers());
    const int loss = input.integer(0, 3);
    if (loss == 1) options.loss = RobustLoss::huber(numbers());
    if (loss == 2) options.loss = RobustLoss::cauchy();
    if (input.flag()) options.smoothness = Smoothness<G>{input.integer(1, 4), Tangent<G>::Constant(numbers())};
    if (input.flag()) options.outlier_limit = numbers();
    options.regularize_ends = input.flag();
    options.most_iterations = input.integer(0, 10);
    const auto poses = poses_of<G, typename Curve::Time>(numbers);
    if (input.flag()) options.weights.assign(poses.size(), numbers());
    // Few control points, for many runs a second: larger fits differ in time and memory only.
    const double interval = options.knot_interval.value_or(0.1);
    const double span = poses.empty() ? 0 : to_seconds<double>(poses.back().time) - to_seconds<double>(poses[0].time);
    if (interval > 0 && std::isfinite(span) && span / interval > 64) return;
    const auto result = fit<Curve>(poses, options);
    expect_curve(result.spline, numbers.usual);
    expect(result.residuals.poses.size() == poses.size(), result.residuals.poses.size(), " residuals");
    if (numbers.usual) expect(std::isfinite(result.residuals.rms), "rms ", result.residuals.rms);
  });
}

template <typename Curve>
void use_interpolate(Input& input) {
  using G = typename Curve::Group;
  CurveEnds<G> ends;
  ends.condition = static_cast<EndCondition>(input.integer(0, 2));
  Numbers numbers{input};
  const auto poses = poses_of<G, typename Curve::Time>(numbers);
  (void)accepted("", [&] {
    const Curve curve = interpolate<Curve>(poses, ends);
    expect_curve(curve, numbers.usual);
    for (const auto& pose : poses) {
      const auto off = increment<G>(pose.value, curve.template at<0>(pose.time).value);
      expect(!numbers.usual || off.norm() < 1e-4, "a pose is missed by ", off.norm());
    }
  });
}

using std::chrono::nanoseconds;
using Scalar = Eigen::Matrix<double, 1, 1>;

const Target target{"fit", [](Input input) {
                      switch (input.integer(0, 3)) {
                        case 0:
                          return use_fit<Spline<SO3xR3<double>, 4>>(input);
                        case 1:
                          return use_fit<Spline<Scalar, 4, UniformKnots<nanoseconds>>>(input);
                        case 2:
                          return use_interpolate<Spline<SO3xR3<double>, 4, NonUniformKnots<nanoseconds>>>(input);
                        default:
                          return use_interpolate<Spline<Scalar, 6, NonUniformKnots<double>>>(input);
                      }
                    }};

}  // namespace splinertia::fuzz::fit_target
