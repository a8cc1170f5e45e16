// SPDX-License-Identifier: MIT
/// Tables of the functions of SO(3): lie_coeffs, so3_lie, so3_log.
///
/// Angles beyond π: every function here goes through |φ|², whose rounding is a relative error of about eps in θ. That
/// changes f by eps θ |df/dθ|, which no algorithm that starts from φ in working precision can undo, and near 2π, where
/// J⁻¹ has its pole and exp passes the identity, it is far above eps |f|. So beyond π, and only there, θ |df/dθ| (from
/// the table's own derivatives where it has them) is part of the natural magnitude.
#include <splinertia/detail/pi.hpp>
#include <splinertia/group/detail/rigid_motion.hpp>
#include <splinertia/group/detail/rotation.hpp>

#include "golden_checks.hpp"

namespace golden {

namespace {

constexpr long double pi = splinertia::detail::pi_of<long double>();

/// The coefficients of a row of lie_coeffs in their order, each with the size of the terms that it is defined by: a
/// difference such as dA1 = c₃ − c₂ cannot know better than its terms.
template <typename Scalar>
struct Coefficient {
  const char* name;
  Scalar value;
  long double terms;
};

template <typename Scalar>
[[nodiscard]] std::vector<Coefficient<Scalar>> coefficients(const Scalar& theta) {
  const auto c = splinertia::detail::stumpff<7>(Scalar(theta * theta));
  const auto& f = c.full;
  const auto sum = [](long double a, Scalar x, long double b, Scalar y, long double d = 0, Scalar z = 0) {
    return a * std::abs(static_cast<long double>(x)) + b * std::abs(static_cast<long double>(y)) +
           d * std::abs(static_cast<long double>(z));
  };
  const Scalar half = Scalar(1) / Scalar(2);
  return {
      {"sin(t/2)/t", c.half[1] * half, 0},
      {"cos(t/2)", c.half[0], 1},  // of unit size: with sin(t/2) it makes the quaternion
      {"A1", f[1], std::abs(static_cast<long double>(c.half[1]))},  // c₁ = cos(θ/2) h₁
      {"A2", f[2], 0},
      {"A3", f[3], 0},
      {"A4", f[4], 0},
      {"A5", f[5], 0},
      {"B5", -half * splinertia::detail::stumpff_derivative<3>(c), sum(0.5L, f[4], 1.5L, f[5])},
      {"E", splinertia::detail::inverse_jacobian_coefficient(c), 0},
      {"dA1", splinertia::detail::stumpff_derivative<1>(c), sum(1, f[3], 1, f[2])},
      {"dA2", splinertia::detail::stumpff_derivative<2>(c), sum(2, f[4], 1, f[3])},
      {"dA3", splinertia::detail::stumpff_derivative<3>(c), sum(3, f[5], 1, f[4])},
      {"dA4", splinertia::detail::stumpff_derivative<4>(c), sum(4, f[6], 1, f[5])},
      {"dB5",
       half * (splinertia::detail::stumpff_derivative<4>(c) - Scalar(3) * splinertia::detail::stumpff_derivative<5>(c)),
       sum(3.5L, f[6], 0.5L, f[5], 7.5L, f[7])},
      {"dE", splinertia::detail::inverse_jacobian_coefficient_derivative(c),
       sum(0.75L, c.half[4], 0.25L, c.half[3], 0.75L, c.half[5]) / (4 * std::abs(static_cast<long double>(c.half[1])))},
  };
}

/// θ |df/dθ| for coefficient i, from the table's (df/dθ)/θ where there is a column of it, else a bound.
[[nodiscard]] long double angle_condition(std::size_t i, long double theta, const Numbers& gold) {
  constexpr int derivative[15] = {-1, -1, 9, 10, 11, 12, -1, 13, 14, -1, -1, -1, -1, -1, -1};
  if (derivative[i] >= 0) return theta * theta * std::abs(gold[static_cast<std::size_t>(derivative[i])]);
  if (i < 2) return theta;
  // Half of the distance to the pole for E's derivative, the order of the zero otherwise.
  return std::abs(gold[i]) * (i == 14 ? 2 * theta / std::abs(2 * pi - theta) : theta);
}

template <typename Scalar>
void check_coefficients(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  const auto theta = row.input<Scalar>("theta");
  const auto gold = row.outputs("c");
  const auto got = coefficients(theta);
  if (gold.size() != got.size()) throw std::runtime_error("lie_coeffs: a row has not 15 coefficients");
  for (std::size_t i = 0; i < got.size(); ++i) {
    const long double condition = angle_condition(i, static_cast<long double>(theta), gold);
    const bool beyond = static_cast<long double>(theta) > pi;
    grader.check(got[i].name, {static_cast<long double>(got[i].value)}, {gold[i]},
                 {got[i].terms + (beyond ? condition : 0), got[i].terms + condition});
  }
}

template <typename Scalar>
void check_exp(const Row& row, Grader<Scalar>& grader, const Eigen::Matrix<Scalar, 3, 1>& phi) {
  const auto theta = static_cast<long double>(phi.norm());
  const bool beyond = theta > pi;
  const long double scale = beyond ? theta / 2 : 0;
  const auto q = splinertia::detail::rotation_exp<Scalar>(phi);
  const auto gold = row.outputs("exp_q");
  // The vector part alone, too: it must be right relative to itself for small angles.
  const auto got = signed_like(gold, flat(q.coeffs()));
  grader.check("exp_q", got, gold, {scale, theta / 2});
  grader.check("exp_q, vector part", part(got, 0, 3), part(gold, 0, 3), {scale, theta / 2});

  Eigen::Matrix<Scalar, 3, 3> R;
  for (int i = 0; i < 3; ++i) R.col(i) = splinertia::detail::rotate<Scalar>(q, Eigen::Matrix<Scalar, 3, 1>::Unit(i));
  grader.check("R", flat(R), row.outputs("R"), {beyond ? theta : 1, 1 + theta});  // of unit size

  // log after exp: the rounding of exp's result, eps of a unit quaternion, is in it beside log's own. Near π the
  // principal log of the rounded quaternion may be on the other branch.
  Numbers expected = row.outputs("log_exp");
  const auto log = splinertia::detail::rotation_log<Scalar>(q);
  const auto opposite = [&](const Numbers& a) { return a[0] * log[0] + a[1] * log[1] + a[2] * log[2] < 0; };
  const long double angle = std::hypot(std::hypot(expected[0], expected[1]), expected[2]);
  if (angle > pi * (1 - 8 * static_cast<long double>(std::numeric_limits<Scalar>::epsilon())) && opposite(expected)) {
    for (long double& x : expected) x *= 1 - 2 * pi / angle;
  }
  grader.check("log_exp", flat(log), expected, {beyond ? theta : magnitude(expected), theta + magnitude(expected)});
}

template <typename Scalar>
void check_so3_lie_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  using Vector = Eigen::Vector3<Scalar>;
  const Vector phi = input_vector<Scalar, 3>(row, "phi");
  check_exp<Scalar>(row, grader, phi);
  const bool beyond = static_cast<long double>(phi.norm()) > pi;
  const auto jacobian = [&](const char* name, const char* derivative, const auto& got) {
    const long double cond = entry_condition(phi, row.outputs(derivative));
    grader.check(name, flat(got), row.outputs(name), {beyond ? cond : 0, cond});
  };
  jacobian("Jl", "dJl", splinertia::detail::rotation_left_jacobian<Scalar>(phi));
  jacobian("Jr", "dJr", splinertia::detail::rotation_left_jacobian<Scalar>(-phi));
  jacobian("Jl_inv", "dJl_inv", splinertia::detail::rotation_left_jacobian_inverse<Scalar>(phi));
  jacobian("Jr_inv", "dJr_inv", splinertia::detail::rotation_left_jacobian_inverse<Scalar>(-phi));

  // The derivative of a Jacobian by φ_i is the dual part of SE(3)'s at ρ = e_i; J_r(φ) = J_l(−φ). Beyond π the rounding
  // of θ counts as above, for the inverses with their pole at 2π.
  const long double theta = static_cast<long double>(phi.norm());
  const auto derivative = [&](const char* name, Scalar sign, long double pole, const auto& f) {
    Numbers got;
    for (int i = 0; i < 3; ++i) {
      const Numbers entries = flat(sign * f(Vector::Unit(i), Vector(sign * phi)).dual);
      got.insert(got.end(), entries.begin(), entries.end());
    }
    const Numbers gold = row.outputs(name);
    const long double cond = theta * magnitude(gold) * (1 + pole);
    grader.check(name, got, gold, {beyond ? cond : 0, cond});
  };
  const auto f = [](const Vector& rho, const Vector& at) {
    return splinertia::detail::rigid_motion_left_jacobian<Scalar>(rho, at);
  };
  const auto f_inverse = [](const Vector& rho, const Vector& at) {
    return splinertia::detail::rigid_motion_left_jacobian_inverse<Scalar>(rho, at);
  };
  const long double pole = 2 / (2 * pi - theta);
  derivative("dJl", Scalar(1), 0, f);
  derivative("dJr", Scalar(-1), 0, f);
  derivative("dJl_inv", Scalar(1), pole, f_inverse);
  derivative("dJr_inv", Scalar(-1), pole, f_inverse);
}

template <typename Scalar>
void check_so3_log_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  const auto q = input_vector<Scalar, 4>(row, "q");
  const auto log = splinertia::detail::rotation_log<Scalar>(Eigen::Quaternion<Scalar>(q[3], q[0], q[1], q[2]));
  // θ |dθ/dlog(q)| ≤ θ: rounding q changes no more than rounding the result.
  Numbers gold = row.outputs("log");
  if (std::is_same_v<Scalar, float> && q[3] == 0 && row.inputs<double>("q").at(3) < 0) {
    for (long double& x : gold) x = -x;  // w < 0 became −0 in float, which does not fold
  }
  grader.check("log", flat(log), gold);
}

}  // namespace

void check_lie_coeffs(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_coefficients<Scalar>(row, report); });
}

void check_so3_lie(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_so3_lie_row<Scalar>(row, report); });
}

void check_so3_log(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_so3_log_row<Scalar>(row, report); });
}

}  // namespace golden
