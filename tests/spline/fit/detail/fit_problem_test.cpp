// SPDX-License-Identifier: MIT
// What fit() finds is what it should: a spline it was sampled from, and a smooth motion as well as its order allows.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <sophus/se2.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/coning.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/motion/split_motion.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Line2 = Spline<Eigen::Matrix<double, 1, 1>, 2, UniformKnots<nanoseconds>>;
using Space3 = Spline<Eigen::Vector3d, 3>;
using Rotation5 = Spline<Sophus::SO3d, 5>;
using Space7 = Spline<Eigen::Vector3d, 7>;
using Plane4 = Spline<Sophus::SE2d, 4, NonUniformKnots<nanoseconds>>;
using Split4 = Spline<SO3xR3<double>, 4>;
using Split6 = Spline<SO3xR3<double>, 6>;
using Split8 = Spline<SO3xR3<double>, 8, NonUniformKnots<double>>;
using Rigid4 = Spline<Sophus::SE3d, 4>;
using Rigid6 = Spline<Sophus::SE3d, 6>;

template <typename K>
K some_knots() {
  using Time = typename K::Time;
  const auto time = [](double seconds) {
    if constexpr (std::floating_point<Time>) {
      return static_cast<Time>(3 + seconds);
    } else {
      return after(Time(1'403'715'524'907'143'168), seconds);
    }
  };
  if constexpr (requires(const K& knots) { knots.interval; }) {
    return {time(0), time(0.25) - time(0)};
  } else {
    K knots;
    double knot = -1;
    for (int i = 0; i < 30; ++i) {
      knots.knots.push_back(time(knot));
      const double gaps[] = {0.2, 0.05, 0.31, 0.6, 0.11};
      knot += gaps[i * i % 5];
    }
    return knots;
  }
}

/// The largest distance of a control point of a random spline from that of the spline fitted to samples of it.
template <typename Curve>
double round_trip(std::uint64_t seed) {
  using G = typename Curve::Group;
  using K = KnotsOf<Curve>;
  testing::Random random(seed);
  K knots = some_knots<K>();
  std::size_t control_points = 20;
  if constexpr (requires { knots.knots; }) control_points = knots.knots.size() - Curve::order;
  const Curve curve(knots, random.walk<G>(control_points, 0.3));
  PosesOf<Curve> poses;
  constexpr int samples = 600;
  const double length = to_seconds<double>(curve.end() - curve.start());
  for (int i = 0; i <= samples; ++i) {
    const auto time = std::min(after(curve.start(), length * i / samples), curve.end());
    poses.push_back({time, curve.template evaluate<0>(time).value});
  }
  const auto fitted = fit<Curve>(poses, {.knots = knots});
  CHECK(fitted.converged);
  CHECK(fitted.gaps.empty());
  CHECK(fitted.outliers.empty());
  REQUIRE(fitted.spline.control_points().size() == control_points);
  double error = 0;
  for (std::size_t i = 0; i < control_points; ++i) {
    const auto off = increment<G>(curve.control_points()[i], fitted.spline.control_points()[i]).norm();
    error = std::max(error, static_cast<double>(off));
  }
  UNSCOPED_INFO("order " << Curve::order << ": control points off by up to " << error << ", poses by "
                         << fitted.residuals.max << ", condition " << fitted.condition << ", " << fitted.iterations
                         << " iterations");
  return error;
}

/// An analytic motion on a pose group.
template <typename G, typename Analytic>
Motion<G, 2> motion_at(const Analytic& analytic, double t) {
  const Motion<SO3xR3<double>, 2> split = analytic.template evaluate<2>(t);
  if constexpr (SplitPose<G>) {
    return split;
  } else {
    const auto& q = rotation(split.value).unit_quaternion();
    const Eigen::Vector3d omega = angular_velocity(split), v = rotate_inverse<double>(q, world_velocity(split));
    const Eigen::Vector3d force = specific_force<SO3xR3<double>, 2>(split, Eigen::Vector3d::Zero());
    Motion<G, 2> m;
    m.value = make_pose<G>(rotation(split.value), position(split.value));
    m.velocity << v, omega;
    m.acceleration << force - omega.cross(v), angular_acceleration(split);
    return m;
  }
}

/// A turn to and fro about one axis: rotations that commute.
struct Nodding {
  template <int D>
  [[nodiscard]] Motion<SO3xR3<double>, D> evaluate(double t) const {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -2) / 3;
    RigidBodyState<double> state{.q_WB = Sophus::SO3d::exp(std::sin(2 * t) * axis).unit_quaternion(),
                                 .p_WB = Eigen::Vector3d::Zero(),
                                 .omega = 2 * std::cos(2 * t) * axis,
                                 .v_WB = Eigen::Vector3d::Zero(),
                                 .alpha = -4 * std::sin(2 * t) * axis,
                                 .a_WB = Eigen::Vector3d::Zero()};
    return split_motion<D>(state);
  }
};

/// Errors of value, velocity and acceleration.
using Errors = std::array<double, 3>;
constexpr int rotations = 0, positions = 1, everything = 2;

/// The largest errors of a fit to 200 poses a second over 8 s, two seconds from its ends.
template <typename Curve>
Errors errors_of(const auto& analytic, double interval, int part) {
  using G = typename Curve::Group;
  PosesOf<Curve> poses;
  for (int i = 0; i <= 1600; ++i) poses.push_back({i / 200., motion_at<G>(analytic, i / 200.).value});
  const auto fitted = fit<Curve>(poses, {.knot_interval = interval});
  CHECK(fitted.converged);
  Errors errors{};
  constexpr int samples = 997;  // divides nothing: times anywhere between the knots
  for (int i = 0; i <= samples; ++i) {
    const double t = 2 + 4. * i / samples;
    const auto expected = motion_at<G>(analytic, t);
    const auto got = fitted.spline.template evaluate<2>(t);
    const auto note = [&](double& error, const Tangent<G>& difference) {
      if (part == everything) {
        error = std::max(error, difference.norm());
      } else {
        const bool head = SplitPose<G> == (part == rotations);
        error = std::max(error,
                         Eigen::Vector3d(head ? difference.template head<3>() : difference.template tail<3>()).norm());
      }
    };
    note(errors[0], increment<G>(expected.value, got.value));
    note(errors[1], expected.velocity - got.velocity);
    note(errors[2], expected.acceleration - got.acceleration);
  }
  return errors;
}

/// Halves the knot interval from `longest` on: errors have to fall as its powers `order`, order − 1 and order − 2.
template <typename Curve>
void check_slopes(const char* name, const auto& analytic, int part, double longest, int halvings, int order) {
  Errors before{};
  for (int halving = 0; halving <= halvings; ++halving) {
    const double interval = std::ldexp(longest, -halving);
    const Errors errors = errors_of<Curve>(analytic, interval, part);
    std::printf("%-24s order %d, knots %.5f s apart: errors %.1e %.1e %.1e", name, Curve::order, interval, errors[0],
                errors[1], errors[2]);
    if (halving > 0) {
      std::printf(", slopes");
      for (std::size_t d = 0; d < 3; ++d) {
        const double slope = std::log2(before[d] / errors[d]);
        std::printf(" %.2f", slope);
        INFO(name << ", order " << Curve::order << ", knots " << interval << " s apart, derivative " << d);
        CHECK_THAT(slope, WithinAbs(order - static_cast<double>(d), 0.3));
      }
    }
    std::printf("\n");
    before = errors;
  }
}

}  // namespace

TEMPLATE_TEST_CASE("A spline is found again in samples of it", "", Line2, Space3, Rotation5, Space7, Plane4, Split4,
                   Split6, Split8, Rigid4, Rigid6) {
  // Measured: rounding times the root of the condition, 1e-10 on order 8 with uneven knots, 1e-13 and less elsewhere.
  CHECK(round_trip<TestType>(1) < 1e-9);
}

TEST_CASE("A spline is found again in float and long double") {
  CHECK(round_trip<Spline<SO3xR3<float>, 4, UniformKnots<nanoseconds>>>(1) < 1e-5);
  CHECK(round_trip<Spline<SO3xR3<long double>, 4, NonUniformKnots<double>>>(1) < 1e-16);
}

TEST_CASE("Value, velocity and acceleration converge as the knot interval to its order, less one, less two") {
  const Ellipse<> ellipse;
  check_slopes<Split4>("ellipse, positions", ellipse, positions, 1. / 8, 3, 4);
  check_slopes<Split6>("ellipse, positions", ellipse, positions, 1. / 8, 2, 6);
  // Rotations that commute.
  check_slopes<Split4>("nodding, SO3xR3", Nodding{}, rotations, 1. / 4, 3, 4);
  check_slopes<Split6>("nodding, SO3xR3", Nodding{}, rotations, 1. / 4, 3, 6);
  check_slopes<Rigid4>("nodding, SE3", Nodding{}, rotations, 1. / 4, 3, 4);
  check_slopes<Rigid6>("nodding, SE3", Nodding{}, rotations, 1. / 4, 3, 6);
}

// A cumulative spline of order k is X_0 Π exp(λ_j d_j). With d_j = h v + …, Baker, Campbell and Hausdorff's formula has
// a term ½ Σ_{i<j} λ_i λ_j [d_i, d_j], and [d_i, d_j] = (j − i) h³ [v, v̇] to first order. Σ_{i<j} (j − i) λ_i λ_j is no
// spline of order k: what is left of it beside the nearest, c_k, no choice of control points takes away. So wherever
// [v, v̇] ≠ 0 the order is three, whatever k, with an error of ½ c_k h³ |[v, v̇]|, small though it is:
//
//                 c_k       c_k'      c_k''         (maxima over a segment; computed with a dense least squares fit)
//   order 4     3.20e-3   1.88e-2   1.63e-1
//   order 6     2.42e-4   1.51e-3   9.71e-3
TEST_CASE("Where velocity and acceleration do not commute, the order is three in the end, as it has to be") {
  const Coning<> coning{.angle = 0.5, .rate = 3};
  const Ellipse<> ellipse;
  check_slopes<Split4>("coning, SO3xR3", coning, rotations, 1. / 32, 1, 3);
  check_slopes<Split6>("coning, SO3xR3", coning, rotations, 1. / 32, 1, 3);
  check_slopes<Split4>("ellipse, rotations", ellipse, rotations, 1. / 16, 1, 3);
  check_slopes<Split6>("ellipse, rotations", ellipse, rotations, 1. / 16, 1, 3);
  check_slopes<Rigid6>("ellipse, SE3", ellipse, everything, 1. / 32, 1, 3);

  const auto m = coning.evaluate<2>(0);
  const double bracket = angular_velocity(m).cross(angular_acceleration(m)).norm();  // the same at all times
  const double h = 1. / 32;
  const auto check = [&](const Errors& errors, const Errors& c) {
    for (std::size_t d = 0; d < 3; ++d) {
      CHECK_THAT(errors[d], WithinRel(0.5 * c[d] * std::pow(h, 3 - static_cast<double>(d)) * bracket, 0.1));
    }
  };
  check(errors_of<Split4>(coning, h, rotations), {3.20e-3, 1.88e-2, 1.63e-1});
  check(errors_of<Split6>(coning, h, rotations), {2.42e-4, 1.51e-3, 9.71e-3});
}
