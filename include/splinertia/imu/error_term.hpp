// SPDX-License-Identifier: MIT
/// What an error term is. A term is a struct of parameters with
///
///   struct State;                                            what changes from sample to sample, for one sensor in one
///   run;
///                                                            made from the term's StreamKey if it draws random numbers
///   void apply(Sample<Scalar>& sample, State& state) const;  what the term does to a sample
///   static constexpr std::string_view name                   names its random streams; only if it draws any
///
/// Parameters do not change, so that one model serves many runs and threads.
#pragma once

#include <array>
#include <concepts>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/imu/normal.hpp>
#include <splinertia/imu/random_stream.hpp>

namespace splinertia {

/// A sample of one three-axis sensor on its way through the error terms.
template <typename Scalar>
struct Sample {
  Vector3<Scalar> value;  ///< the reading so far; the true one before the first term
  Vector3<Scalar> bias;   ///< the bias in it so far
  Scalar interval;        ///< since the previous sample, s; the sampling interval for the first
  bool first;             ///< whether it is the first of its run
};

template <typename T>
concept ErrorTerm = requires { typename T::State; };

/// The random numbers of a term: an independent normal stream for each axis.
class NormalStreams {
 public:
  explicit NormalStreams(StreamKey term)
      : axes_{NormalStream(term / 0), NormalStream(term / 1), NormalStream(term / 2)} {}

  /// Three independent standard normal numbers.
  template <typename Scalar>
  [[nodiscard]] Vector3<Scalar> draw() {
    // In the order written: the arguments of a call would be evaluated in any.
    Vector3<Scalar> n;
    for (int axis = 0; axis < 3; ++axis) n[axis] = static_cast<Scalar>(axes_[static_cast<std::size_t>(axis)]());
    return n;
  }

 private:
  std::array<NormalStream, 3> axes_;
};

}  // namespace splinertia
