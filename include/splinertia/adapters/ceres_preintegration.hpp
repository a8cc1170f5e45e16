// SPDX-License-Identifier: MIT
/// The residual of a preintegrated IMU between two states.
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <splinertia/adapters/ceres_manifold.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/strapdown/preintegration/detail/imu_covariance.hpp>
#include <splinertia/strapdown/preintegration/preintegration_residual.hpp>
#include <stdexcept>

namespace splinertia {

namespace detail {

/// The lower triangular W with WᵀW = P⁻¹ for the covariance P of a preintegrated motion. Throws std::invalid_argument
/// if P is singular: if a noise density is zero, or for a single step, whose position follows from its velocity.
[[nodiscard]] inline Eigen::Matrix<double, 15, 15> square_root_information(const ImuCovariance<double>& covariance) {
  using Matrix15 = Eigen::Matrix<double, 15, 15>;
  const Matrix15 P = covariance.matrix();
  const auto singular = [](Eigen::Index i, const char* why) {
    constexpr const char* parts[] = {"attitude", "velocity", "position", "gyro bias", "accel bias"};
    refuse<std::invalid_argument>("square_root_information: ", "the covariance is singular, ", parts[i / 3],
                                  " component ", i % 3, ' ', why,
                                  "; expected noise densities > 0 and at least two steps");
  };
  // Scaled so that units do not matter: P = D C D with ones on the diagonal of C = L Lᵀ.
  Eigen::Matrix<double, 15, 1> d;
  for (Eigen::Index i = 0; i < 15; ++i) {
    if (!(P(i, i) > 0 && P(i, i) <= (std::numeric_limits<double>::max)())) singular(i, "has no variance");
    d[i] = 1 / std::sqrt(P(i, i));
  }
  const Matrix15 C = d.asDiagonal() * P * d.asDiagonal();
  constexpr double rounding = 1000 * std::numeric_limits<double>::epsilon();
  Matrix15 L = Matrix15::Zero();
  for (Eigen::Index i = 0; i < 15; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) L(i, j) = (C(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
    // The variance that is left when the components before it are known.
    const double left = 1 - L.row(i).head(i).squaredNorm();
    if (!(left > rounding)) singular(i, "is determined by the components before it");
    L(i, i) = std::sqrt(left);
  }
  Matrix15 W = d.asDiagonal();
  L.triangularView<Eigen::Lower>().solveInPlace(W);
  return W;
}

}  // namespace detail

/// r = W · preintegration_residual, with W = square_root_information of the covariance of the preintegrated motion.
/// Gravity, the acceleration of free fall in the world in m/s², is fixed.
///
/// Blocks: R_i (4), v_i (3), p_i (3), biases_i (6: gyro, accel) of the state at the beginning, then R_j, v_j, p_j,
/// biases_j of that at the end. Give each rotation a CeresManifold<Sophus::SO3d>, or hold it constant:
///
///   problem.AddParameterBlock(state.R_WB.data(), 4, new CeresManifold<Sophus::SO3d>);
///   problem.AddResidualBlock(new CeresPreintegrationResidual(preintegrator.result(), gravity), nullptr,
///                            a.R_WB.data(), a.v_WB.data(), a.p_WB.data(), a_biases.data(),
///                            b.R_WB.data(), b.v_WB.data(), b.p_WB.data(), b_biases.data());
class CeresPreintegrationResidual final : public ceres::SizedCostFunction<15, 4, 3, 3, 6, 4, 3, 3, 6> {
 public:
  using Preintegrated = PreintegratedImu<double, detail::ImuCovariance<double>>;

  /// Throws std::invalid_argument if the covariance is singular.
  CeresPreintegrationResidual(const Preintegrated& imu, const Eigen::Vector3<double>& gravity)
      : imu_(imu), gravity_(gravity), weight_(detail::square_root_information(imu.covariance())) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const State i(parameters), j(parameters + blocks);
    Eigen::Map<detail::PreintegrationResidual<double>> r(residuals);
    if (jacobians == nullptr) {
      r = weight_ * preintegration_residual(imu_, i.state, i.bias, j.state, j.bias, gravity_);
      return true;
    }
    const auto l = linearize_preintegration_residual(imu_, i.state, i.bias, j.state, j.bias, gravity_);
    r = weight_ * l.value;
    write_jacobians(jacobians, i, weight_ * l.state_i, weight_ * l.bias_i);
    write_jacobians(jacobians + blocks, j, weight_ * l.state_j, weight_ * l.bias_j);
    return true;
  }

 private:
  static constexpr int blocks = 4;  // per state

  struct State {
    NavState<double> state;
    ImuBias<double> bias;

    explicit State(double const* const* parameters)
        : state{read_parameters<Sophus::SO3d>(parameters[0]), Eigen::Map<const Eigen::Vector3<double>>(parameters[1]),
                Eigen::Map<const Eigen::Vector3<double>>(parameters[2]), 0.0},
          bias{Eigen::Map<const Eigen::Vector3<double>>(parameters[3]),
               Eigen::Map<const Eigen::Vector3<double>>(parameters[3] + 3)} {}
  };

  // Ceres passes a null pointer for each block that is held constant.
  static void write_jacobians(double** jacobians, const State& at, const Eigen::Matrix<double, 15, 9>& by_state,
                              const Eigen::Matrix<double, 15, 6>& by_bias) {
    // Ceres multiplies this by the manifold's PlusJacobian. The product is the derivative by the tangent.
    if (jacobians[0] != nullptr) {
      Eigen::Map<detail::CeresMatrix<15, 4>>{jacobians[0]} =
          by_state.leftCols<3>() * ParameterLayout<Sophus::SO3d>::parameters_to_tangent(at.state.R_WB);
    }
    if (jacobians[1] != nullptr) Eigen::Map<detail::CeresMatrix<15, 3>>{jacobians[1]} = by_state.middleCols<3>(3);
    if (jacobians[2] != nullptr) Eigen::Map<detail::CeresMatrix<15, 3>>{jacobians[2]} = by_state.rightCols<3>();
    if (jacobians[3] != nullptr) Eigen::Map<detail::CeresMatrix<15, 6>>{jacobians[3]} = by_bias;
  }

  Preintegrated imu_;
  Eigen::Vector3<double> gravity_;
  Eigen::Matrix<double, 15, 15> weight_;
};

}  // namespace splinertia
