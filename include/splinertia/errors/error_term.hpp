// SPDX-License-Identifier: MIT
/// The contract of an error term. A term is a struct of parameters with these members:
///
///   struct State;
///       What changes from sample to sample in one run. Must be default constructible.
///   template <int Axes> struct State;
///       Instead of the above if it depends on the number of axes.
///   template <typename Normals> struct State;
///       Instead of the above if the term draws random numbers. Must be constructible from the StreamKey of the term,
///       as Normals (NormalStreams) is. Normals::axes is the number of axes.
///   template <int Axes> void apply(SensorSample<Scalar, Axes>& sample, State& state) const;
///       Must put the error into the sample and advance the state. A term for one number of axes only may be no
///       template: void apply(SensorSample<double, 3>& sample, State& state) const. A term that needs more takes what it
///       needs: ImuSensorSample<Scalar>& sample. For a term of a clock: Stamp<Scalar>& stamp.
///   static constexpr std::string_view name;
///       Names the random streams, and the term in descriptions. Optional for a term without random numbers.
///   static constexpr SensorKind sensor;
///       Optional, for a term of gyroscopes or of accelerometers only: an Imu refuses it in the model of the other one.
///   void describe(auto&& parameter) const;
///       Optional, for errors/describe.hpp. Must call parameter(name, value, unit) for each parameter; the unit is a
///       SensorUnit or a text.
///
/// Parameters do not change, so that one model serves many runs and threads.
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/detail/any_sample.hpp>
#include <splinertia/errors/normal_streams.hpp>
#include <splinertia/errors/sensor_kind.hpp>
#include <splinertia/errors/sensor_sample.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/random/random_stream.hpp>
#include <string_view>
#include <type_traits>

namespace splinertia {

/// The unit of a parameter: its sensor's unit (rad/s, m/s², m …), divided by s^per_seconds, √Hz and K.
struct SensorUnit {
  int per_seconds = 0;
  bool per_root_hertz = false;
  bool per_kelvin = false;
  bool reciprocal = false;  ///< 1 divided by all that
};

/// A term that draws random numbers.
template <typename T>
concept StochasticTerm = requires {
  typename T::template State<NormalStreams<>>;
  T::name;
};

namespace detail {

/// A term whose state depends on the number of axes.
template <typename T>
concept TermWithStateOfAxes = requires { typename T::template State<3>; };

template <typename T>
concept TermWithState = StochasticTerm<T> || TermWithStateOfAxes<T> || requires { typename T::State; };

template <typename Term, int Axes, BitGenerator Generator>
struct TermState {
  using type = typename Term::State;
};
template <TermWithStateOfAxes Term, int Axes, BitGenerator Generator>
struct TermState<Term, Axes, Generator> {
  using type = typename Term::template State<Axes>;
};
template <StochasticTerm Term, int Axes, BitGenerator Generator>
struct TermState<Term, Axes, Generator> {
  using type = typename Term::template State<NormalStreams<Generator, Axes>>;
};

}  // namespace detail

/// The state of a term in a sensor of so many axes, whose random numbers come from Generator.
template <detail::TermWithState Term, int Axes = 3, BitGenerator Generator = Xoshiro256>
using StateOf = typename detail::TermState<Term, Axes, Generator>::type;

namespace detail {

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
} || (std::same_as<AnySample, AnySensorSample&> && requires(const Errors& errors, AnySample sample, State& state) {
                      errors.template apply<AnySensorSample::axes>(sample, state);
                    });

/// Whether errors can be applied to samples of some scalar and can change them.
template <typename Errors, typename State>
concept AppliesToSensor = AppliesTo<Errors, SensorSample<double>&, State> || AppliesTo<Errors, AnySensorSample&, State>;
template <typename Errors, typename State>
concept AppliesToClock = AppliesTo<Errors, Stamp<double>&, State> || AppliesTo<Errors, AnyStamp&, State>;

/// Whether errors take a copy or a reference to const, so that their changes would be lost.
template <typename Errors, typename State>
concept AppliesToCopy =
    !AppliesTo<Errors, int, State> &&
    (AppliesTo<Errors, SensorSample<double>, State> || AppliesTo<Errors, AnySensorSampleCopy, State> ||
     AppliesTo<Errors, Stamp<double>, State> || AppliesTo<Errors, AnyStampCopy, State>);

}  // namespace detail

/// An error term of a sensor, which changes a SensorSample.
template <typename T>
concept SensorTerm =
    detail::TermWithStart<T> && detail::AppliesToSensor<T, StateOf<T>> && !detail::AppliesToCopy<T, StateOf<T>>;

/// An error term of a clock, which changes a Stamp.
template <typename T>
concept ClockTerm = detail::TermWithStart<T> && detail::AppliesToClock<T, StateOf<T, Stamp<double>::axes>> &&
                    !detail::AppliesToCopy<T, StateOf<T, Stamp<double>::axes>>;

template <typename T>
concept ErrorTerm = SensorTerm<T> || ClockTerm<T>;

namespace detail {

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
                    "an error term needs 'void apply(SensorSample<double>& sample, State& state) const', a term of a "
                    "clock 'void apply(Stamp<double>& stamp, State& state) const'");
    }
  }
  return true;
}

/// Coefficients that depend only on the interval between samples. They are recomputed only when it changes.
template <typename Scalar, typename Coefficients>
class ForInterval {
 public:
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE const Coefficients& operator()(const Scalar& interval, const auto& make) {
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

}  // namespace detail

}  // namespace splinertia
