// SPDX-License-Identifier: MIT
// Whether what is composed from the library takes more instructions than the same written by hand: one pair of
// functions for each point at which things are composed, derivative, group, measurement, integrator and turning world
// (that of error terms is in error_models.cpp).
//
// NAME is composed from the library; NAME_by_hand is the same formula on plain numbers, vectors and quaternions, as
// people write it: with none of the library's types that compose (no Spline, Motion, GroupTraits, Product, scheme,
// window or Frame) and no attributes for the compiler. Of the library it takes the leaves: exp and its coefficients,
// quaternion times quaternion and times vector. NAME_inlined is NAME_by_hand with every call in it inlined
// (gnu::flatten), which shows how much of a difference is where a compiler stops inlining; it is listed, and not a
// limit.

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <splinertia/splinertia.hpp>
#include <stdexcept>

#include "support/overhead.hpp"

using namespace splinertia;
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

// Integration by hand: what the body does in a step, and what that makes of a state.

struct Reading {
  double time;
  Vector gyro, accel;
};

struct PlainState {
  Quaternion q;
  Vector v, p;
  double time;
};

struct PlainStep {
  Quaternion q;
  Vector v, p;
  double h;
};

template <typename State>
struct Flight {
  State initial;
  Vector gravity;
  Vector world_rate;  // of the world against inertial space
  std::span<const Reading> readings;
  double longest = std::numeric_limits<double>::max();  // interval between them
};

inline PlainStep euler_step(const Reading& a, const Reading& b) {
  const double h = b.time - a.time;
  const Vector v = a.accel * h;
  return {rotation_exp<double>(a.gyro * h), v, v * (h / 2), h};
}

/// Rate and force held.
inline PlainStep held(const Vector& phi, const Vector& nu, double h) {
  const auto c = stumpff<5>(phi.squaredNorm());
  const double s = c.half[1] / 2;
  const Vector once = phi.cross(nu), twice = phi.cross(once);
  return {{c.half[0], s * phi.x(), s * phi.y(), s * phi.z()},
          nu + c.full[2] * once + c.full[3] * twice,
          h * (nu / 2 + c.full[3] * once + c.full[4] * twice),
          h};
}

inline PlainStep midpoint_step(const Reading& a, const Reading& b) {
  const double h = b.time - a.time, half = h / 2;
  return held((a.gyro + b.gyro) * half, (a.accel + b.accel) * half, h);
}

inline Vector lie_rate(const Vector& phi, const Vector& omega) {
  const Vector once = phi.cross(omega);
  return omega + once / 2 + phi.cross(once) / 12;
}

inline PlainStep classical_step(const Reading& a, const Reading& b) {
  const double h = b.time - a.time, half = h / 2, sixth = h / 6;
  const Vector gyro = (a.gyro + b.gyro) * 0.5, accel = (a.accel + b.accel) * 0.5;
  const Vector k1 = a.gyro, phi1 = k1 * half;
  const Vector k2 = lie_rate(phi1, gyro), phi2 = k2 * half;
  const Vector k3 = lie_rate(phi2, gyro), phi3 = k3 * h;
  const Vector k4 = lie_rate(phi3, b.gyro);
  const Vector a2 = rotate<double>(rotation_exp<double>(phi1), accel);
  const Vector a3 = rotate<double>(rotation_exp<double>(phi2), accel);
  const Vector a4 = rotate<double>(rotation_exp<double>(phi3), b.accel);
  return {rotation_exp<double>((k1 + (k2 + k3) * 2 + k4) * sixth), (a.accel + (a2 + a3) * 2 + a4) * sixth,
          (a.accel + a2 + a3) * (sixth * h), h};
}

/// exp of the fourth-order Magnus expansion with the given integrals and first moments of rate and force.
inline PlainStep magnus4_step(const Vector& phi0, const Vector& nu0, const Vector& phi1, const Vector& nu1, double h) {
  const Vector phi = phi0 + phi0.cross(phi1), nu = nu0 + phi0.cross(nu1) + nu0.cross(phi1), rho = nu1 * -h;
  const auto c = stumpff<5>(phi.squaredNorm());
  const double s = c.half[1] / 2;
  const Vector once = phi.cross(nu), twice = phi.cross(once), turned = phi.cross(rho);
  return {
      {c.half[0], s * phi.x(), s * phi.y(), s * phi.z()},
      nu + c.full[2] * once + c.full[3] * twice,
      h * (nu / 2 + c.full[3] * once + c.full[4] * twice) + rho + c.full[2] * turned + c.full[3] * phi.cross(turned),
      h};
}

/// Between the second and the third of four readings with equal intervals.
inline PlainStep magnus4_middle(const Reading* r) {
  const double h = r[2].time - r[1].time, a = h / 24, b = h / 720, tolerance = h * 1e-6;
  if (!(std::abs(r[1].time - r[0].time - h) <= tolerance) || !(std::abs(r[3].time - r[2].time - h) <= tolerance)) {
    throw std::invalid_argument("readings are not at equal intervals");
  }
  return magnus4_step((13 * (r[1].gyro + r[2].gyro) - (r[0].gyro + r[3].gyro)) * a,
                      (13 * (r[1].accel + r[2].accel) - (r[0].accel + r[3].accel)) * a,
                      (63 * (r[2].gyro - r[1].gyro) + (r[0].gyro - r[3].gyro)) * b,
                      (63 * (r[2].accel - r[1].accel) + (r[0].accel - r[3].accel)) * b, h);
}

/// From r[0] to r[next], both at one end of the run.
inline PlainStep magnus4_end(const Reading* r, const Reading* next, double h, double sign) {
  const double a = h / 24, b = sign * h / 720;
  const std::ptrdiff_t to = next - r;
  const Reading &r1 = r[to], &r2 = r[2 * to], &r3 = r[3 * to];
  return magnus4_step((9 * r->gyro + 19 * r1.gyro - 5 * r2.gyro + r3.gyro) * a,
                      (9 * r->accel + 19 * r1.accel - 5 * r2.accel + r3.accel) * a,
                      (-59 * r->gyro + 57 * r1.gyro + 3 * r2.gyro - r3.gyro) * b,
                      (-59 * r->accel + 57 * r1.accel + 3 * r2.accel - r3.accel) * b, h);
}

inline Quaternion on_sphere(const Quaternion& q) {
  const double scale = (3 - q.squaredNorm()) / 2;
  return Quaternion(q.coeffs() * scale);
}

inline PlainState advanced(const PlainState& s, const PlainStep& step, const Vector& gravity, double time) {
  const Vector fall = gravity * step.h;
  return {on_sphere(quaternion_product(s.q, step.q)), s.v + fall + rotate<double>(s.q, step.v),
          s.p + (s.v + fall / 2) * step.h + rotate<double>(s.q, step.p), time};
}

inline PlainState advanced_in_turning_world(const PlainState& s, const PlainStep& step, const Vector& gravity,
                                            const Vector& rate, double time) {
  const double h = step.h;
  const Vector fall = gravity * h, dv = rotate<double>(s.q, step.v), dp = rotate<double>(s.q, step.p);
  const Vector inertial = (s.v + fall / 2) * h + dp;
  const Vector moved = inertial - rate.cross((inertial - fall * (h / 6)) * h);
  const Quaternion back = rotation_exp<double>(-rate * h), q = on_sphere(quaternion_product(s.q, step.q));
  return {on_sphere(quaternion_product(back, q)), s.v + fall + dv - rate.cross(dv * h - dp + moved * 2), s.p + moved,
          time};
}

/// Checks what the library checks of stamps and readings.
inline void must_follow(const Reading& b, const Reading& a, double longest) {
  if (!(b.time > a.time) || !std::isfinite(b.time)) throw std::invalid_argument("stamps do not increase");
  if (b.time - a.time > longest) throw std::invalid_argument("readings are missing");
  if (!std::isfinite((b.gyro + b.accel).sum())) throw std::invalid_argument("a reading is not finite");
}

using PlainFlight = Flight<PlainState>;
using LibraryFlight = Flight<NavState<double>>;
using States = std::vector<NavState<double>>;
using PlainStates = std::vector<PlainState>;

/// The loop over readings: step(a, b) is what the body does from one to the next, advance(state, step, time) what that
/// makes of a state.
inline PlainStates by_hand(const PlainFlight& flight, const auto& step, const auto& advance) {
  PlainStates states;
  states.reserve(flight.readings.size() + 1);
  PlainState state = flight.initial;
  states.push_back(state);
  for (std::size_t i = 0; i + 1 < flight.readings.size(); ++i) {
    const Reading &a = flight.readings[i], &b = flight.readings[i + 1];
    must_follow(b, a, flight.longest);
    state = advance(state, step(a, b), b.time);
    states.push_back(state);
  }
  return states;
}

/// The same for Magnus4, which looks one reading back and one ahead.
inline PlainStates magnus4_by_hand(const PlainFlight& flight, const auto& advance) {
  const Reading* r = flight.readings.data();
  const std::size_t n = flight.readings.size();
  PlainStates states;
  states.reserve(n + 1);
  states.push_back(flight.initial);
  if (n < 4) throw std::invalid_argument("too few readings");
  must_follow(r[1], r[0], flight.longest);
  PlainState state = advance(flight.initial, magnus4_end(r, r + 1, r[1].time - r[0].time, 1), r[1].time);
  states.push_back(state);
  for (std::size_t i = 1; i + 2 < n; ++i) {
    must_follow(r[i + 1], r[i], flight.longest);
    state = advance(state, magnus4_middle(r + i - 1), r[i + 1].time);
    states.push_back(state);
  }
  must_follow(r[n - 1], r[n - 2], flight.longest);
  state = advance(state, magnus4_end(r + n - 1, r + n - 2, r[n - 1].time - r[n - 2].time, -1), r[n - 1].time);
  states.push_back(state);
  return states;
}

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

// Integration of readings in memory, and the same in a world that turns.

[[gnu::noinline]] States integrate_euler(const LibraryFlight& f) {
  return integrate<Euler>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_midpoint(const LibraryFlight& f) {
  return integrate<Midpoint>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_runge_kutta4(const LibraryFlight& f) {
  return integrate<RungeKutta4>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_magnus4(const LibraryFlight& f) {
  return integrate<Magnus4>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_euler_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<Euler>(f.initial, f.readings, f.gravity, options);
}
[[gnu::noinline]] States integrate_midpoint_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<Midpoint>(f.initial, f.readings, f.gravity, options);
}
[[gnu::noinline]] States integrate_runge_kutta4_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<RungeKutta4>(f.initial, f.readings, f.gravity, options);
}
[[gnu::noinline]] States integrate_magnus4_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<Magnus4>(f.initial, f.readings, f.gravity, options);
}

namespace {

inline auto inertially(const PlainFlight& f) {
  return [gravity = f.gravity](const PlainState& state, const PlainStep& step, double time) {
    return advanced(state, step, gravity, time);
  };
}
inline auto turning(const PlainFlight& f) {
  return [gravity = f.gravity, rate = f.world_rate](const PlainState& state, const PlainStep& step, double time) {
    return advanced_in_turning_world(state, step, gravity, rate, time);
  };
}

}  // namespace

PlainStates integrate_euler_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return euler_step(a, b); }, inertially(f));
}
PlainStates integrate_midpoint_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return midpoint_step(a, b); }, inertially(f));
}
PlainStates integrate_runge_kutta4_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return classical_step(a, b); }, inertially(f));
}
PlainStates integrate_magnus4_by_hand(const PlainFlight& f) { return magnus4_by_hand(f, inertially(f)); }
PlainStates integrate_euler_earth_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return euler_step(a, b); }, turning(f));
}
PlainStates integrate_midpoint_earth_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return midpoint_step(a, b); }, turning(f));
}
PlainStates integrate_runge_kutta4_earth_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return classical_step(a, b); }, turning(f));
}
PlainStates integrate_magnus4_earth_by_hand(const PlainFlight& f) { return magnus4_by_hand(f, turning(f)); }

namespace {

// Both sides of each pair get the same: 100 control points 0.1 s apart, increments of rotation up to 0.5 rad, positions
// ~ N(0, 1) m, calls at random times; 1000 readings at 200 Hz of a body that turns with up to 3 rad/s.

struct Workload {
  std::vector<SO3> rotations;
  std::vector<Vector> positions;
  std::vector<double> times;
  std::vector<Reading> readings;

  Workload() {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(-0.29, 0.29), time(0, 9.7);
    SO3 R;
    for (int i = 0; i < 100; ++i) {
      R = GroupTraits<SO3>::compose(R, GroupTraits<SO3>::exp({angle(bits), angle(bits), angle(bits)}));
      rotations.push_back(R);
      positions.emplace_back(normal(bits), normal(bits), normal(bits));
    }
    for (int i = 0; i < 4096; ++i) times.push_back(time(bits));
    for (int i = 0; i < 1000; ++i) {
      const double t = i / 200.0;
      readings.push_back({t, Vector(3 * std::sin(t), 2 * std::cos(2 * t), std::sin(3 * t)),
                          Vector(std::cos(t), 2 * std::sin(2 * t), 9.8 + std::sin(t))});
    }
  }
};

const Workload& workload() {
  static const Workload the;
  return the;
}

template <typename G>
const Cubic<G>& curve() {
  static const Cubic<G> the = [] {
    std::vector<G> points;
    const auto& [rotations, positions, times, readings] = workload();
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      if constexpr (std::same_as<G, SO3>) {
        points.push_back(rotations[i]);
      } else if constexpr (std::same_as<G, Vector>) {
        points.push_back(positions[i]);
      } else if constexpr (std::same_as<G, Sophus::SE2d>) {
        points.emplace_back(0.3 * static_cast<double>(i), positions[i].template head<2>());
      } else {
        points.push_back(make_pose<G>(rotations[i], positions[i]));
      }
    }
    return Cubic<G>({.start = 0, .interval = 0.1}, points);
  }();
  return the;
}

constexpr PlainKnots plain_knots{0, 0.1};

PlainRotations plain_rotations() {
  PlainRotations plain{plain_knots, {}, curve<SO3>().increments()};
  for (const SO3& R : curve<SO3>().control_points()) plain.q.push_back(R.unit_quaternion());
  return plain;
}

PlainPlanar plain_planar() {
  PlainPlanar plain{plain_knots, {}, {}, {}, {}, {}};
  for (const auto& x : curve<Sophus::SE2d>().control_points()) {
    plain.cosine.push_back(x.so2().unit_complex().x());
    plain.sine.push_back(x.so2().unit_complex().y());
    plain.p.push_back(x.translation());
  }
  for (const auto& d : curve<Sophus::SE2d>().increments()) {
    plain.angle.push_back(d[2]);
    plain.rho.push_back(d.head<2>());
  }
  return plain;
}

template <typename G>
PlainPoses plain_poses() {
  PlainPoses plain{plain_knots, {}, {}, {}, {}};
  for (const G& x : curve<G>().control_points()) {
    plain.q.push_back(splinertia::rotation(x).unit_quaternion());
    plain.p.push_back(splinertia::position(x));
  }
  for (const auto& d : curve<G>().increments()) {
    const Vector head = d.template head<3>(), tail = d.template tail<3>();
    plain.phi.push_back(SplitPose<G> ? head : tail);
    plain.rho.push_back(SplitPose<G> ? tail : head);
  }
  return plain;
}

const Quaternion q_BI = rotation_exp<double>(Vector(0.1, -0.2, 0.3));
const Vector p_BI(0.1, 0.2, -0.3);

template <typename G>
Mounted<G> mounted() {
  return {curve<G>(), standard_gravity<double>(), {rotation_from_unit_quaternion(q_BI), p_BI}};
}

template <typename G>
PlainMounted plain_mounted() {
  return {plain_poses<G>(), standard_gravity<double>(), q_BI, p_BI};
}

/// The largest difference of numbers, over rounding.
struct Differences {
  double largest = 0;

  void operator()(double a, double b) {
    const double difference = std::abs(a - b) / (1e-12 * (1 + std::abs(b)));
    if (!(difference <= largest)) largest = difference;  // NaN, too
  }
  template <int N>
  void operator()(const Eigen::Matrix<double, N, 1>& a, const Eigen::Matrix<double, N, 1>& b) {
    for (int i = 0; i < N; ++i) (*this)(a[i], b[i]);
  }
  void operator()(const Quaternion& a, const Quaternion& b) { (*this)(a.coeffs(), b.coeffs()); }

  template <int D>
  void operator()(const Motion<SO3, D>& a, const auto& b) {
    if constexpr (D == 0) {
      (*this)(a.value.unit_quaternion(), b);
    } else {
      (*this)(a.value.unit_quaternion(), b.q);
      (*this)(a.velocity, b.omega);
    }
    if constexpr (D >= 2) (*this)(a.acceleration, b.alpha);
    if constexpr (D >= 3) (*this)(a.jerk, b.jerk);
  }
  void operator()(const Motion<Vector, 1>& a, const Position1& b) {
    (*this)(a.value, b.p);
    (*this)(a.velocity, b.v);
  }
  void operator()(const Motion<Sophus::SE2d, 1>& a, const Planar1& b) {
    (*this)(a.value.so2().unit_complex(), Vector2d(b.cosine, b.sine));
    (*this)(a.value.translation(), b.p);
    (*this)(a.velocity, Vector(b.v.x(), b.v.y(), b.omega));
  }
  template <Pose G, int D>
  void operator()(const Motion<G, D>& a, const auto& b) {
    const auto translational = [](const auto& tangent) -> Vector {
      return tangent.template segment<3>(SplitPose<G> ? 3 : 0);
    };
    (*this)(splinertia::rotation(a.value).unit_quaternion(), b.q);
    (*this)(splinertia::position(a.value), b.p);
    (*this)(angular_velocity(a), b.omega);
    (*this)(translational(a.velocity), b.v);
    if constexpr (D >= 2) {
      (*this)(angular_acceleration(a), b.alpha);
      (*this)(translational(a.acceleration), b.a);
    }
  }
  void operator()(const ImuMeasurement<double>& a, const PlainMeasurement& b) {
    (*this)(a.gyro, b.gyro);
    (*this)(a.accel, b.accel);
  }
  void operator()(const States& a, const PlainStates& b) {
    (*this)(static_cast<double>(a.size()), static_cast<double>(b.size()));
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      (*this)(a[i].R_WB.unit_quaternion(), b[i].q);
      (*this)(a[i].v_WB, b[i].v);
      (*this)(a[i].p_WB, b[i].p);
      (*this)(a[i].time, b[i].time);
    }
  }
};

/// Calls f(data, t, result) at random times.
template <typename Data, typename Result>
benchmark::Kernel at_random_times(const std::string& name, const Data& data, Result (*f)(const Data&, double)) {
  return {name, [&data, f](std::size_t calls) {
            const auto& times = workload().times;
            for (std::size_t i = 0; i < calls; ++i) benchmark::keep(f(data, times[i % times.size()]));
          }};
}

// What the library may have more. A loop of its own that integrates takes readings one at a time from any range, and
// keeps those that a scheme looks at and how far it has come; by hand they are in an array: a few stores a reading.
#ifdef __clang__
// clang++-14 takes gnu::flatten for one level of calls only: below it, what a function of the library hands to the next
// goes through memory, where a few larger functions by hand have it in registers.
constexpr benchmark::Tolerance of_curves{.part = 0.3}, of_integration{.part = 0.3};
#else
constexpr benchmark::Tolerance of_curves{}, of_integration{.part = 0.05};
#endif

/// by_hand with every call in it inlined.
template <auto by_hand, typename... Arguments>
[[gnu::noinline, gnu::flatten]] auto inlined(Arguments... arguments) {
  return by_hand(arguments...);
}

template <auto by_hand, typename Data, typename Result, typename PlainData>
benchmark::Pair pair(const std::string& name, const Data& data, Result (*library)(const Data&, double),
                     const PlainData& plain) {
  return {at_random_times(name, data, library), at_random_times(name + "_by_hand", plain, by_hand),
          [=, &data, &plain] {
            Differences differences;
            for (const double t : workload().times) differences(library(data, t), by_hand(plain, t));
            return differences.largest;
          },
          at_random_times(name + "_inlined", plain, &inlined<by_hand, const PlainData&, double>), of_curves};
}

/// Runs f over the readings again and again; a call is a reading.
template <typename State>
benchmark::Kernel over_readings(const std::string& name, const Flight<State>& flight,
                                std::vector<State> (*f)(const Flight<State>&)) {
  return {name, [&flight, f](std::size_t calls) {
            for (std::size_t n; calls >= 4; calls -= n) {  // the least that Magnus4 asks for
              n = std::min(calls, flight.readings.size());
              Flight<State> part = flight;
              part.readings = flight.readings.first(n);
              benchmark::keep(f(part));
            }
          }};
}

template <auto by_hand>
benchmark::Pair pair(const std::string& name, States (*library)(const LibraryFlight&)) {
  static const Vector earth(0, 4.6e-5, 5.6e-5);
  static const LibraryFlight flight{
      {SO3(), Vector(1, 2, 3), Vector::Zero(), 0.0}, standard_gravity<double>(), earth, workload().readings};
  static const PlainFlight plain{
      {Quaternion::Identity(), Vector(1, 2, 3), Vector::Zero(), 0.0}, flight.gravity, earth, workload().readings};
  return {over_readings(name, flight, library), over_readings<PlainState>(name + "_by_hand", plain, by_hand),
          [=] {
            Differences differences;
            differences(library(flight), by_hand(plain));
            return differences.largest;
          },
          over_readings<PlainState>(name + "_inlined", plain, &inlined<by_hand, const PlainFlight&>), of_integration};
}

const std::vector<benchmark::Pair>& pairs() {
  static const PlainRotations rotations = plain_rotations();
  static const PlainPositions positions{plain_knots, curve<Vector>().control_points(), curve<Vector>().increments()};
  static const PlainPlanar planar = plain_planar();
  static const PlainPoses split = plain_poses<Split>(), rigid = plain_poses<SE3>();
  static const auto split_imu = mounted<Split>();
  static const auto rigid_imu = mounted<SE3>();
  static const PlainMounted plain_split_imu = plain_mounted<Split>(), plain_rigid_imu = plain_mounted<SE3>();
  static const std::vector<benchmark::Pair> the{
      pair<so3_evaluate0_by_hand>("so3_evaluate0", curve<SO3>(), so3_evaluate0, rotations),
      pair<so3_evaluate1_by_hand>("so3_evaluate1", curve<SO3>(), so3_evaluate1, rotations),
      pair<so3_evaluate2_by_hand>("so3_evaluate2", curve<SO3>(), so3_evaluate2, rotations),
      pair<so3_evaluate3_by_hand>("so3_evaluate3", curve<SO3>(), so3_evaluate3, rotations),
      pair<so3xr3_evaluate2_by_hand>("so3xr3_evaluate2", curve<Split>(), so3xr3_evaluate2, split),
      pair<r3_evaluate1_by_hand>("r3_evaluate1", curve<Vector>(), r3_evaluate1, positions),
      pair<se2_evaluate1_by_hand>("se2_evaluate1", curve<Sophus::SE2d>(), se2_evaluate1, planar),
      pair<so3xr3_evaluate1_by_hand>("so3xr3_evaluate1", curve<Split>(), so3xr3_evaluate1, split),
      pair<se3_evaluate1_by_hand>("se3_evaluate1", curve<SE3>(), se3_evaluate1, rigid),
      pair<so3xr3_imu_by_hand>("so3xr3_imu", split_imu, so3xr3_imu, plain_split_imu),
      pair<so3xr3_imu_lever_arm_by_hand>("so3xr3_imu_lever_arm", split_imu, so3xr3_imu_lever_arm, plain_split_imu),
      pair<se3_imu_by_hand>("se3_imu", rigid_imu, se3_imu, plain_rigid_imu),
      pair<se3_imu_lever_arm_by_hand>("se3_imu_lever_arm", rigid_imu, se3_imu_lever_arm, plain_rigid_imu),
      pair<integrate_euler_by_hand>("integrate_euler", integrate_euler),
      pair<integrate_midpoint_by_hand>("integrate_midpoint", integrate_midpoint),
      pair<integrate_runge_kutta4_by_hand>("integrate_runge_kutta4", integrate_runge_kutta4),
      pair<integrate_magnus4_by_hand>("integrate_magnus4", integrate_magnus4),
      pair<integrate_euler_earth_by_hand>("integrate_euler_earth", integrate_euler_earth),
      pair<integrate_midpoint_earth_by_hand>("integrate_midpoint_earth", integrate_midpoint_earth),
      pair<integrate_runge_kutta4_earth_by_hand>("integrate_runge_kutta4_earth", integrate_runge_kutta4_earth),
      pair<integrate_magnus4_earth_by_hand>("integrate_magnus4_earth", integrate_magnus4_earth),
  };
  return the;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::OverheadOptions overhead{.inlined = "inlined"};
  return benchmark::run(
      argc, argv, "Composed from the library, and written by hand.", benchmark::kernels_of(pairs()),
      {.options = [&](CLI::App& app) { overhead.add(app); }, .instead = [&] { return overhead.run(pairs(), "call"); }});
}
