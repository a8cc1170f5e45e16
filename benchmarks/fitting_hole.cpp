// SPDX-License-Identifier: MIT
// A body at rest with a hole between its poses, for the picture of docs/fitting.md: what fit() makes of it, and what
// the poses alone would, with a prior that is as weak as rounding allows.
//
//   fitting_hole > hole.csv && benchmarks/fitting_hole_plot.py hole.csv -o docs/fitting_hole.svg

#include <cmath>
#include <cstdio>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <vector>

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Pose3 = SO3xR3<double>;
using Curve = Spline<Pose3, 4>;

constexpr double noise = 1e-3, interval = 0.05, rate = 200;  // m and rad, s, Hz
constexpr double hole_start = 1.505, hole_end = 2.005;  // the last pose is a tenth of a knot interval behind a knot

std::vector<Stamped<Pose3, double>> poses_at_rest() {
  NormalStream<> normal(StreamKey(5));
  const auto vector = [&] { return Eigen::Vector3d(noise * Eigen::Vector3d(normal(), normal(), normal())); };
  std::vector<Stamped<Pose3, double>> poses;
  for (int i = 0; i <= 3.5 * rate; ++i) {
    const double t = i / rate;
    const Pose3 pose{Sophus::SO3d::exp(vector()), vector()};
    if (t <= hole_start + 1e-9 || t >= hole_end - 1e-9) poses.push_back({t, pose});
  }
  return poses;
}

/// The poses, and in the hole "acceleration · interval² is 0" to 1/ε^(1/4) standard deviations of a pose.
Curve weakly_held(const std::vector<Stamped<Pose3, double>>& poses) {
  const Tangent<Pose3> deviation = Tangent<Pose3>::Constant(noise);
  FitProblem<Curve> problem(poses, {.knot_interval = interval, .standard_deviation = deviation});
  Curve curve = problem.curve();
  problem.solve();  // sets the deviation
  const auto pose_term = problem.pose_term(RobustLoss::squares());
  const double weakest = std::pow(2, 52 / 4.0) / std::pow(interval, 1.5);
  const SmoothnessTerms<Curve> weak{{SmoothnessTerm<Curve>(2, weakest * deviation, hole_start, hole_end)}};
  using Model = CurveModel<Curve, 3, PoseTerm<Curve>, SmoothnessTerms<Curve>>;
  Model::System system(curve.control_points().size());
  BandedCholesky<Model::System> factor;
  (void)minimize(Model(pose_term, weak), curve, system, factor,
                 {.relative = 1e-12, .absolute = 0, .most_iterations = 100});
  return curve;
}

}  // namespace

int main() {
  const auto poses = poses_at_rest();
  const Curve held = fit<Curve>(poses, {.knot_interval = interval}).spline, weak = weakly_held(poses);
  std::puts("time_s,pose_m,held_m,held_force,weak_m,weak_force");
  std::size_t next = 0;
  for (int i = 0; i <= 3500; ++i) {
    const double t = i * 1e-3;
    std::printf("%.3f,", t);
    if (next < poses.size() && poses[next].time <= t + 1e-9) {
      std::printf("%.6f", position(poses[next].value).x());
      ++next;
    }
    for (const Curve* curve : {&held, &weak}) {
      const auto motion = curve->evaluate<2>(std::min(t, curve->end()));
      std::printf(",%.6f,%.4f", position(motion.value).x(), ideal_imu(motion, standard_gravity<double>()).accel.norm());
    }
    std::puts("");
  }
}
