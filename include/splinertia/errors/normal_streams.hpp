// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <utility>

namespace splinertia {

namespace detail {

/// The stream of one axis.
template <BitGenerator Generator, std::size_t Axis>
struct AxisStream {
  NormalStream<Generator> stream;
};

/// The streams of all axes. Each is a base class of its own: compilers keep those in registers, but not the elements of
/// an array.
template <BitGenerator Generator, typename Indices>
struct AxisStreams;
template <BitGenerator Generator, std::size_t... Axis>
struct AxisStreams<Generator, std::index_sequence<Axis...>> : AxisStream<Generator, Axis>... {
  constexpr explicit AxisStreams(StreamKey term)
      : AxisStream<Generator, Axis>{NormalStream<Generator>(term / Axis)}... {}

  // In the order of the axes: the parts of braces and of folds are evaluated in order, the arguments of a call may be
  // evaluated in any.
  template <typename Scalar>
  SPLINERTIA_ALWAYS_INLINE auto draw() {
    using Vector = AxisVector<Scalar, static_cast<int>(sizeof...(Axis))>;
    if constexpr (sizeof...(Axis) <= 4) {
      return Vector{static_cast<Scalar>(AxisStream<Generator, Axis>::stream())...};
    } else {
      Vector numbers;
      ((numbers[static_cast<int>(Axis)] = static_cast<Scalar>(AxisStream<Generator, Axis>::stream())), ...);
      return numbers;
    }
  }
  SPLINERTIA_ALWAYS_INLINE auto draw_uniform() {
    AxisVector<double, static_cast<int>(sizeof...(Axis))> numbers;
    ((numbers[static_cast<int>(Axis)] = AxisStream<Generator, Axis>::stream.uniform()), ...);
    return numbers;
  }
};

}  // namespace detail

/// The random numbers of a term: an independent stream for each axis. That of axis i has the key term / i, whatever the
/// number of axes.
template <BitGenerator Generator = Xoshiro256, int Axes = 3>
class NormalStreams {
 public:
  static constexpr int axes = Axes;

  constexpr explicit NormalStreams(StreamKey term) : streams_(term) {}

  /// Independent standard normal numbers, one for each axis.
  template <typename Scalar>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE AxisVector<Scalar, Axes> draw() {
    return streams_.template draw<Scalar>();
  }
  /// Independent numbers uniform in [0, 1), one for each axis, from the same streams. They are independent of the normal
  /// numbers drawn before and after.
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE AxisVector<double, Axes> draw_uniform() { return streams_.draw_uniform(); }
  /// One standard normal number, from the first stream.
  [[nodiscard]] double draw_one() { return first()(); }
  /// A number uniform in [0, 1), from the first stream.
  [[nodiscard]] double uniform() { return first().uniform(); }

 private:
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE NormalStream<Generator>& first() {
    return static_cast<detail::AxisStream<Generator, 0>&>(streams_).stream;
  }

  detail::AxisStreams<Generator, std::make_index_sequence<static_cast<std::size_t>(Axes)>> streams_;
};

NormalStreams(StreamKey) -> NormalStreams<>;

}  // namespace splinertia
