// SPDX-License-Identifier: MIT
/// The direct product of Lie groups: every operation acts factor by factor.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/lie_group.hpp>
#include <tuple>
#include <utility>

namespace splinertia {

/// An element of G₁ × G₂ × …; the tangent concatenates those of the factors in their order.
///
///   Product<Sophus::SO3d, Eigen::Vector3d> x{R, p};
///   x.get<0>();               // R
///   const auto& [R, p] = x;   // structured bindings
template <LieGroup... G>
class Product {
 public:
  static_assert(sizeof...(G) > 0, "a product has at least one factor");
  static constexpr std::size_t size = sizeof...(G);

  template <std::size_t Index>
  using Factor = std::tuple_element_t<Index, std::tuple<G...>>;

  /// The first row of factor I in the tangent of the product.
  template <std::size_t Index>
  static constexpr int offset = [] {
    constexpr std::array<int, size> dof{DofOf<G>...};
    int sum = 0;
    for (std::size_t i = 0; i < Index; ++i) sum += dof[i];
    return sum;
  }();

  /// The identity.
  Product() : factors_{GroupTraits<G>::identity()...} {}
  Product(const G&... factors) : factors_{factors...} {}

  template <std::size_t Index>
  [[nodiscard]] const Factor<Index>& get() const {
    return std::get<Index>(factors_);
  }
  template <std::size_t Index>
  [[nodiscard]] Factor<Index>& get() {
    return std::get<Index>(factors_);
  }

 private:
  std::tuple<G...> factors_;
};

template <LieGroup... G>
  requires(std::same_as<ScalarOf<G>, ScalarOf<std::tuple_element_t<0, std::tuple<G...>>>> && ...)
struct GroupTraits<Product<G...>> {
  using P = Product<G...>;
  using Scalar = ScalarOf<std::tuple_element_t<0, std::tuple<G...>>>;
  static constexpr int Dof = (DofOf<G> + ...);
  static constexpr bool commutative = (detail::is_commutative<G> && ...);
  using Vector = Eigen::Matrix<Scalar, Dof, 1>;
  using Square = Eigen::Matrix<Scalar, Dof, Dof>;

  static P identity() { return P{}; }
  static P compose(const P& x, const P& y) {
    return factors([&]<std::size_t Index, typename F>() {
      return GroupTraits<F>::compose(x.template get<Index>(), y.template get<Index>());
    });
  }
  static P inverse(const P& x) {
    return factors([&]<std::size_t Index, typename F>() { return GroupTraits<F>::inverse(x.template get<Index>()); });
  }
  static P exp(const Vector& tau) {
    return factors([&]<std::size_t Index, typename F>() { return GroupTraits<F>::exp(part<Index>(tau)); });
  }
  static Vector log(const P& x) {
    return tangents([&]<std::size_t Index, typename F>() { return GroupTraits<F>::log(x.template get<Index>()); });
  }
  static Vector adjoint(const P& x, const Vector& tau) {
    return tangents([&]<std::size_t Index, typename F>() {
      return GroupTraits<F>::adjoint(x.template get<Index>(), part<Index>(tau));
    });
  }
  static Vector adjoint_inverse(const P& x, const Vector& tau) {
    return tangents([&]<std::size_t Index, typename F>() {
      return splinertia::adjoint_inverse<F>(x.template get<Index>(), part<Index>(tau));
    });
  }
  static Vector bracket(const Vector& a, const Vector& b) {
    return tangents(
        [&]<std::size_t Index, typename F>() { return GroupTraits<F>::bracket(part<Index>(a), part<Index>(b)); });
  }
  static Vector increment(const P& x, const P& y) {
    return tangents([&]<std::size_t Index, typename F>() {
      return splinertia::increment<F>(x.template get<Index>(), y.template get<Index>());
    });
  }
  static Scalar drift(const P& x) {
    Scalar worst(0);
    detail::for_each_factor<P>([&]<std::size_t Index, typename F>() {
      if constexpr (requires { GroupTraits<F>::drift(x.template get<Index>()); }) {
        worst = (std::max)(worst, GroupTraits<F>::drift(x.template get<Index>()));
      }
    });
    return worst;
  }
  static P normalized(const P& x) {
    return factors([&]<std::size_t Index, typename F>() {
      if constexpr (requires { GroupTraits<F>::normalized(x.template get<Index>()); }) {
        return GroupTraits<F>::normalized(x.template get<Index>());
      } else {
        return x.template get<Index>();
      }
    });
  }
  static Square left_jacobian(const Vector& tau)
    requires(LieGroupWithJacobians<G> && ...)
  {
    return blocks([&]<std::size_t Index, typename F>() { return GroupTraits<F>::left_jacobian(part<Index>(tau)); });
  }
  static Square left_jacobian_inverse(const Vector& tau)
    requires(LieGroupWithJacobians<G> && ...)
  {
    return blocks(
        [&]<std::size_t Index, typename F>() { return GroupTraits<F>::left_jacobian_inverse(part<Index>(tau)); });
  }

  /// The rows of factor I in a tangent, or in any column of Dof rows.
  template <std::size_t Index>
  static auto part(const Vector& tau) {
    using F = typename P::template Factor<Index>;
    return Tangent<F>{tau.template segment<DofOf<F>>(P::template offset<Index>)};
  }

 private:
  // f<I, F>() gives the result for factor I of type F.
  static P factors(const auto& f) {
    return [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      return P { f.template operator()<Index, G>()... };
    }(std::index_sequence_for<G...>{});
  }
  static Vector tangents(const auto& f) {
    Vector tau;
    detail::for_each_factor<P>([&]<std::size_t Index, typename F>() {
      tau.template segment<DofOf<F>>(P::template offset<Index>) = f.template operator()<Index, F>();
    });
    return tau;
  }
  static Square blocks(const auto& f) {
    Square m = Square::Zero();
    detail::for_each_factor<P>([&]<std::size_t Index, typename F>() {
      constexpr int offset = P::template offset<Index>;
      m.template block<DofOf<F>, DofOf<F>>(offset, offset) = f.template operator()<Index, F>();
    });
    return m;
  }
};

}  // namespace splinertia

// Structured bindings.
template <typename... G>
struct std::tuple_size<splinertia::Product<G...>> : std::integral_constant<std::size_t, sizeof...(G)> {};
template <std::size_t Index, typename... G>
struct std::tuple_element<Index, splinertia::Product<G...>> : std::tuple_element<Index, std::tuple<G...>> {};
