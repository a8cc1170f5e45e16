// SPDX-License-Identifier: MIT
/// Parameters of error terms and their checks.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/group/lie_group.hpp>
#include <type_traits>

namespace splinertia {

namespace detail {

/// The number of axes. For one that no sensor has, the message of the static_assert is all that compilers have to say.
template <int Axes>
[[nodiscard]] consteval int checked_axes() {
  static_assert(Axes >= 1,
                "a sensor has a fixed number of axes >= 1, which Eigen::Dynamic is not: PerAxis<double, 3>, "
                "sensor_errors<3>(model, key)");
  return Axes >= 1 ? Axes : 1;
}

/// The number of elements or rows of a parameter that is a vector or a matrix.
template <int Size>
[[nodiscard]] consteval int checked_size() {
  static_assert(Size >= 1,
                "a parameter of an error term is a number, or a vector or a matrix of fixed size: Eigen::Matrix3d, not "
                "Eigen::MatrixXd");
  return Size >= 1 ? Size : 3;
}

}  // namespace detail

/// One number for each axis of a sensor.
template <typename Scalar, int Axes>
using AxisVector = Eigen::Matrix<Scalar, Axes, 1>;

/// A parameter of an error term: N = 1 is one value for all axes of any sensor, N > 1 one value for each axis of a
/// sensor with N axes. PerAxis(0.1) and PerAxis(0.1, 0.1, 0.3) deduce both template arguments.
template <typename Scalar_, int N = 3>
class PerAxis {
 public:
  using Scalar = Scalar_;

  constexpr PerAxis(const Scalar& all) { values_.fill(all); }
  template <std::convertible_to<Scalar>... Rest>
    requires(N > 1 && sizeof...(Rest) + 1 == N)
  constexpr PerAxis(const Scalar& first, const Rest&... rest) : values_{first, static_cast<Scalar>(rest)...} {}
  template <int One>
    requires(One == 1 && N > 1)
  constexpr PerAxis(const PerAxis<Scalar, One>& all) : PerAxis(all[0]) {}
  template <typename Derived>
    requires(Derived::SizeAtCompileTime == N)
  PerAxis(const Eigen::MatrixBase<Derived>& v) {
    for (int i = 0; i < N; ++i) values_[static_cast<std::size_t>(i)] = v(i);
  }

  [[nodiscard]] constexpr const Scalar& operator[](std::size_t axis) const { return values_[N == 1 ? 0 : axis]; }
  [[nodiscard]] constexpr auto begin() const { return values_.begin(); }
  [[nodiscard]] constexpr auto end() const { return values_.begin() + N; }

  /// The values for the axes of a sensor.
  template <int Axes = N>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE AxisVector<Scalar, Axes> vector() const {
    return view<Axes>();
  }
  /// The same without a copy: an expression of Eigen that refers to this object.
  template <int Axes = N>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE auto view() const& {
    static_assert(N == 1 || N == Axes,
                  "a parameter of an error term has one value for each of N axes, but the sensor has another number of "
                  "axes: give one value for all axes, or one for each axis of the sensor");
    if constexpr (Axes <= stored) {
      return Eigen::Map<const AxisVector<Scalar, Axes>>(values_.data());
    } else {
      return AxisVector<Scalar, Axes>::Constant(values_[0]);
    }
  }
  template <int Axes = N>
  auto view() const&& = delete;

 private:
  // One value is stored three times. Compilers then read it as a vector of three, instead of making the vector for every
  // sample.
  static constexpr int stored = N == 1 ? 3 : detail::checked_axes<N>();

  detail::FixedArray<Scalar, stored> values_{};
};

namespace detail {

template <typename Scalar, int N>
constexpr void require_finite(const char* term, const char* parameter, const PerAxis<Scalar, N>& values) {
  for (const Scalar& value : values) require_finite(term, parameter, value);
}

template <typename Scalar, int N>
constexpr void require_non_negative(const char* term, const char* parameter, const PerAxis<Scalar, N>& values) {
  for (const Scalar& value : values) require_non_negative(term, parameter, value);
}

template <typename Scalar, int N>
constexpr void require_positive(const char* term, const char* parameter, const PerAxis<Scalar, N>& values) {
  for (const Scalar& value : values) require_positive(term, parameter, value);
}

template <typename Scalar, int N>
constexpr void require_factor(const char* term, const char* parameter, const PerAxis<Scalar, N>& values) {
  for (const Scalar& value : values) require_factor(term, parameter, value);
}

template <typename Scalar, int N>
constexpr void require_noise_factor(const char* term, const char* parameter, const PerAxis<Scalar, N>& values) {
  for (const Scalar& value : values) require_noise_factor(term, parameter, value);
}

template <typename Scalar, int Rows, int Columns>
void require_finite(const char* term, const char* parameter, const Eigen::Matrix<Scalar, Rows, Columns>& values) {
  for (int row = 0; row < Rows; ++row) {
    for (int column = 0; column < Columns; ++column) require_finite(term, parameter, values(row, column));
  }
}

template <typename Scalar, int Rows, int Columns>
void require_factor(const char* term, const char* parameter, const Eigen::Matrix<Scalar, Rows, Columns>& values) {
  for (int row = 0; row < Rows; ++row) {
    for (int column = 0; column < Columns; ++column) require_factor(term, parameter, values(row, column));
  }
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

template <typename P>
using ScalarOfParameter = typename ParameterScalar<P>::type;

/// The number of values in a parameter: that of a PerAxis or a vector, 1 for everything else.
template <typename P>
inline constexpr int values_in_parameter = 1;
template <typename Scalar, int N>
inline constexpr int values_in_parameter<PerAxis<Scalar, N>> = N;
template <typename P>
  requires requires { P::SizeAtCompileTime; }
inline constexpr int values_in_parameter<P> = checked_size<static_cast<int>(P::SizeAtCompileTime)>();
template <typename P>
inline constexpr int values_in_parameter<std::optional<P>> = values_in_parameter<P>;

/// For deduction guides:
///   template <typename P, typename... More>
///   Term(const P&, const More&...) -> Term<ScalarOfParameter<P>, values_in_parameters<P, More...>>;
template <typename... P>
inline constexpr int values_in_parameters = (std::max)({values_in_parameter<P>...});

}  // namespace detail

template <typename P>
PerAxis(const P&) -> PerAxis<detail::ScalarOfParameter<P>, detail::values_in_parameter<P>>;
template <typename P, typename Q, typename... Rest>
PerAxis(const P&, const Q&,
        const Rest&...) -> PerAxis<detail::ScalarOfParameter<P>, 2 + static_cast<int>(sizeof...(Rest))>;

}  // namespace splinertia
