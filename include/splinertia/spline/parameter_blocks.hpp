// SPDX-License-Identifier: MIT
/// Evaluates curves directly on the parameter blocks of an optimiser (`double const* const*` of Ceres, or pointers into
/// your own storage), without a Spline object and without a second store of control points.
///
///   // T_0 … T_3 as 7 numbers each, anywhere in memory
///   const double* blocks[4] = {…};
///   auto m = evaluate<2, Sophus::SE3d>(blocks, basis);    // as evaluate(std::span, basis)
///   auto l = linearize<2, Sophus::SE3d>(blocks, basis);   // Jacobians by right perturbations, Dof × Dof
///
/// A block holds the parameters of group/parameters.hpp and needs only the alignment of a Scalar. Each factor of a
/// product has its own blocks: first the Order blocks of the first factor, then those of the next:
///
///   SO3xR3, order 4:   R_0 R_1 R_2 R_3 p_0 p_1 p_2 p_3
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <splinertia/group/parameters.hpp>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/spline/linearize.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

/// The parts of a control point that have their own blocks: the factors of a product, otherwise G itself.
template <typename G>
struct ControlPointParts {
  static constexpr std::size_t count = 1;
  template <std::size_t>
  static constexpr int offset = 0;  // first row of the part's tangent in that of G
  template <std::size_t>
  static auto& part(auto& x) {
    return x;
  }
};
template <typename... F>
struct ControlPointParts<Product<F...>> {
  static constexpr std::size_t count = sizeof...(F);
  template <std::size_t Index>
  static constexpr int offset = Product<F...>::template offset<Index>;
  template <std::size_t Index>
  static auto& part(auto& x) {
    return x.template get<Index>();
  }
};

/// Calls f<I>() for each part I of G.
template <LieGroup G>
inline void for_each_part(const auto& f) {
  [&]<std::size_t... Index>(std::index_sequence<Index...>) {
    (f.template operator()<Index>(), ...);
  }(std::make_index_sequence<ControlPointParts<G>::count>{});
}

/// Reads the Order control points from `blocks`, which holds Order blocks for each part of G.
template <HasParameterLayout G, int Order>
[[nodiscard]] inline std::array<G, static_cast<std::size_t>(Order)> read_control_points(
    const ScalarOf<G>* const* blocks) {
  std::array<G, static_cast<std::size_t>(Order)> points;
  for_each_part<G>([&]<std::size_t Index>() {
    for (G& x : points) {
      auto& part = ControlPointParts<G>::template part<Index>(x);
      part = read_parameters<std::remove_cvref_t<decltype(part)>>(*blocks++);
    }
  });
  return points;
}

}  // namespace detail

/// evaluate() on the control points in `blocks`. The order is that of the basis.
template <int D, HasParameterLayout G, int Order>
[[nodiscard]] inline Motion<G, D> evaluate(const ScalarOf<G>* const* blocks,
                                           const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  const auto points = detail::read_control_points<G, Order>(blocks);
  return evaluate<D, G, Order>(std::span<const G, static_cast<std::size_t>(Order)>(points), basis);
}

/// linearize() on the control points in `blocks`. The Jacobians are with respect to tangents of the control points.
/// Right-multiply by ParameterLayout<G>::parameters_to_tangent for Jacobians with respect to the numbers in the blocks.
template <int D, HasParameterLayout G, int Order>
  requires LieGroupWithJacobians<G>
[[nodiscard]] inline Linearization<G, Order, D> linearize(const ScalarOf<G>* const* blocks,
                                                          const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  const auto points = detail::read_control_points<G, Order>(blocks);
  return linearize<D, G, Order>(std::span<const G, static_cast<std::size_t>(Order)>(points), basis);
}

}  // namespace splinertia
