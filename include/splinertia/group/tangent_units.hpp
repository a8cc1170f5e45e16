// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>
#include <utility>

namespace splinertia {

/// Calls f(first row, number of rows) for each part of a tangent vector that has one unit: translation and rotation of
/// a rigid motion, and the parts of each factor of a product. It recognises types with Sophus' accessors so3() and
/// so2().
template <LieGroup G>
struct TangentUnits {
  static void for_each(const auto& f) {
    constexpr int rotation = requires(const G& x) { x.so3(); } ? 3 : requires(const G& x) { x.so2(); } ? 1 : DofOf<G>;
    if constexpr (rotation < DofOf<G>) f(0, DofOf<G> - rotation);
    f(DofOf<G> - rotation, rotation);
  }
};

template <typename... F>
struct TangentUnits<Product<F...>> {
  static void for_each(const auto& f) {
    [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      (TangentUnits<F>::for_each([&](int first, int rows) { f(Product<F...>::template offset<Index> + first, rows); }),
       ...);
    }(std::index_sequence_for<F...>{});
  }
};

}  // namespace splinertia
