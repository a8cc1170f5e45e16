// SPDX-License-Identifier: MIT
/// The contract of an error term. A term is a struct of parameters with these members:
///
///   struct State;
///       What changes from sample to sample in one run. Must be default constructible.
///   template <typename Normals> struct State;
///       Instead of the above if the term draws random numbers. Must be constructible from the StreamKey of the term,
///       as Normals (NormalStreams) is.
///   void apply(Sample<Scalar>& sample, State& state) const;
///       Must put the error into the sample and advance the state. For a term of a clock: Stamp<Scalar>& stamp.
///   static constexpr std::string_view name;
///       Names the random streams, and the term in descriptions. Optional for a term without random numbers.
///   void describe(auto&& parameter) const;
///       Optional, for imu/describe.hpp. Must call parameter(name, value, unit) for each parameter; the unit is a
///       SensorUnit or a text.
///
/// Parameters do not change, so that one model serves many runs and threads.
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/imu_measurement.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <string_view>

namespace splinertia {

/// √x as a single instruction. std::sqrt may set errno, which keeps compilers from computing it once before a loop.
template <typename Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar square_root(const Scalar& x) {
  return Eigen::Array<Scalar, 2, 1>::Constant(x).sqrt().eval().x();
}

/// A sample of one three-axis sensor as it passes through the error terms.
template <typename Scalar>
struct Sample {
  Vector3<Scalar> value;         ///< the reading so far; the true one before the first term
  Vector3<Scalar> bias;          ///< the bias in `value` so far
  Scalar interval;               ///< since the previous sample, s; the sampling interval for the first
  bool first;                    ///< whether it is the first of its run
  Scalar elapsed;                ///< since the first sample, s
  ImuMeasurement<Scalar> truth;  ///< what a perfect IMU measures, for errors that depend on the other sensor
};

/// The unit of a parameter: its sensor's unit (rad/s or m/s²), divided by s^per_seconds, √Hz and K.
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
    // Three statements, for a fixed order: the arguments of a call may be evaluated in any order.
    const auto x = static_cast<Scalar>(x_());
    const auto y = static_cast<Scalar>(y_());
    const auto z = static_cast<Scalar>(z_());
    return {x, y, z};
  }
  /// One standard normal number, from the first stream.
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
concept TermWithState = StochasticTerm<T> || requires { typename T::State; };

template <typename Term, BitGenerator Generator>
struct TermState {
  using type = typename Term::State;
};
template <StochasticTerm Term, BitGenerator Generator>
struct TermState<Term, Generator> {
  using type = typename Term::template State<NormalStreams<Generator>>;
};

/// The state of a term whose random numbers come from Generator.
template <TermWithState Term, BitGenerator Generator = Xoshiro256>
using StateOf = typename TermState<Term, Generator>::type;

/// Whether the state can be constructed at the beginning of a run: by default or, for a term that draws random numbers,
/// from its StreamKey.
template <typename T>
concept TermWithStart =
    TermWithState<T> &&
    (StochasticTerm<T> ? std::constructible_from<StateOf<T>, StreamKey> : std::default_initializable<StateOf<T>>);

/// Whether `errors`, a term or a model, can be applied to such a sample.
template <typename Errors, typename AnySample, typename State>
concept AppliesTo = requires(const Errors& errors, AnySample sample, State& state) {
  errors.apply(static_cast<AnySample&&>(sample), state);
};

/// These two convert to Kind<Scalar> (Sample or Stamp) of whichever scalar a function asks for: to a reference that the
/// function can write to, or to a copy.
template <template <typename> typename Kind>
struct OfAnyScalar {
  template <typename Scalar>
  operator Kind<Scalar>&() const;
};
template <template <typename> typename Kind>
struct CopyOfAnyScalar {
  template <typename Scalar>
  operator Kind<Scalar>() const;
};

/// Whether errors can be applied to Samples (or Stamps) of some scalar, and can change them.
template <typename Errors, typename State, template <typename> typename Kind>
concept AppliesToSome = AppliesTo<Errors, Kind<double>&, State> || AppliesTo<Errors, OfAnyScalar<Kind>&, State>;

/// Whether errors take a copy or a reference to const, so that their changes would be lost.
template <typename Errors, typename State, template <typename> typename Kind>
concept AppliesToCopy = !AppliesTo<Errors, int, State> &&
                        (AppliesTo<Errors, Kind<double>, State> || AppliesTo<Errors, CopyOfAnyScalar<Kind>, State>);

/// An error term of a sensor, which changes a Sample.
template <typename T>
concept SensorTerm = TermWithStart<T> && AppliesToSome<T, StateOf<T>, Sample> && !AppliesToCopy<T, StateOf<T>, Sample>;

/// An error term of a clock, which changes a Stamp.
template <typename T>
concept ClockTerm = TermWithStart<T> && AppliesToSome<T, StateOf<T>, Stamp> && !AppliesToCopy<T, StateOf<T>, Stamp>;

template <typename T>
concept ErrorTerm = SensorTerm<T> || ClockTerm<T>;

/// Fails to compile unless T is an error term, with one line that says what is missing.
template <typename T>
consteval bool check_error_term() {
  static_assert(TermWithState<T>,
                "an error term needs a State: write 'struct State {};' in it, or, where it draws random numbers, "
                "'template <typename Normals> using State = Normals;' and 'static constexpr std::string_view name'");
  if constexpr (TermWithState<T>) {
    static_assert(TermWithStart<T>,
                  "the State of an error term needs a constructor: without arguments, or, where the term draws random "
                  "numbers, 'explicit State(StreamKey term) : normals(term) {}'");
    if constexpr (TermWithStart<T>) {
      static_assert(ErrorTerm<T>,
                    "an error term needs 'void apply(Sample<double>& sample, State& state) const', a term of a clock "
                    "'void apply(Stamp<double>& stamp, State& state) const'");
    }
  }
  return true;
}

/// Coefficients that depend only on the interval between samples. They are recomputed only when it changes.
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
  Scalar interval_ = Scalar(-1);  // no sample has this interval
  Coefficients coefficients_{};
};

}  // namespace splinertia
