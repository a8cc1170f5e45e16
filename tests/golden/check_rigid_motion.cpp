// SPDX-License-Identifier: MIT
/// Tables of the functions of SE(3): se3_lie, se3_log. For angles beyond π see check_lie.cpp; the bound used for the
/// translation of exp is θ |d(J_l ρ)/dθ| ≤ |ρ| θ/2.
#include <splinertia/detail/pi.hpp>
#include <splinertia/group/sophus.hpp>

#include "golden_checks.hpp"

namespace golden {

namespace {

constexpr long double pi = splinertia::detail::pi_of<long double>();

template <typename Scalar>
using Traits = splinertia::GroupTraits<Sophus::SE3<Scalar>>;

template <typename Scalar>
using Tau = Eigen::Matrix<Scalar, 6, 1>;

[[nodiscard]] long double norm3(const Numbers& v) { return std::hypot(std::hypot(v.at(0), v.at(1)), v.at(2)); }

/// log(exp(τ)): the roundings of exp's translation, |t| ≤ |ρ|, and of its quaternion are in it beside log's own.
template <typename Scalar>
void check_log_of_exp(const Row& row, Grader<Scalar>& grader, const Sophus::SE3<Scalar>& T, long double rho,
                      long double theta) {
  const auto expected = row.outputs("log_exp");
  const auto log = flat(Traits<Scalar>::log(T));
  const auto phi = part(expected, 3, 3), got = part(log, 3, 3);
  const long double angle = norm3(phi);
  if (angle > pi * (1 - 8 * static_cast<long double>(std::numeric_limits<Scalar>::epsilon())) &&
      phi[0] * got[0] + phi[1] * got[1] + phi[2] * got[2] < 0) {
    // The principal log of the rounded rotation is on the other branch. It is right when its exp is.
    using Real = long double;
    const auto wide = Traits<Real>::exp(Traits<Scalar>::log(T).template cast<Real>());
    grader.check("exp(log_exp)", flat(wide.translation()), part(row.outputs("exp_pose"), 0, 3), {rho, rho * theta});
    return;
  }
  const bool beyond = theta > pi;
  grader.check("log_exp, translation", part(log, 0, 3), part(expected, 0, 3),
               {beyond ? rho * (1 + theta) : magnitude(part(expected, 0, 3)), rho * (1 + theta)});
  grader.check("log_exp, rotation", got, phi, {beyond ? theta : magnitude(phi), theta + magnitude(phi)});
}

template <typename Scalar>
void check_se3_lie_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  const auto tau = input_vector<Scalar, 6>(row, "tau");
  const auto theta = static_cast<long double>(tau.template tail<3>().stableNorm());
  const auto rho = static_cast<long double>(tau.template head<3>().stableNorm());
  const bool beyond = theta > pi;

  const auto T = Traits<Scalar>::exp(tau);
  const auto gold = row.outputs("exp_pose");
  grader.check("exp_pose, translation", flat(T.translation()), part(gold, 0, 3),
               {beyond ? rho * theta / 2 : 0, rho * (1 + theta / 2)});
  const auto q = part(gold, 3, 4);
  grader.check("exp_pose, rotation", signed_like(q, flat(T.unit_quaternion().coeffs())), q,
               {beyond ? theta / 2 : 0, theta / 2});
  check_log_of_exp<Scalar>(row, grader, T, rho, theta);

  Eigen::Matrix<Scalar, 3, 3> Ad;
  for (int i = 0; i < 3; ++i) Ad.col(i) = Traits<Scalar>::adjoint(T, Tau<Scalar>::Unit(3 + i)).template head<3>();
  // t^ R: of the size of t, R being of unit size.
  const long double size = magnitude(part(gold, 0, 3));
  grader.check("Ad_ur", flat(Ad), row.outputs("Ad_ur"), {beyond ? rho * theta : size, rho * (1 + 2 * theta)});

  using Square = splinertia::Jacobian<Sophus::SE3<Scalar>>;
  const auto block = [&](const char* name, const char* derivative, const Square& J) {
    const long double cond = entry_condition(tau, row.outputs(derivative));
    grader.check(name, flat(J.template topRightCorner<3, 3>()), row.outputs(name), {beyond ? cond : 0, cond});
  };
  block("Ql", "dQl", Traits<Scalar>::left_jacobian(tau));
  block("Qr", "dQr", Traits<Scalar>::left_jacobian(-tau));
  block("Jl_inv_ur", "dJl_inv_ur", Traits<Scalar>::left_jacobian_inverse(tau));
  block("Jr_inv_ur", "dJr_inv_ur", Traits<Scalar>::left_jacobian_inverse(-tau));
}

template <typename Scalar>
void check_se3_log_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  const auto t = input_vector<Scalar, 3>(row, "pose");
  const auto q = input_vector<Scalar, 4>(row, "pose", 3);
  Sophus::SE3<Scalar> T;
  T.translation() = t;
  T.so3() = splinertia::rotation_from_unit_quaternion<Scalar>(Eigen::Quaternion<Scalar>(q[3], q[0], q[1], q[2]));
  const auto log = flat(Traits<Scalar>::log(T));
  const auto gold = row.outputs("log");
  const auto rho = part(gold, 0, 3), phi = part(gold, 3, 3);
  // θ |d(J_l⁻¹ t)/dθ|, below π.
  const long double cond = static_cast<long double>(t.stableNorm()) * norm3(phi);
  grader.check("log, translation", part(log, 0, 3), rho, {0, cond});
  grader.check("log, rotation", part(log, 3, 3), phi);
}

}  // namespace

void check_se3_lie(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_se3_lie_row<Scalar>(row, report); });
  report.note(table.name(), "columns not checked: dQl dQr dJl_inv_ur dJr_inv_ur (used as condition only)");
}

void check_se3_log(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_se3_log_row<Scalar>(row, report); });
}

}  // namespace golden
