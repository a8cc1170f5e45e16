// SPDX-License-Identifier: MIT
// What holds a curve where poses do not. A body at rest, with holes of all lengths, is in benchmarks/hole_scan.cpp.
#include <algorithm>
#include <cmath>
#include <random>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/coning.hpp>
#include <splinertia/spline/fit/detail/gap_regularization.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Pose3 = SO3xR3<double>;
using Number = Eigen::Matrix<double, 1, 1>;
using Line = Spline<Number, 4>;
using Spans = std::vector<UnmeasuredSpan<double>>;

/// Takes equations and forgets them.
struct Nowhere {
  void add(std::size_t, const auto&, const auto&) {}
};

/// a t²/2 from 0 to 10 s, exactly.
Line parabola(double a) {
  const UniformKnots<double> knots{0, 0.1};
  std::vector<Number> points;
  for (std::size_t i = 0; i < 103; ++i) {
    const double t = knots.control_point_time(i, 4);
    points.emplace_back(a * (t * t / 2 - 0.01 / 6));  // a cubic B-spline adds h² x″/6 to its control points
  }
  return {knots, points};
}

const Coning<> motion{.angle = 0.3, .rate = 2};

/// Poses at 100 Hz, with noise of the same size in rad and m.
std::vector<Stamped<Pose3, double>> noisy_poses(double noise) {
  std::mt19937_64 bits(7);
  std::normal_distribution<double> normal(0, noise);
  std::vector<Stamped<Pose3, double>> poses;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    Pose3 pose = motion.evaluate<0>(t).value;
    pose.get<0>() *= Sophus::SO3d::exp({normal(bits), normal(bits), normal(bits)});
    pose.get<1>() += Eigen::Vector3d(normal(bits), normal(bits), normal(bits));
    poses.push_back({t, pose});
  }
  return poses;
}

/// The largest error of the rotation, rad.
double rotation_error(const auto& curve) {
  double largest = 0;
  for (double t = 0; t <= 10; t += 0.013) {
    const auto truth = rotation(motion.evaluate<0>(t).value), found = rotation(curve.template evaluate<0>(t).value);
    largest = std::max(largest, increment(truth, found).norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("The ends of a high order are held where noise would bend them beyond any rotation") {
  constexpr double noise = 2e-3;
  const auto poses = noisy_poses(noise);
  // Two poses for a knot.
  const auto uniform = fit<Spline<Pose3, 6>>(poses, {.knot_interval = 0.02});
  CHECK(uniform.converged);
  // Five standard deviations of a pose, of three components together.
  CHECK(rotation_error(uniform.spline) < 5 * std::sqrt(3.) * noise);

  // Knots that end together leave no control point outside; with fewer knots there are poses enough.
  const auto clamped = fit<Spline<Pose3, 6, NonUniformKnots<double>>>(poses, {.knot_interval = 0.02});
  CHECK(clamped.converged);
  CHECK(rotation_error(clamped.spline) < 5 * std::sqrt(3.) * noise);
  const auto coarser = fit<Spline<Pose3, 6>>(poses, {.knot_interval = 0.2});
  CHECK(coarser.converged);
}

TEST_CASE("The prior over a span costs the square of the acceleration over the density beside it") {
  const double a = 3, noise = 0.02, unit = 0.5;
  const Line curve = parabola(a);
  const Spans spans{{4, 6, true, 0.1}};
  const std::vector<double> no_others;
  GapRegularization<Line> bridges(curve, spans, Number(noise), Number(unit), 0.25, no_others);
  const auto terms = bridges.terms(false);
  REQUIRE(terms.terms.size() == 1);
  Nowhere nowhere;
  const auto parts = measured_parts(curve, spans);
  const auto anchors = [&](double step) {
    return Anchors{anchors_beside(parts, 0, -1, step, 0.1), anchors_beside(parts, 1, 1, step, 0.1)};
  };
  AccelerationDensity<Line> beside(curve, Number(noise * std::sqrt(0.25)));
  const double of_span = (*beside.around(anchors(2)))[0], of_knots = (*beside.at_scale_of(anchors(0.1)))[0];
  CHECK(of_span > 2 * a * a);
  CHECK_THAT(of_knots, WithinRel(0.15 * a * a, 0.15));  // 3/2 a² h, and σ_v of the slopes in a
  const double density = std::min(of_span, of_knots);
  const double in_units = noise * noise / (unit * unit);
  CHECK_THAT(terms.add(curve, nowhere), WithinRel(2 * a * a / density * in_units, 1e-9));

  // Three times as wide in the two outermost segments at either end, with the density at the scale of a knot interval.
  const Spans none;
  const auto ends = GapRegularization<Line>(curve, none, Number(noise), Number(unit), 0.25, no_others).terms(true);
  REQUIRE(ends.terms.size() == 2);
  const double at_end = (*AccelerationDensity<Line>(curve, Number(noise * std::sqrt(0.25)))
                              .around({anchors_beside({{0.2, 10}}, 0, 1, 0.1, 0.1), {}}))[0];
  CHECK_THAT(ends.add(curve, nowhere), WithinRel(2 * 0.2 * a * a / (9 * at_end) * in_units, 1e-6));
}

TEST_CASE("Where other measurements are, there is no prior") {
  const Line curve = parabola(1);
  const Spans spans{{4, 6, true, 0.1}};
  const auto terms = [&](const std::vector<double>& others, bool ends = false) {
    return GapRegularization<Line>(curve, spans, Number(1), Number(1), 0.5, others).terms(ends).terms.size();
  };
  std::vector<double> all;
  for (int i = 0; i <= 1000; ++i) all.push_back(0.01 * i);
  CHECK(terms({}) == 1);
  CHECK(terms({}, true) == 3);
  CHECK(terms(all, true) == 0);
  auto hole = all;
  std::erase_if(hole, [](double t) { return t > 4.5 && t < 5; });
  CHECK(terms(hole) == 1);
  std::erase_if(hole, [](double t) { return t > 5.5; });
  CHECK(terms(hole) == 2);
  CHECK(terms({1, 2, 3}) == 1);   // none in the span
  CHECK(terms({1, 5, 9}) == 2);   // one in it, far from its ends
  CHECK(terms({4.1, 4.2}) == 1);  // behind these
}

TEST_CASE("Without noise, the bridge is as good as the cubic between both sides, at any phase and for any order") {
  // The cubic from x and x′ at both ends of a hole of T is off by T⁴/384 of a fourth derivative, and its acceleration
  // by T²/12. Of order 3 the acceleration is constant from knot to knot, across the edge of the hole as well.
  constexpr double T = 1, most = 1.1 * T * T * T * T / 384;
  const auto check = [&]<int Order>() {
    for (int phase = 0; phase < 8; ++phase) {
      const double from = 4 + 0.1 * phase / 8, to = from + T;
      std::vector<Stamped<Number, double>> poses;
      for (int i = 0; i <= 2000; ++i) {
        const double t = 0.005 * i;
        if (t <= from + 1e-9 || t >= to - 1e-9) poses.push_back({t, Number(std::sin(t))});
      }
      const auto fitted = fit<Spline<Number, Order>>(poses, {.knot_interval = 0.1});
      CHECK(fitted.converged);
      REQUIRE(fitted.gaps.size() == 1);
      const auto& [start, end] = fitted.gaps[0];
      double off = 0, beside = 0, strongest = 0;
      for (double t = 0; t <= 10; t += 0.01) {
        const auto found = fitted.spline.template evaluate<2>(t);
        double& largest = t > start && t < end ? off : beside;
        largest = std::max(largest, std::abs(found.value[0] - std::sin(t)));
        if (t > start && t < end) strongest = std::max(strongest, std::abs(found.acceleration[0]));
      }
      INFO("order " << Order << ", phase " << phase << ": off by " << off << ", beside the hole by " << beside
                    << ", acceleration up to " << strongest);
      CHECK(off < (Order == 3 ? 2 * most : most));
      CHECK(strongest < 1 + T * T / 12);
      CHECK(beside < (Order == 3 ? 1e-4 : 1e-5));
    }
  };
  check.operator()<3>();
  check.operator()<4>();
  check.operator()<6>();
}
