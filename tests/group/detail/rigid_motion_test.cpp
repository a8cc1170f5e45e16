// SPDX-License-Identifier: MIT
#include <numbers>
#include <splinertia/group/detail/rigid_motion.hpp>

#include "group/sophus_laws.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Real = long double;
using M3 = Eigen::Matrix3<Real>;
using V3 = Eigen::Vector3<Real>;

/// J_l(φ) = Σ (φ^)ⁿ/(n + 1)! and its directional derivative along ρ, Σ Σ (φ^)^i ρ^ (φ^)^(n−1−i)/(n + 1)!, by their
/// definitions: with no coefficient in common with the code. Loses a digit of long double's nineteen at π.
void series(const V3& rho, const V3& phi, M3& J, M3& Q) {
  const M3 P = hat<Real>(phi), R = hat<Real>(rho);
  M3 power = M3::Identity(), derivative = M3::Zero();
  J = M3::Zero();
  Q = M3::Zero();
  Real factorial = 1;
  for (int n = 0; n < 40; ++n) {
    factorial *= static_cast<Real>(n + 1);
    J += power / factorial;
    Q += derivative / factorial;
    derivative = (derivative * P + power * R).eval();
    power = (power * P).eval();
  }
}

/// Largest component of got − truth, in eps of Scalar times that of truth.
template <typename Scalar>
[[nodiscard]] double units(const auto& got, const auto& truth) {
  const Real error = laws::largest(got.template cast<Real>() - truth);
  const Real size = laws::largest(truth) * static_cast<Real>(std::numeric_limits<Scalar>::epsilon());
  return static_cast<double>(error <= 0 ? 0 : error / size);
}

}  // namespace

TEMPLATE_TEST_CASE("SE(3) is a Lie group", "[group]", float, double, long double) {
  laws::hold_for<Sophus::SE3<TestType>>();
}

TEMPLATE_TEST_CASE("exp, log and blocks against their series", "[group]", float, double) {
  using Scalar = TestType;
  laws::Draws draw(31);
  double exp = 0, log = 0, block = 0, inverse_block = 0, jacobian = 0, inverse = 0;
  for (const Real angle : laws::angles()) {
    for (int i = 0; i < 200; ++i) {
      const double p[6] = {draw(), draw(), draw(), draw(), draw(), draw()};
      const Eigen::Vector3<Scalar> rho = V3(p[0], p[1], p[2]).cast<Scalar>();
      const Eigen::Vector3<Scalar> phi = (angle * V3(p[3], p[4], p[5]).normalized()).cast<Scalar>();
      M3 J, Q;
      series(rho.template cast<Real>(), phi.template cast<Real>(), J, Q);
      const V3 t = J * rho.template cast<Real>();
      const M3 J_inverse = J.inverse();
      exp = std::max(exp, units<Scalar>(rigid_motion_exp<Scalar>(rho, phi).translation, t));
      const Eigen::Vector3<Scalar> t_rounded = t.cast<Scalar>();
      log = std::max(log, units<Scalar>(rigid_motion_log<Scalar>(t_rounded, phi),
                                        V3(J_inverse * t_rounded.template cast<Real>())));
      jacobian = std::max(jacobian, units<Scalar>(rotation_left_jacobian<Scalar>(phi), J));
      inverse = std::max(inverse, units<Scalar>(rotation_left_jacobian_inverse<Scalar>(phi), J_inverse));
      block = std::max(block, units<Scalar>(rigid_motion_left_jacobian<Scalar>(rho, phi).dual, Q));
      inverse_block = std::max(inverse_block, units<Scalar>(rigid_motion_left_jacobian_inverse<Scalar>(rho, phi).dual,
                                                            M3(-J_inverse * Q * J_inverse)));
    }
  }
  // Grade A allows 4 eps of the largest component.
  CHECK(exp <= 4);
  CHECK(log <= 4);
  CHECK(jacobian <= 4);
  CHECK(inverse <= 4);
  CHECK(block <= 4);
  CHECK(inverse_block <= 4);
}

TEST_CASE("a screw about z", "[group]") {
  // Half a turn about z while moving 1 along the tangent and 3 up: a half circle of circumference 1, radius 1/π.
  const auto T = rigid_motion_exp<double>({1, 0, 3}, {0, 0, std::numbers::pi});
  CHECK(T.translation.isApprox(Eigen::Vector3d(0, 2 / std::numbers::pi, 3), 1e-15));
}

TEST_CASE("the diagonal of the anticommutator does not cancel", "[group]") {
  const Eigen::Vector3d phi(1, 1e-9, 0), rho(1, 1e-9, 0);
  CHECK(hat_anticommutator<double>(phi, rho)(0, 0) == -2e-18);
}
