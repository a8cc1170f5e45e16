// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/version.h>

#if CERES_VERSION_MAJOR < 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR < 1)
#error "splinertia/adapters/ceres needs Ceres Solver 2.1 or newer, the first with ceres::Manifold"
#endif

#include <ceres/manifold.h>

#include <splinertia/group/parameters.hpp>

namespace splinertia {

namespace detail {

/// A matrix in the memory layout of Ceres: row-major.
template <int Rows, int Columns>
using CeresMatrix = Eigen::Matrix<double, Rows, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

}  // namespace detail

/// Right perturbations x ⊞ δ = x exp(δ) of a parameter block that holds an element of G in the layout of
/// group/parameters.hpp, which is that of Sophus:
///
///   problem.AddParameterBlock(T.data(), 7, new CeresManifold<Sophus::SE3d>);
///
/// The ambient size is parameter_count<G>, the tangent size Dof, with tangents in the order of G; y ⊟ x = log(x⁻¹ y).
/// Jacobians are analytic. Requires blocks on the group, e.g. unit quaternions; each step changes their norm by about
/// eps through rounding.
template <LieGroup G>
  requires std::same_as<ScalarOf<G>, double>
class CeresManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return parameter_count<G>; }
  int TangentSize() const override { return DofOf<G>; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    using Traits = GroupTraits<G>;
    const Tangent<G> tau = Eigen::Map<const Tangent<G>>(delta);
    write_parameters<G>(Traits::compose(read_parameters<G>(x), Traits::exp(tau)), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<detail::CeresMatrix<parameter_count<G>, DofOf<G>>>{jacobian} =
        ParameterLayout<G>::tangent_to_parameters(read_parameters<G>(x));
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Tangent<G>>{y_minus_x} = increment<G>(read_parameters<G>(x), read_parameters<G>(y));
    return true;
  }
  bool MinusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<detail::CeresMatrix<DofOf<G>, parameter_count<G>>>{jacobian} =
        ParameterLayout<G>::parameters_to_tangent(read_parameters<G>(x));
    return true;
  }
};

}  // namespace splinertia
