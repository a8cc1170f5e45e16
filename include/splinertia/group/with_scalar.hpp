// SPDX-License-Identifier: MIT
/// The same group over another scalar: float for double, ceres::Jet for derivatives, SimdPack (a SIMD pack) for several
/// elements at once.
#pragma once

#include <array>
#include <cstddef>
#include <splinertia/detail/simd_pack.hpp>
#include <splinertia/group/parameters.hpp>

namespace splinertia {

/// Customisation point. Specialise it for a group G whose exp_of_fraction(), compose() and Adjoint work for any scalar
/// S without branching on one. `using type` is the same group over S, with the same numbers in the same order
/// (ParameterLayout).
template <typename G, typename S>
struct WithScalarOf {};
template <typename Scalar, int N, typename S>
struct WithScalarOf<Eigen::Matrix<Scalar, N, 1>, S> {
  using type = Eigen::Matrix<S, N, 1>;
};
template <typename Scalar, typename S>
struct WithScalarOf<Sophus::SO3<Scalar>, S> {
  using type = Sophus::SO3<S>;
};
template <typename Scalar, typename S>
struct WithScalarOf<Sophus::SE3<Scalar>, S> {
  using type = Sophus::SE3<S>;
};
template <typename... F, typename S>
  requires(requires { typename WithScalarOf<F, S>::type; } && ...)
struct WithScalarOf<Product<F...>, S> {
  using type = Product<typename WithScalarOf<F, S>::type...>;
};

template <typename G, typename S>
using WithScalar = typename WithScalarOf<G, S>::type;

namespace detail {

/// G also works over the SIMD pack L.
template <typename G, typename L>
concept HasSimdPack = HasParameterLayout<G> && requires { typename WithScalarOf<G, L>::type; };

/// x with numbers of type S, each rounded once. If S is SimdPack, every lane holds x.
template <typename S, HasParameterLayout G>
  requires requires { typename WithScalarOf<G, S>::type; }
[[nodiscard]] inline WithScalar<G, S> with_scalar(const G& x) {
  std::array<ScalarOf<G>, parameter_count<G>> numbers;
  write_parameters(x, numbers.data());
  std::array<S, parameter_count<G>> cast;
  for (std::size_t i = 0; i < numbers.size(); ++i) cast[i] = S(numbers[i]);
  return read_parameters<WithScalar<G, S>>(cast.data());
}

}  // namespace detail

}  // namespace splinertia
