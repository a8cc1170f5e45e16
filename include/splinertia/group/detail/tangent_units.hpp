// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>

namespace splinertia::detail {

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
    using G = Product<F...>;
    for_each_factor<G>([&]<std::size_t Index, typename Factor>() {
      TangentUnits<Factor>::for_each([&](int first, int rows) { f(G::template offset<Index> + first, rows); });
    });
  }
};

}  // namespace splinertia::detail
