// SPDX-License-Identifier: MIT
/// Each point at which a curve and a measurement along it are composed: from the library, and by hand.
#pragma once

#include "plain_curves.hpp"

namespace {

using namespace splinertia::detail;

// Measurements by hand. A sensor at p_BI in the body, whose axes q_BI takes to the body's.

struct PlainMeasurement {
  Vector gyro = Vector::Zero(), accel = Vector::Zero();
};

struct PlainMounted {
  PlainPoses curve;
  Vector gravity;
  Quaternion q_BI;
  Vector p_BI;
};

inline PlainMeasurement at_lever_arm(const PlainMounted& imu, const Vector& omega, const Vector& alpha,
                                     const Vector& force) {
  const Vector at_arm = force + alpha.cross(imu.p_BI) + omega.cross(omega.cross(imu.p_BI));
  return {rotate_inverse<double>(imu.q_BI, omega), rotate_inverse<double>(imu.q_BI, at_arm)};
}

template <typename G>
struct Mounted {
  Cubic<G> curve;
  Vector gravity;
  Mounting<double> mounting;
};

}  // namespace

// Derivatives and groups: a cubic at a time.

[[gnu::noinline]] Motion<SO3, 0> so3_evaluate0(const Cubic<SO3>& curve, double t) { return curve.evaluate<0>(t); }
[[gnu::noinline]] Motion<SO3, 1> so3_evaluate1(const Cubic<SO3>& curve, double t) { return curve.evaluate<1>(t); }
[[gnu::noinline]] Motion<SO3, 2> so3_evaluate2(const Cubic<SO3>& curve, double t) { return curve.evaluate<2>(t); }
[[gnu::noinline]] Motion<SO3, 3> so3_evaluate3(const Cubic<SO3>& curve, double t) { return curve.evaluate<3>(t); }
[[gnu::noinline]] Motion<Split, 2> so3xr3_evaluate2(const Cubic<Split>& curve, double t) {
  return curve.evaluate<2>(t);
}
[[gnu::noinline]] Motion<Vector, 1> r3_evaluate1(const Cubic<Vector>& curve, double t) { return curve.evaluate<1>(t); }
[[gnu::noinline]] Motion<Sophus::SE2d, 1> se2_evaluate1(const Cubic<Sophus::SE2d>& curve, double t) {
  return curve.evaluate<1>(t);
}
[[gnu::noinline]] Motion<Split, 1> so3xr3_evaluate1(const Cubic<Split>& curve, double t) {
  return curve.evaluate<1>(t);
}
[[gnu::noinline]] Motion<SE3, 1> se3_evaluate1(const Cubic<SE3>& curve, double t) { return curve.evaluate<1>(t); }

Quaternion so3_evaluate0_by_hand(const PlainRotations& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  return rotation(curve.q[i], curve.d.data() + i, cubic(u));
}
Rotation1 so3_evaluate1_by_hand(const PlainRotations& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  return rotation(curve.q[i], curve.d.data() + i, cubic(u), cubic_rate(u, curve.knots.interval));
}
Rotation2 so3_evaluate2_by_hand(const PlainRotations& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const double interval = curve.knots.interval;
  return rotation(curve.q[i], curve.d.data() + i, cubic(u), cubic_rate(u, interval), cubic_rate2(u, interval));
}
Rotation3 so3_evaluate3_by_hand(const PlainRotations& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const double interval = curve.knots.interval;
  return rotation(curve.q[i], curve.d.data() + i, cubic(u), cubic_rate(u, interval), cubic_rate2(u, interval),
                  cubic_rate3(interval));
}
Pose2 so3xr3_evaluate2_by_hand(const PlainPoses& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const Weights w = cubic(u), w1 = cubic_rate(u, curve.knots.interval), w2 = cubic_rate2(u, curve.knots.interval);
  const Rotation2 r = rotation(curve.q[i], curve.phi.data() + i, w, w1, w2);
  const Vector* d = curve.rho.data() + i;
  return {r.q, curve.p[i] + weighted(d, w), r.omega, weighted(d, w1), r.alpha, weighted(d, w2)};
}
Position1 r3_evaluate1_by_hand(const PlainPositions& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.p.size());
  const Vector* d = curve.d.data() + i;
  return {curve.p[i] + weighted(d, cubic(u)), weighted(d, cubic_rate(u, curve.knots.interval))};
}
Planar1 se2_evaluate1_by_hand(const PlainPlanar& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.p.size());
  const Weights w = cubic(u), w1 = cubic_rate(u, curve.knots.interval);
  const Vector2d* rho = curve.rho.data() + i;
  const double* angle = curve.angle.data() + i;
  const auto exp = planar_motion_exp<double>(w.c * rho[2], w.c * angle[2]);
  Planar1 sum{exp.cosine, exp.sine, w1.c * angle[2], exp.translation, w1.c * rho[2]};
  factor(sum, rho[1], angle[1], w.b, w1.b);
  factor(sum, rho[0], angle[0], w.a, w1.a);
  const double cosine = curve.cosine[i], sine = curve.sine[i];
  return {cosine * sum.cosine - sine * sum.sine, cosine * sum.sine + sine * sum.cosine, sum.omega,
          curve.p[i] + turned(cosine, sine, sum.p), sum.v};
}
Pose1 so3xr3_evaluate1_by_hand(const PlainPoses& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const Weights w = cubic(u), w1 = cubic_rate(u, curve.knots.interval);
  const Rotation1 r = rotation(curve.q[i], curve.phi.data() + i, w, w1);
  const Vector* d = curve.rho.data() + i;
  return {r.q, curve.p[i] + weighted(d, w), r.omega, weighted(d, w1)};
}
Pose1 se3_evaluate1_by_hand(const PlainPoses& curve, double t) {
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  return rigid_motion(curve, i, cubic(u), cubic_rate(u, curve.knots.interval));
}

// Measurements along a cubic.

[[gnu::noinline]] ImuMeasurement<double> so3xr3_imu(const Mounted<Split>& imu, double t) {
  return ideal_imu(imu.curve.evaluate<2>(t), imu.gravity);
}
[[gnu::noinline]] ImuMeasurement<double> so3xr3_imu_lever_arm(const Mounted<Split>& imu, double t) {
  return ideal_imu(imu.curve.evaluate<2>(t), imu.gravity, imu.mounting);
}
[[gnu::noinline]] ImuMeasurement<double> se3_imu(const Mounted<SE3>& imu, double t) {
  return ideal_imu(imu.curve.evaluate<2>(t), imu.gravity);
}
[[gnu::noinline]] ImuMeasurement<double> se3_imu_lever_arm(const Mounted<SE3>& imu, double t) {
  return ideal_imu(imu.curve.evaluate<2>(t), imu.gravity, imu.mounting);
}

PlainMeasurement so3xr3_imu_by_hand(const PlainMounted& imu, double t) {
  const PlainPoses& curve = imu.curve;
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const Weights w2 = cubic_rate2(u, curve.knots.interval);
  const auto r = rotation(curve.q[i], curve.phi.data() + i, cubic(u), cubic_rate(u, curve.knots.interval), w2);
  return {r.omega, rotate_inverse<double>(r.q, weighted(curve.rho.data() + i, w2) - imu.gravity)};
}
PlainMeasurement so3xr3_imu_lever_arm_by_hand(const PlainMounted& imu, double t) {
  const PlainPoses& curve = imu.curve;
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const Weights w2 = cubic_rate2(u, curve.knots.interval);
  const auto r = rotation(curve.q[i], curve.phi.data() + i, cubic(u), cubic_rate(u, curve.knots.interval), w2);
  const Vector force = rotate_inverse<double>(r.q, weighted(curve.rho.data() + i, w2) - imu.gravity);
  return at_lever_arm(imu, r.omega, r.alpha, force);
}
PlainMeasurement se3_imu_by_hand(const PlainMounted& imu, double t) {
  const PlainPoses& curve = imu.curve;
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const double interval = curve.knots.interval;
  const auto r = rigid_motion(curve, i, cubic(u), cubic_rate(u, interval), cubic_rate2(u, interval));
  return {r.omega, r.a + r.omega.cross(r.v) - rotate_inverse<double>(r.q, imu.gravity)};
}
PlainMeasurement se3_imu_lever_arm_by_hand(const PlainMounted& imu, double t) {
  const PlainPoses& curve = imu.curve;
  const auto [i, u] = place(curve.knots, t, curve.q.size());
  const double interval = curve.knots.interval;
  const auto r = rigid_motion(curve, i, cubic(u), cubic_rate(u, interval), cubic_rate2(u, interval));
  const Vector force = r.a + r.omega.cross(r.v) - rotate_inverse<double>(r.q, imu.gravity);
  return at_lever_arm(imu, r.omega, r.alpha, force);
}
