// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/strapdown/detail/galilean.hpp>

namespace splinertia::testing {

using namespace splinertia::detail;

using Matrix5 = Eigen::Matrix<long double, 5, 5>;

/// The matrix of galilean.hpp.
template <typename Scalar>
Matrix5 galilean_matrix(const GalileanVector<Scalar>& a) {
  Matrix5 m = Matrix5::Zero();
  m.topLeftCorner<3, 3>() = hat<long double>(a.phi.template cast<long double>());
  m.block<3, 1>(0, 3) = a.nu.template cast<long double>();
  m.block<3, 1>(0, 4) = a.rho.template cast<long double>();
  m(3, 4) = static_cast<long double>(a.tau);
  return m;
}

template <typename Scalar>
Matrix5 galilean_matrix(const NavIncrement<Scalar>& x) {
  Matrix5 m = Matrix5::Identity();
  m.topLeftCorner<3, 3>() = x.rotation.template cast<long double>().toRotationMatrix();
  m.block<3, 1>(0, 3) = x.velocity.template cast<long double>();
  m.block<3, 1>(0, 4) = x.position.template cast<long double>();
  m(3, 4) = static_cast<long double>(x.interval);
  return m;
}

/// By its series at a sixteenth of the argument, and squaring.
inline Matrix5 matrix_exponential(const Matrix5& argument) {
  const Matrix5 a = argument / 16;
  Matrix5 sum = Matrix5::Identity(), term = sum;
  for (int n = 1; n < 40; ++n) {
    term = (term * a / n).eval();
    sum += term;
  }
  for (int i = 0; i < 4; ++i) sum = (sum * sum).eval();
  return sum;
}

}  // namespace splinertia::testing
