// SPDX-License-Identifier: MIT
/// Parameters of error terms and their checks.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <splinertia/detail/require.hpp>
#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// A parameter of a three-axis sensor: one value for all axes or one for each.
template <typename Scalar_>
class PerAxis {
 public:
  using Scalar = Scalar_;

  constexpr PerAxis(Scalar all) : values_{all, all, all} {}
  constexpr PerAxis(Scalar x, Scalar y, Scalar z) : values_{x, y, z} {}
  template <typename Derived>
    requires(Derived::SizeAtCompileTime == 3)
  PerAxis(const Eigen::MatrixBase<Derived>& v) : values_{v.x(), v.y(), v.z()} {}

  [[nodiscard]] constexpr const Scalar& operator[](std::size_t axis) const { return values_[axis]; }
  [[nodiscard]] constexpr auto begin() const { return values_.begin(); }
  [[nodiscard]] constexpr auto end() const { return values_.end(); }
  [[nodiscard]] Vector3<Scalar> vector() const { return {values_[0], values_[1], values_[2]}; }

 private:
  std::array<Scalar, 3> values_;
};

template <typename Scalar>
constexpr void require_finite(const char* term, const char* parameter, const PerAxis<Scalar>& values) {
  for (const Scalar& value : values) require_finite(term, parameter, value);
}

template <typename Scalar>
constexpr void require_non_negative(const char* term, const char* parameter, const PerAxis<Scalar>& values) {
  for (const Scalar& value : values) require_non_negative(term, parameter, value);
}

template <typename Scalar>
constexpr void require_positive(const char* term, const char* parameter, const PerAxis<Scalar>& values) {
  for (const Scalar& value : values) require_positive(term, parameter, value);
}

template <typename Scalar>
constexpr void require_factor(const char* term, const char* parameter, const PerAxis<Scalar>& values) {
  for (const Scalar& value : values) require_factor(term, parameter, value);
}

template <typename Scalar>
void require_finite(const char* term, const char* parameter, const Matrix3<Scalar>& values) {
  for (int i = 0; i < 9; ++i) require_finite(term, parameter, values(i / 3, i % 3));
}

/// The scalar of a term whose first parameter is a P: a number (double for integers), a PerAxis, a vector or a matrix.
template <typename P>
struct ParameterScalar {};
template <std::floating_point P>
struct ParameterScalar<P> {
  using type = P;
};
template <std::integral P>
struct ParameterScalar<P> {
  using type = double;
};
template <typename P>
  requires requires { typename P::Scalar; }
struct ParameterScalar<P> {
  using type = typename P::Scalar;
};

/// For deduction guides:
///   template <typename P, typename... More> Term(const P&, const More&...) -> Term<ScalarOfParameter<P>>;
template <typename P>
using ScalarOfParameter = typename ParameterScalar<P>::type;

}  // namespace splinertia
