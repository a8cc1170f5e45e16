// SPDX-License-Identifier: MIT
/// Integration of readings by hand: steps, what they make of a state, and the loops over readings.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "plain_curves.hpp"

namespace {

using namespace splinertia::detail;

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
