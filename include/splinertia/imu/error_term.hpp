// SPDX-License-Identifier: MIT
/// What an error term is. A term is a struct of parameters with
///
///   struct State;                                        what changes from sample to sample, for one sensor in one
///   run; template <typename Normals> struct State;            the same of a term that draws random numbers: made from
///   its
///                                                        StreamKey, as Normals (NormalStreams) are
///   void apply(Sample<Scalar>& sample, State&) const;    what the term does to a sample
///   static constexpr std::string_view name;              names its random streams, and the term to people
///   void describe(auto&& parameter) const;               calls parameter(name, value, unit) for each parameter, for
///                                                        describe.hpp; optional
///
/// Parameters do not change, so that one model serves many runs and threads.
#pragma once

#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/imu/imu_measurement.hpp>
#include <splinertia/imu/normal.hpp>
#include <splinertia/imu/random_stream.hpp>
#include <string_view>

namespace splinertia {

/// √x as an instruction alone: std::sqrt may set errno, which keeps compilers from computing it once before a loop.
template <typename Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar square_root(const Scalar& x) {
  return Eigen::Array<Scalar, 2, 1>::Constant(x).sqrt().eval().x();
}

/// A sample of one three-axis sensor on its way through the error terms.
template <typename Scalar>
struct Sample {
  Vector3<Scalar> value;         ///< the reading so far; the true one before the first term
  Vector3<Scalar> bias;          ///< the bias in it so far
  Scalar interval;               ///< since the previous sample, s; the sampling interval for the first
  bool first;                    ///< whether it is the first of its run
  Scalar elapsed;                ///< since the first sample, s
  ImuMeasurement<Scalar> truth;  ///< what a perfect IMU would measure: for errors that cross from sensor to sensor
};

/// The unit of a parameter in terms of its sensor's, which is rad/s or m/s²: over s^per_seconds, over √Hz, over K.
struct SensorUnit {
  int per_seconds = 0;
  bool per_root_hertz = false;
  bool per_kelvin = false;
};

/// The random numbers of a term: an independent normal stream for each axis.
template <BitGenerator Generator = Xoshiro256>
class NormalStreams {
 public:
  constexpr explicit NormalStreams(StreamKey term) : x_(term / 0), y_(term / 1), z_(term / 2) {}

  /// Three independent standard normal numbers.
  template <typename Scalar>
  [[nodiscard, gnu::always_inline]] Vector3<Scalar> draw() {
    // In the order written: the arguments of a call would be evaluated in any.
    const auto x = static_cast<Scalar>(x_());
    const auto y = static_cast<Scalar>(y_());
    const auto z = static_cast<Scalar>(z_());
    return {x, y, z};
  }
  /// One of them, from the first stream.
  [[nodiscard]] double draw_one() { return x_(); }
  /// A number uniform in [0, 1), from the first stream.
  [[nodiscard]] double uniform() { return x_.uniform(); }

 private:
  NormalStream<Generator> x_, y_, z_;
};

NormalStreams(StreamKey) -> NormalStreams<>;

/// A term that draws random numbers.
template <typename T>
concept StochasticTerm = requires {
  typename T::template State<NormalStreams<>>;
  T::name;
};

template <typename T>
concept ErrorTerm = StochasticTerm<T> || requires { typename T::State; };

template <typename Term, BitGenerator Generator>
struct TermState {
  using type = typename Term::State;
};
template <StochasticTerm Term, BitGenerator Generator>
struct TermState<Term, Generator> {
  using type = typename Term::template State<NormalStreams<Generator>>;
};

/// The state of a term, with the generator that its random numbers come from.
template <ErrorTerm Term, BitGenerator Generator = Xoshiro256>
using StateOf = typename TermState<Term, Generator>::type;

/// Coefficients that depend on the interval between samples alone: made anew only when it changes.
template <typename Scalar, typename Coefficients>
class ForInterval {
 public:
  [[nodiscard, gnu::always_inline]] const Coefficients& operator()(const Scalar& interval, const auto& make) {
    if (interval != interval_) [[unlikely]] {
      interval_ = interval;
      coefficients_ = make();
    }
    return coefficients_;
  }

 private:
  Scalar interval_ = Scalar(-1);  // never that of a sample
  Coefficients coefficients_{};
};

}  // namespace splinertia
