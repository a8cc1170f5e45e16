// SPDX-License-Identifier: MIT
/// Cubics by hand, on plain numbers, vectors and quaternions.
#pragma once

#include <cmath>
#include <cstddef>
#include <splinertia/splinertia.hpp>
#include <vector>

using namespace splinertia;
using namespace splinertia::detail;
using Vector = Eigen::Vector3d;
using Vector2d = Eigen::Vector2d;
using Quaternion = Eigen::Quaterniond;
using SO3 = Sophus::SO3d;
using SE3 = Sophus::SE3d;
using Split = SO3xR3<double>;
template <typename G>
using Cubic = Spline<G, 4>;

namespace {

// The basis of a uniform cubic by hand.

struct PlainKnots {
  double start, interval;
};

struct Place {
  std::size_t i;  // the first of the four control points
  double u;       // how far the time is between two knots, 0 … 1
};

inline Place place(const PlainKnots& knots, double t, std::size_t points) {
  const double since_start = t - knots.start, quotient = since_start / knots.interval;
  const std::size_t last = points - 4;
  std::size_t i = quotient < static_cast<double>(last) ? static_cast<std::size_t>(quotient) : last;
  double rest = std::fma(-static_cast<double>(i), knots.interval, since_start);
  if (rest < 0 && i > 0) {
    --i;
    rest = std::fma(-static_cast<double>(i), knots.interval, since_start);
  }
  return {i, rest / knots.interval};
}

struct Weights {
  double a, b, c;  // of the three increments
};

inline Weights cubic(double u) {
  const double scale = 1.0 / 6;
  return {(((u - 3) * u + 3) * u + 5) * scale, (((-2 * u + 3) * u + 3) * u + 1) * scale, u * u * u * scale};
}
inline Weights cubic_rate(double u, double interval) {
  const double scale = 1.0 / 6 / interval;
  return {((3 * u - 6) * u + 3) * scale, ((-6 * u + 6) * u + 3) * scale, 3 * u * u * scale};
}
inline Weights cubic_rate2(double u, double interval) {
  const double scale = 1.0 / 6 / interval / interval;
  return {(6 * u - 6) * scale, (-12 * u + 6) * scale, 6 * u * scale};
}
inline Weights cubic_rate3(double interval) {
  const double scale = 1.0 / 6 / interval / interval / interval;
  return {6 * scale, -12 * scale, 6 * scale};
}

// What evaluating comes to, and curves, on plain numbers.

struct Rotation1 {
  Quaternion q;
  Vector omega;
};
struct Rotation2 {
  Quaternion q;
  Vector omega, alpha;
};
struct Rotation3 {
  Quaternion q;
  Vector omega, alpha, jerk;
};

struct Position1 {
  Vector p, v;
};

struct Planar1 {
  double cosine, sine, omega;
  Vector2d p, v;
};

struct Pose1 {
  Quaternion q;
  Vector p, omega, v;  // of SE(3): v, and a below, in the body
};
struct Pose2 {
  Quaternion q;
  Vector p, omega, v, alpha, a;
};

struct PlainPositions {
  PlainKnots knots;
  std::vector<Vector> p, d;
};

struct PlainRotations {
  PlainKnots knots;
  std::vector<Quaternion> q;
  std::vector<Vector> d;
};

struct PlainPlanar {
  PlainKnots knots;
  std::vector<double> cosine, sine, angle;
  std::vector<Vector2d> p, rho;
};

struct PlainPoses {
  PlainKnots knots;
  std::vector<Quaternion> q;
  std::vector<Vector> p, phi, rho;  // increments in rotation and translation
};

// Rotations by hand: what is behind in the chain of factors, seen from its end, and one factor more in front of it.

inline void factor(Quaternion& q, const Vector& d, double w) { q = quaternion_product(rotation_exp<double>(w, d), q); }
inline void factor(Rotation1& sum, const Vector& d, double w, double w1) {
  sum.omega += w1 * rotate_inverse<double>(sum.q, d);
  factor(sum.q, d, w);
}
inline void factor(Rotation2& sum, const Vector& d, double w, double w1, double w2) {
  const Vector seen = rotate_inverse<double>(sum.q, d);
  sum.alpha += w2 * seen + w1 * seen.cross(sum.omega);
  sum.omega += w1 * seen;
  factor(sum.q, d, w);
}
inline void factor(Rotation3& sum, const Vector& d, double w, double w1, double w2, double w3) {
  const Vector seen = rotate_inverse<double>(sum.q, d), turned = seen.cross(sum.omega);
  sum.jerk += w3 * seen + 2 * w2 * turned + w1 * (turned.cross(sum.omega) + seen.cross(sum.alpha));
  sum.alpha += w2 * seen + w1 * turned;
  sum.omega += w1 * seen;
  factor(sum.q, d, w);
}

inline Quaternion rotation(const Quaternion& first, const Vector* d, const Weights& w) {
  Quaternion q = rotation_exp<double>(w.c, d[2]);
  factor(q, d[1], w.b);
  factor(q, d[0], w.a);
  return quaternion_product(first, q);
}
inline Rotation1 rotation(const Quaternion& first, const Vector* d, const Weights& w, const Weights& w1) {
  Rotation1 sum{rotation_exp<double>(w.c, d[2]), w1.c * d[2]};
  factor(sum, d[1], w.b, w1.b);
  factor(sum, d[0], w.a, w1.a);
  return {quaternion_product(first, sum.q), sum.omega};
}
inline Rotation2 rotation(const Quaternion& first, const Vector* d, const Weights& w, const Weights& w1,
                          const Weights& w2) {
  Rotation2 sum{rotation_exp<double>(w.c, d[2]), w1.c * d[2], w2.c * d[2]};
  factor(sum, d[1], w.b, w1.b, w2.b);
  factor(sum, d[0], w.a, w1.a, w2.a);
  return {quaternion_product(first, sum.q), sum.omega, sum.alpha};
}
inline Rotation3 rotation(const Quaternion& first, const Vector* d, const Weights& w, const Weights& w1,
                          const Weights& w2, const Weights& w3) {
  Rotation3 sum{rotation_exp<double>(w.c, d[2]), w1.c * d[2], w2.c * d[2], w3.c * d[2]};
  factor(sum, d[1], w.b, w1.b, w2.b, w3.b);
  factor(sum, d[0], w.a, w1.a, w2.a, w3.a);
  return {quaternion_product(first, sum.q), sum.omega, sum.alpha, sum.jerk};
}

// Positions by hand.

inline Vector weighted(const Vector* d, const Weights& w) { return w.a * d[0] + w.b * d[1] + w.c * d[2]; }

// Rigid motions by hand, translation and rotation coupled; rates in the body, [v; ω].

inline void factor(Quaternion& q, Vector& p, const Vector& rho, const Vector& phi, double w) {
  const auto exp = rigid_motion_exp<double>(w * rho, w * phi);
  p = exp.translation + rotate<double>(exp.rotation, p);
  q = quaternion_product(exp.rotation, q);
}
inline void factor(Pose1& sum, const Vector& rho, const Vector& phi, double w, double w1) {
  sum.v += w1 * rotate_inverse<double>(sum.q, rho - sum.p.cross(phi));
  sum.omega += w1 * rotate_inverse<double>(sum.q, phi);
  factor(sum.q, sum.p, rho, phi, w);
}
inline void factor(Pose2& sum, const Vector& rho, const Vector& phi, double w, double w1, double w2) {
  const Vector seen_rho = rotate_inverse<double>(sum.q, rho - sum.p.cross(phi));
  const Vector seen_phi = rotate_inverse<double>(sum.q, phi);
  sum.a += w2 * seen_rho + w1 * (seen_phi.cross(sum.v) + seen_rho.cross(sum.omega));
  sum.alpha += w2 * seen_phi + w1 * seen_phi.cross(sum.omega);
  sum.v += w1 * seen_rho;
  sum.omega += w1 * seen_phi;
  factor(sum.q, sum.p, rho, phi, w);
}

inline Pose1 rigid_motion(const PlainPoses& curve, std::size_t i, const Weights& w, const Weights& w1) {
  const Vector *rho = curve.rho.data() + i, *phi = curve.phi.data() + i;
  const auto exp = rigid_motion_exp<double>(w.c * rho[2], w.c * phi[2]);
  Pose1 sum{exp.rotation, exp.translation, w1.c * phi[2], w1.c * rho[2]};
  factor(sum, rho[1], phi[1], w.b, w1.b);
  factor(sum, rho[0], phi[0], w.a, w1.a);
  const Quaternion& q = curve.q[i];
  return {quaternion_product(q, sum.q), curve.p[i] + rotate<double>(q, sum.p), sum.omega, sum.v};
}
inline Pose2 rigid_motion(const PlainPoses& curve, std::size_t i, const Weights& w, const Weights& w1,
                          const Weights& w2) {
  const Vector *rho = curve.rho.data() + i, *phi = curve.phi.data() + i;
  const auto exp = rigid_motion_exp<double>(w.c * rho[2], w.c * phi[2]);
  Pose2 sum{exp.rotation, exp.translation, w1.c * phi[2], w1.c * rho[2], w2.c * phi[2], w2.c * rho[2]};
  factor(sum, rho[1], phi[1], w.b, w1.b, w2.b);
  factor(sum, rho[0], phi[0], w.a, w1.a, w2.a);
  const Quaternion& q = curve.q[i];
  return {quaternion_product(q, sum.q), curve.p[i] + rotate<double>(q, sum.p), sum.omega, sum.v, sum.alpha, sum.a};
}

// Planar motions by hand: rotations are complex numbers, a turn by a right angle is (−y, x).

inline Vector2d turned(double cosine, double sine, const Vector2d& v) {
  return {cosine * v.x() - sine * v.y(), cosine * v.y() + sine * v.x()};
}
inline void factor(Planar1& sum, const Vector2d& rho, double angle, double w, double w1) {
  const Vector2d moved = rho + angle * Vector2d(-sum.p.y(), sum.p.x());
  sum.v += w1 * turned(sum.cosine, -sum.sine, moved);
  sum.omega += w1 * angle;
  const auto exp = planar_motion_exp<double>(w * rho, w * angle);
  sum.p = exp.translation + turned(exp.cosine, exp.sine, sum.p);
  const double cosine = sum.cosine, sine = sum.sine;
  sum.cosine = exp.cosine * cosine - exp.sine * sine;
  sum.sine = exp.cosine * sine + exp.sine * cosine;
}

}  // namespace
