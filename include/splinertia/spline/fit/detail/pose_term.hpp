// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/fit/robust_loss.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// Calls f(first row, number of rows), both std::integral_constant, for each part of a tangent vector that has a norm
/// of its own: the factors of a product, otherwise the whole vector.
template <typename G>
struct TangentParts {
  static void for_each(const auto& f) { f(std::integral_constant<int, 0>{}, std::integral_constant<int, DofOf<G>>{}); }
};
template <typename... F>
struct TangentParts<Product<F...>> {
  static void for_each(const auto& f) {
    using G = Product<F...>;
    for_each_factor<G>([&]<std::size_t Index, typename Factor>() {
      f(std::integral_constant<int, G::template offset<Index>>{}, std::integral_constant<int, DofOf<Factor>>{});
    });
  }
};

/// The distances of a curve from stamped poses as a least-squares cost: r = log(pose⁻¹ · curve)/standard deviation,
/// through a loss. The loss applies to each factor of a product separately, so that a jump of the position does not
/// reduce the weight of the rotation.
template <typename Curve>
class PoseTerm {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// Stores references to `poses` and `weights` (one per pose, or none).
  PoseTerm(std::reference_wrapper<const PosesOf<Curve>> poses,
           std::reference_wrapper<const std::vector<Scalar>> weights, const Tangent<G>& standard_deviation,
           const RobustLoss& loss)
      : poses_(poses), weights_(weights), inverse_deviation_(standard_deviation.cwiseInverse()), loss_(loss) {}

  template <typename System>
  Scalar add(const Curve& curve, System& system) const {
    using std::sqrt;
    Scalar cost(0);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Scalar weight = weights_.empty() ? Scalar(1) : weights_[i];
      if (weight == Scalar(0)) continue;
      const auto at = curve.template linearize<0>(poses_[i].time);
      const Tangent<G> r = increment<G>(poses_[i].value, at.value);
      const Tangent<G> whitened = inverse_deviation_.cwiseProduct(r);
      Jacobian<G> by_value = Jacobian<G>::Identity();
      if constexpr (!is_commutative<G>) by_value = right_jacobian_inverse<G>(r);
      TangentParts<G>::for_each([&](auto first, auto rows) {
        using Part = Eigen::Matrix<Scalar, rows, 1>;
        using PartJacobian = Eigen::Matrix<Scalar, rows, rows>;
        const Part part = whitened.template segment<rows>(first);
        const Scalar square = weight * part.squaredNorm();
        cost += loss_.cost(square);
        const Scalar root = sqrt(weight * loss_.weight(square));
        const PartJacobian outer = (root * inverse_deviation_.template segment<rows>(first)).asDiagonal() *
                                   by_value.template block<rows, rows>(first, first);
        std::array<PartJacobian, Curve::order> J;
        for (std::size_t j = 0; j < J.size(); ++j) {
          J[j] = outer.lazyProduct(at.value_jacobian[j].template block<rows, rows>(first, first));
        }
        system.template add<first>(at.first, Part(root * part), J);
      });
    }
    return cost;
  }

 private:
  const PosesOf<Curve>& poses_;
  const std::vector<Scalar>& weights_;
  Tangent<G> inverse_deviation_;
  RobustLoss loss_;
};

}  // namespace splinertia::detail
