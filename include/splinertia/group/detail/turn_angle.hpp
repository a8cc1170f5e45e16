// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>

namespace splinertia::detail {

/// TurnAngle<G>::of(δ) is the rotation angle of exp(δ), rad: 0 for groups without rotations, the largest of the factors
/// for a product. It recognises types with Sophus' accessors: unit_quaternion(), so3(), unit_complex(), so2().
/// Specialise it for the rotations of another library.
template <LieGroup G>
struct TurnAngle {
  using Scalar = ScalarOf<G>;

  [[nodiscard]] static Scalar of(const Tangent<G>& delta) {
    using std::abs;
    if constexpr (requires(const G& x) { x.so3(); }) {
      return delta.template tail<3>().norm();
    } else if constexpr (requires(const G& x) { x.unit_quaternion(); }) {
      return delta.norm();
    } else if constexpr (requires(const G& x) { x.so2(); } || requires(const G& x) { x.unit_complex(); }) {
      return abs(delta[DofOf<G> - 1]);
    } else {
      return Scalar(0);
    }
  }
};

template <typename... F>
struct TurnAngle<Product<F...>> {
  using G = Product<F...>;

  [[nodiscard]] static ScalarOf<G> of(const Tangent<G>& delta) {
    ScalarOf<G> largest(0);
    for_each_factor<G>([&]<std::size_t Index, typename Factor>() {
      const auto part = delta.template segment<DofOf<Factor>>(G::template offset<Index>);
      largest = (std::max)(largest, TurnAngle<Factor>::of(part));
    });
    return largest;
  }
};

}  // namespace splinertia::detail
