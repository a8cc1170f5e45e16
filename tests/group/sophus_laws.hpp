// SPDX-License-Identifier: MIT
/// group_laws.hpp for Sophus' groups and products.
#pragma once

#include <splinertia/group/pose.hpp>

#include "group/group_laws.hpp"

namespace laws {

/// The entries of a matrix, column by column.
template <typename Derived>
[[nodiscard]] Vector entries(const Eigen::MatrixBase<Derived>& m) {
  const Matrix wide = m.template cast<Real>();
  return Eigen::Map<const Vector>(wide.data(), wide.size());
}

template <typename Scalar>
struct Describe<Sophus::SO2<Scalar>> {
  static Parts parts() { return {{{0, 1}}, {}}; }
  static Vector numbers(const Sophus::SO2<Scalar>& x) { return entries(x.matrix()); }
};
template <typename Scalar>
struct Describe<Sophus::SO3<Scalar>> {
  static Parts parts() { return {{{0, 3}}, {}}; }
  static Vector numbers(const Sophus::SO3<Scalar>& x) { return entries(x.matrix()); }
};
template <typename Scalar>
struct Describe<Sophus::SE2<Scalar>> {
  static Parts parts() { return {{{2, 1}}, {{0, 2}}}; }
  static Vector numbers(const Sophus::SE2<Scalar>& x) { return entries(x.matrix()); }
};
template <typename Scalar>
struct Describe<Sophus::SE3<Scalar>> {
  static Parts parts() { return {{{3, 3}}, {{0, 3}}}; }
  static Vector numbers(const Sophus::SE3<Scalar>& x) { return entries(x.matrix()); }
};

template <typename... F>
struct Describe<splinertia::Product<F...>> {
  using P = splinertia::Product<F...>;
  static Parts parts() {
    Parts all;
    int offset = 0;
    const auto add = [&](const Parts& of_factor, int dof) {
      for (const auto& [begin, size] : of_factor.rotations) all.rotations.emplace_back(offset + begin, size);
      for (const auto& [begin, size] : of_factor.translations) all.translations.emplace_back(offset + begin, size);
      offset += dof;
    };
    (add(Describe<F>::parts(), splinertia::DofOf<F>), ...);
    return all;
  }
  static Vector numbers(const P& x) {
    Vector all;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      const auto add = [&](const Vector& values) {
        all.conservativeResize(all.size() + values.size());
        all.tail(values.size()) = values;
      };
      (add(Describe<F>::numbers(x.template get<I>())), ...);
    }(std::index_sequence_for<F...>{});
    return all;
  }
};

}  // namespace laws
