// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <utility>

namespace splinertia::detail {

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

}  // namespace splinertia::detail
