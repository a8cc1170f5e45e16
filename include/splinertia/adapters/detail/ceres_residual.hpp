// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/cost_function.h>

#include <cstddef>
#include <initializer_list>
#include <splinertia/adapters/ceres_manifold.hpp>
#include <splinertia/spline/parameter_blocks.hpp>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// Base class for residuals of a measurement of a curve: M numbers that depend on the Order control points that shape
/// the curve there, laid out as in spline/parameter_blocks.hpp, and on other parameter blocks after those:
///
///   SE3, order 4:      T_0 T_1 T_2 T_3, others                           7 numbers each
///   SO3xR3, order 4:   R_0 R_1 R_2 R_3 p_0 p_1 p_2 p_3, others           4 and 3 numbers each
///
/// Give each control point block the CeresManifold of its group, or hold it constant.
///
/// Ceres expects derivatives by the numbers of a block and multiplies them by the manifold's PlusJacobian. A derivative
/// J by a tangent is therefore passed as J · parameters_to_tangent, whose product with PlusJacobian is J.
template <LieGroup G, int Order, int M>
  requires std::same_as<ScalarOf<G>, double>
class CeresResidual : public ceres::CostFunction {
 public:
  static constexpr int control_point_blocks = Order * static_cast<int>(ControlPointParts<G>::count);

 protected:
  using Residual = Eigen::Matrix<double, M, 1>;
  using Weight = Eigen::Matrix<double, M, M>;
  using Points = std::array<G, static_cast<std::size_t>(Order)>;
  using Span = std::span<const G, static_cast<std::size_t>(Order)>;

  template <std::size_t Index>
  using Part = std::remove_cvref_t<decltype(ControlPointParts<G>::template part<Index>(std::declval<G&>()))>;

  explicit CeresResidual(std::initializer_list<int> others) {
    set_num_residuals(M);
    auto& sizes = *mutable_parameter_block_sizes();
    for_each_part<G>([&]<std::size_t Index>() { sizes.insert(sizes.end(), Order, parameter_count<Part<Index>>); });
    sizes.insert(sizes.end(), others);
  }

  /// Writes the Jacobian (M × Dof) with respect to a tangent at x, which is control point j, block by block. Blocks
  /// that are held constant have a null pointer and are skipped.
  static void write_jacobian(double** jacobians, std::size_t j, const G& x,
                             const Eigen::Matrix<double, M, DofOf<G>>& J) {
    for_each_part<G>([&]<std::size_t Index>() {
      double* block = jacobians[Index * static_cast<std::size_t>(Order) + j];
      if (block == nullptr) return;
      Eigen::Map<CeresMatrix<M, parameter_count<Part<Index>>>>{block} =
          J.template middleCols<DofOf<Part<Index>>>(ControlPointParts<G>::template offset<Index>) *
          ParameterLayout<Part<Index>>::parameters_to_tangent(ControlPointParts<G>::template part<Index>(x));
    });
  }

  /// Writes the Jacobian (M × N) with respect to block `other` of those after the control points.
  template <int N>
  static void write_other_jacobian(double** jacobians, int other, const Eigen::Matrix<double, M, N>& J) {
    double* block = jacobians[control_point_blocks + other];
    if (block != nullptr) Eigen::Map<CeresMatrix<M, N>>{block} = J;
  }
};

}  // namespace splinertia::detail
