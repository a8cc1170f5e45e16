// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/detail/axis_streams.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <utility>

namespace splinertia {

/// The random numbers of a term: an independent stream for each axis. That of axis i has the key term / i, whatever the
/// number of axes.
template <BitGenerator Generator = Xoshiro256, int Axes = 3>
class NormalStreams {
 public:
  static constexpr int axes = detail::checked_axes<Axes>();

  constexpr explicit NormalStreams(StreamKey term) : streams_(term) {}

  /// Independent standard normal numbers, one for each axis.
  template <typename Scalar>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE AxisVector<Scalar, axes> draw() {
    return streams_.template draw<Scalar>();
  }
  /// Independent numbers uniform in [0, 1), one for each axis, from the same streams. They are independent of the normal
  /// numbers drawn before and after.
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE AxisVector<double, axes> draw_uniform() { return streams_.draw_uniform(); }
  /// One standard normal number, from the first stream.
  [[nodiscard]] double draw_one() { return first()(); }
  /// A number uniform in [0, 1), from the first stream.
  [[nodiscard]] double uniform() { return first().uniform(); }

 private:
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE NormalStream<Generator>& first() {
    return static_cast<detail::AxisStream<Generator, 0>&>(streams_).stream;
  }

  detail::AxisStreams<Generator, std::make_index_sequence<static_cast<std::size_t>(axes)>> streams_;
};

NormalStreams(StreamKey) -> NormalStreams<>;

}  // namespace splinertia
