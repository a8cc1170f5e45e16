// SPDX-License-Identifier: MIT
/// How far the results of a pair are apart.
#pragma once

#include <algorithm>
#include <cmath>

#include "curve_pairs.hpp"
#include "integration_pairs.hpp"

namespace {

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

}  // namespace
