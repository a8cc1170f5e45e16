// SPDX-License-Identifier: MIT
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/preintegration/rotating_preintegration.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Vector = Eigen::Vector3d;

namespace {

const Vector gravity = standard_gravity<double>();

struct Run {
  PreintegratedImu<double> imu;
  NavState<double> i, j;  // integrated in the turning world
};

Run run(const RotatingFrame<double>& frame, double duration) {
  const Ellipse<> motion;
  const auto samples = simulate(motion, Imu{}, {.rate = 200, .start = 1.0, .end = 1.0 + duration});
  const auto initial = nav_state(motion.evaluate<1>(1.0), 1.0);
  Preintegrator<Midpoint, double> preintegrator(1.0);
  Integrator<Midpoint, double, double, RotatingFrame<double>> integrator(initial, gravity, {}, frame);
  for (const auto& sample : samples) {
    preintegrator.push(sample);
    integrator.push(sample);
  }
  return {preintegrator.result(), initial, integrator.state()};
}

NavState<double> moved(NavState<double> state, int k, double step) {
  Vector d = Vector::Zero();
  d[k % 3] = step;
  if (k < 3) state.R_WB = state.R_WB * Sophus::SO3d::exp(d);
  if (k / 3 == 1) state.v_WB += d;
  if (k / 3 == 2) state.p_WB += d;
  return state;
}

ImuBias<double> moved(ImuBias<double> bias, int k, double step) {
  (k < 3 ? bias.gyro : bias.accel)[k % 3] += step;
  return bias;
}

}  // namespace

TEST_CASE("On a turning Earth the residual of what was integrated there is zero to second order in the turn") {
  const RotatingFrame<double> earth{Vector(0, 5e-5, 5.3e-5)};
  const Run earthly = run(earth, 1);
  const auto r = preintegration_residual(earthly.imu, earthly.i, {}, earthly.j, {}, gravity, earth);
  CHECK(r.norm() < 2e-7);  // (|Ω| Δt)² = 5e-9 of 20 m/s² · 1 s
  // Without the frame it is of first order.
  CHECK(preintegration_residual(earthly.imu, earthly.i, {}, earthly.j, {}, gravity).norm() > 1e-4);

  // Four times less for half the time or half the rate; rounding is far below.
  const RotatingFrame<double> fast{Vector(0.003, -0.002, 0.004)}, slow{Vector(0.0015, -0.001, 0.002)};
  const Run quick = run(fast, 1), half = run(slow, 1);
  const double error = preintegration_residual(quick.imu, quick.i, {}, quick.j, {}, gravity, fast).norm();
  const double less = preintegration_residual(half.imu, half.i, {}, half.j, {}, gravity, slow).norm();
  CHECK(error > 1e-6);
  CHECK_THAT(error / less, WithinAbs(4, 0.1));
}

TEST_CASE("Without a turn it is the inertial residual") {
  const RotatingFrame<double> still{Vector::Zero()};
  const Run any = run(still, 0.5);
  const ImuBias<double> bias{{0.01, 0.02, 0}, {0.1, 0, 0.2}};
  const auto r = preintegration_residual(any.imu, any.i, bias, any.j, {}, gravity, still);
  CHECK((r - preintegration_residual(any.imu, any.i, bias, any.j, {}, gravity)).norm() < 1e-14);
}

TEST_CASE("Jacobians in a turning world are those of central differences") {
  const RotatingFrame<double> frame{Vector(0.3, -0.2, 0.4)};  // fast enough to see every term
  const Run any = run(frame, 0.5);
  const auto i = any.i, j = moved(moved(moved(any.j, 0, 0.2), 4, 1.0), 8, -2.0);
  const ImuBias<double> bias_i{{0.01, 0.02, -0.01}, {0.1, -0.05, 0.2}}, bias_j{{0.02, 0, 0}, {0, 0, 0.1}};
  const auto residual = [&](const auto& a, const auto& ba, const auto& b, const auto& bb) {
    return preintegration_residual(any.imu, a, ba, b, bb, gravity, frame);
  };
  const auto l = linearize_preintegration_residual(any.imu, i, bias_i, j, bias_j, gravity, frame);
  CHECK(l.value == residual(i, bias_i, j, bias_j));
  // Truncation 1e-10 and rounding 1e-15 · 30 m/1e-5, times derivatives up to 10.
  constexpr double step = 1e-5, allowed = 1e-8;
  const auto difference = [](const auto& plus, const auto& minus) -> PreintegrationResidual<double> {
    return (plus - minus) / (2 * step);
  };
  for (int k = 0; k < 9; ++k) {
    INFO("component " << k);
    const auto of_i =
        difference(residual(moved(i, k, step), bias_i, j, bias_j), residual(moved(i, k, -step), bias_i, j, bias_j));
    const auto of_j =
        difference(residual(i, bias_i, moved(j, k, step), bias_j), residual(i, bias_i, moved(j, k, -step), bias_j));
    CHECK((of_i - l.state_i.col(k)).norm() < allowed);
    CHECK((of_j - l.state_j.col(k)).norm() < allowed);
  }
  for (int k = 0; k < 6; ++k) {
    INFO("component " << k);
    const auto of_i =
        difference(residual(i, moved(bias_i, k, step), j, bias_j), residual(i, moved(bias_i, k, -step), j, bias_j));
    const auto of_j =
        difference(residual(i, bias_i, j, moved(bias_j, k, step)), residual(i, bias_i, j, moved(bias_j, k, -step)));
    CHECK((of_i - l.bias_i.col(k)).norm() < allowed);
    CHECK((of_j - l.bias_j.col(k)).norm() < allowed);
  }
}
