// SPDX-License-Identifier: MIT
/// What the tests of preintegration preintegrate, and how they compare the results.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>
#include <vector>

#include "support/random_group.hpp"

namespace splinertia::testing {

using namespace splinertia::detail;

template <typename Scalar>
inline constexpr Scalar eps = std::numeric_limits<Scalar>::epsilon();

/// What a scheme takes: point samples or increments.
template <typename Scheme, typename Scalar>
using SampleOf = std::conditional_t<Scheme::takes_increments, ImuIncrement<Scalar, double>, ImuSample<Scalar, double>>;

/// A rate of some rad/s and a force of some 10 m/s², smooth in time, of which the point samples or (roughly) the
/// increments are taken at unequal intervals of 10 ms ± 20 %. Jacobians and covariances do not care where samples come
/// from.
template <typename Scheme, typename Scalar>
std::vector<SampleOf<Scheme, Scalar>> some_samples(std::size_t intervals, double jitter = 0.2) {
  Random random(7);
  std::vector<SampleOf<Scheme, Scalar>> samples;
  double t = 2, before = 2;
  for (std::size_t i = 0; i <= intervals; ++i, before = t, t += 0.01 * (1 + jitter * random.symmetric())) {
    const auto at = [](double x) { return static_cast<Scalar>(std::sin(x)); };
    const Eigen::Vector3<Scalar> gyro = Scalar(3) * Eigen::Vector3<Scalar>(at(7 * t), at(5 * t + 1), at(6 * t + 2));
    const Eigen::Vector3<Scalar> accel(Scalar(4) * at(8 * t), Scalar(5) * at(9 * t + 1),
                                       Scalar(9) + Scalar(3) * at(4 * t));
    if constexpr (Scheme::takes_increments) {
      const auto h = static_cast<Scalar>(t - before);
      if (i > 0) samples.push_back({t, gyro * h, accel * h});
    } else {
      samples.push_back({t, gyro, accel});
    }
  }
  return samples;
}

template <typename Scheme, typename Scalar, typename Samples, typename Noise = Noiseless>
auto preintegrate(double start, const Samples& samples, const ImuBias<Scalar>& bias = {}, const Noise& noise = {}) {
  Preintegrator<Scheme, Scalar, double, Noise> preintegrator(start, bias, noise);
  for (const auto& sample : samples) preintegrator.push(sample);
  preintegrator.finish();
  return preintegrator.result();
}

/// The differences of two motions: in attitude (rad), velocity, position, along the path of b.
template <typename Scalar>
Eigen::Matrix<Scalar, 9, 1> difference(const NavIncrement<Scalar>& a, const NavIncrement<Scalar>& b) {
  Eigen::Matrix<Scalar, 9, 1> d;
  d << rotation_increment<Scalar>(a.rotation, b.rotation), b.velocity - a.velocity, b.position - a.position;
  return d;
}

/// Bias Jacobians as one matrix, 9×6.
template <typename Scalar>
Eigen::Matrix<Scalar, 9, 6> as_matrix(const BiasJacobians<Scalar>& J) {
  Eigen::Matrix<Scalar, 9, 6> m;
  m << J.R_gyro, Eigen::Matrix3<Scalar>::Zero(), J.v_gyro, J.v_accel, J.p_gyro, J.p_accel;
  return m;
}

template <typename Scalar>
ImuBias<Scalar> moved(const ImuBias<Scalar>& bias, const Eigen::Matrix<Scalar, 6, 1>& d) {
  return {bias.gyro + d.template head<3>(), bias.accel + d.template tail<3>()};
}

/// ∂f/∂x of f(x), x of N numbers at zero, by central differences of sixth order.
template <int Rows, int N, typename Scalar>
Eigen::Matrix<Scalar, Rows, N> central_differences(const auto& f, Scalar h) {
  Eigen::Matrix<Scalar, Rows, N> J;
  for (int i = 0; i < N; ++i) {
    const auto at = [&](int steps) -> Eigen::Matrix<Scalar, Rows, 1> {
      return f(Eigen::Matrix<Scalar, N, 1>(static_cast<Scalar>(steps) * h * Eigen::Matrix<Scalar, N, 1>::Unit(i)));
    };
    J.col(i) = (Scalar(45) * (at(1) - at(-1)) - Scalar(9) * (at(2) - at(-2)) + (at(3) - at(-3))) / (Scalar(60) * h);
  }
  return J;
}

/// The largest entry of |a − b|.
template <typename A, typename B>
auto largest_difference(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace splinertia::testing
