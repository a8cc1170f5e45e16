// SPDX-License-Identifier: MIT
/// Group elements as arrays of numbers: parameter blocks of an optimiser, rows of a file, arrays of another library.
/// The numbers and their order are Sophus' own:
///
///   SO3  x y z w of the unit quaternion        SE3  x y z w, then the translation
///   SO2  cos θ, sin θ                          SE2  cos θ, sin θ, then the translation
///   Rⁿ   its components                        Product<G...>  the numbers of the factors, one factor after the other
///
/// So `.data()` of a Sophus object is such an array. Sophus' types may need aligned memory; these arrays do not.
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/detail/planar_motion.hpp>
#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/known_groups.hpp>
#include <utility>

namespace splinertia {

/// Customisation point. Specialise it for a group G with d = Dof whose elements are stored as n numbers:
///
///   static constexpr int size                                  n
///   static G read(const Scalar* numbers)                       the element with these n numbers, not normalised
///   static void write(const G& x, Scalar* numbers)             writes the n numbers of x
///   static Matrix<n, d> tangent_to_parameters(const G& x)      J = d write(x exp(δ))/dδ at δ = 0
///   static Matrix<d, n> parameters_to_tangent(const G& x)      d log(x⁻¹ y)/d write(y) at y = x, a left inverse of J
template <typename G>
struct ParameterLayout;

/// A group with a ParameterLayout.
template <typename G>
concept HasParameterLayout = LieGroup<G> && requires {
  { ParameterLayout<G>::size } -> std::convertible_to<int>;
};

/// The number of scalars that store an element of G.
template <HasParameterLayout G>
inline constexpr int parameter_count = ParameterLayout<G>::size;

/// Reads an element of G from parameter_count<G> numbers. Does not normalise it.
template <HasParameterLayout G>
[[nodiscard]] inline G read_parameters(const ScalarOf<G>* numbers) {
  return ParameterLayout<G>::read(numbers);
}

/// Writes parameter_count<G> numbers.
template <HasParameterLayout G>
inline void write_parameters(const G& x, ScalarOf<G>* numbers) {
  ParameterLayout<G>::write(x, numbers);
}

namespace detail {

template <HasParameterLayout G>
using TangentToParameters = Eigen::Matrix<ScalarOf<G>, parameter_count<G>, DofOf<G>>;

template <HasParameterLayout G>
using ParametersToTangent = Eigen::Matrix<ScalarOf<G>, DofOf<G>, parameter_count<G>>;

}  // namespace detail

template <typename Scalar, int N>
struct ParameterLayout<Eigen::Matrix<Scalar, N, 1>> {
  using G = Eigen::Matrix<Scalar, N, 1>;
  static constexpr int size = N;

  static G read(const Scalar* numbers) { return Eigen::Map<const G>(numbers); }
  static void write(const G& x, Scalar* numbers) { Eigen::Map<G>{numbers} = x; }
  static Eigen::Matrix<Scalar, N, N> tangent_to_parameters(const G&) { return Eigen::Matrix<Scalar, N, N>::Identity(); }
  static Eigen::Matrix<Scalar, N, N> parameters_to_tangent(const G&) { return Eigen::Matrix<Scalar, N, N>::Identity(); }
};

template <typename Scalar>
struct ParameterLayout<Sophus::SO2<Scalar>> {
  using G = Sophus::SO2<Scalar>;
  static constexpr int size = 2;

  static G read(const Scalar* numbers) {
    G x;
    for (int i = 0; i < size; ++i) x.data()[i] = numbers[i];
    return x;
  }
  static void write(const G& x, Scalar* numbers) { Eigen::Map<Eigen::Vector2<Scalar>>{numbers} = x.unit_complex(); }
  /// i z, where z is the unit complex number of x.
  static Eigen::Vector2<Scalar> tangent_to_parameters(const G& x) {
    return detail::quarter_turn<Scalar>(x.unit_complex());
  }
  static Eigen::Matrix<Scalar, 1, 2> parameters_to_tangent(const G& x) { return tangent_to_parameters(x).transpose(); }
};

template <typename Scalar>
struct ParameterLayout<Sophus::SO3<Scalar>> {
  using G = Sophus::SO3<Scalar>;
  static constexpr int size = 4;

  static G read(const Scalar* numbers) {
    G x;
    for (int i = 0; i < size; ++i) x.data()[i] = numbers[i];
    return x;
  }
  static void write(const G& x, Scalar* numbers) {
    for (int i = 0; i < size; ++i) numbers[i] = x.data()[i];
  }
  /// q (δ/2, 0) = ((w δ + v × δ)/2, −v·δ/2) for q = (v, w).
  static Eigen::Matrix<Scalar, 4, 3> tangent_to_parameters(const G& x) {
    const auto& q = x.unit_quaternion();
    const Scalar half(detail::Constant<Scalar>(1) / detail::Constant<Scalar>(2));
    Eigen::Matrix<Scalar, 4, 3> J;
    J.template topRows<3>() = half * (detail::hat<Scalar>(q.vec()) + q.w() * Eigen::Matrix3<Scalar>::Identity());
    J.template bottomRows<1>() = -half * q.vec().transpose();
    return J;
  }
  /// 4 Jᵀ, because Jᵀ J = I/4: the vector part of 2 q⁻¹ dq.
  static Eigen::Matrix<Scalar, 3, 4> parameters_to_tangent(const G& x) {
    return Scalar(4) * tangent_to_parameters(x).transpose();
  }
};

template <typename Scalar>
struct ParameterLayout<Sophus::SE2<Scalar>> {
  using G = Sophus::SE2<Scalar>;
  using Rotation = ParameterLayout<Sophus::SO2<Scalar>>;
  static constexpr int size = 4;

  static G read(const Scalar* numbers) {
    G x;
    x.so2() = Rotation::read(numbers);
    x.translation() = Eigen::Map<const Eigen::Vector2<Scalar>>(numbers + 2);
    return x;
  }
  static void write(const G& x, Scalar* numbers) {
    Rotation::write(x.so2(), numbers);
    Eigen::Map<Eigen::Vector2<Scalar>>{numbers + 2} = x.translation();
  }
  static Eigen::Matrix<Scalar, 4, 3> tangent_to_parameters(const G& x) {
    Eigen::Matrix<Scalar, 4, 3> J = Eigen::Matrix<Scalar, 4, 3>::Zero();
    J.template block<2, 1>(0, 2) = Rotation::tangent_to_parameters(x.so2());
    J.template block<2, 2>(2, 0) << x.unit_complex(), detail::quarter_turn<Scalar>(x.unit_complex());
    return J;
  }
  static Eigen::Matrix<Scalar, 3, 4> parameters_to_tangent(const G& x) {
    return tangent_to_parameters(x).transpose();  // the columns of J are orthonormal
  }
};

template <typename Scalar>
struct ParameterLayout<Sophus::SE3<Scalar>> {
  using G = Sophus::SE3<Scalar>;
  using Rotation = ParameterLayout<Sophus::SO3<Scalar>>;
  static constexpr int size = 7;

  static G read(const Scalar* numbers) {
    G x;
    x.so3() = Rotation::read(numbers);
    x.translation() = Eigen::Map<const Eigen::Vector3<Scalar>>(numbers + 4);
    return x;
  }
  static void write(const G& x, Scalar* numbers) {
    Rotation::write(x.so3(), numbers);
    Eigen::Map<Eigen::Vector3<Scalar>>{numbers + 4} = x.translation();
  }
  /// The translation of x exp([ρ; φ]) is t + Rρ to first order.
  static Eigen::Matrix<Scalar, 7, 6> tangent_to_parameters(const G& x) {
    Eigen::Matrix<Scalar, 7, 6> J = Eigen::Matrix<Scalar, 7, 6>::Zero();
    J.template block<4, 3>(0, 3) = Rotation::tangent_to_parameters(x.so3());
    J.template block<3, 3>(4, 0) = detail::rotation_matrix_transposed<Scalar>(x.unit_quaternion()).transpose();
    return J;
  }
  static Eigen::Matrix<Scalar, 6, 7> parameters_to_tangent(const G& x) {
    Eigen::Matrix<Scalar, 6, 7> J = Eigen::Matrix<Scalar, 6, 7>::Zero();
    J.template block<3, 4>(3, 0) = Rotation::parameters_to_tangent(x.so3());
    J.template block<3, 3>(0, 4) = detail::rotation_matrix_transposed<Scalar>(x.unit_quaternion());
    return J;
  }
};

template <HasParameterLayout... F>
struct ParameterLayout<Product<F...>> {
  using G = Product<F...>;
  using Scalar = ScalarOf<G>;
  static constexpr int size = (parameter_count<F> + ...);

  static G read(const Scalar* numbers) {
    G x;
    for_each_part([&]<std::size_t Index, typename Factor>(int row) {
      x.template get<Index>() = read_parameters<Factor>(numbers + row);
    });
    return x;
  }
  static void write(const G& x, Scalar* numbers) {
    for_each_part([&]<std::size_t Index, typename Factor>(int row) {
      write_parameters<Factor>(x.template get<Index>(), numbers + row);
    });
  }
  static Eigen::Matrix<Scalar, size, DofOf<G>> tangent_to_parameters(const G& x) {
    Eigen::Matrix<Scalar, size, DofOf<G>> J = Eigen::Matrix<Scalar, size, DofOf<G>>::Zero();
    for_each_part([&]<std::size_t Index, typename Factor>(int row) {
      J.template block<parameter_count<Factor>, DofOf<Factor>>(row, G::template offset<Index>) =
          ParameterLayout<Factor>::tangent_to_parameters(x.template get<Index>());
    });
    return J;
  }
  static Eigen::Matrix<Scalar, DofOf<G>, size> parameters_to_tangent(const G& x) {
    Eigen::Matrix<Scalar, DofOf<G>, size> J = Eigen::Matrix<Scalar, DofOf<G>, size>::Zero();
    for_each_part([&]<std::size_t Index, typename Factor>(int row) {
      J.template block<DofOf<Factor>, parameter_count<Factor>>(G::template offset<Index>, row) =
          ParameterLayout<Factor>::parameters_to_tangent(x.template get<Index>());
    });
    return J;
  }

 private:
  // Calls f<I, Factor>(row) for each factor; `row` is the index of its first number.
  static void for_each_part(const auto& f) {
    int row = 0;
    detail::for_each_factor<G>([&]<std::size_t Index, typename Factor>() {
      f.template operator()<Index, Factor>(row);
      row += parameter_count<Factor>;
    });
  }
};

}  // namespace splinertia
