// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/detail/run_clock.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/sensor_sample.hpp>
#include <splinertia/time.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

/// What a sensor of so many axes measures: a number for one axis, a vector for more.
template <typename Scalar, int Axes>
using SensorValue = std::conditional_t<Axes == 1, Scalar, AxisVector<Scalar, Axes>>;

}  // namespace detail

/// One reading of a sensor.
template <int Axes, typename Scalar, TimePoint Time>
struct SensorReading {
  Time time;                                ///< its stamp
  detail::SensorValue<Scalar, Axes> value;  ///< in the sensor's unit
  detail::SensorValue<Scalar, Axes> bias;   ///< the true bias in `value`
};

/// One reading of a sensor whose stamps have errors, too.
template <int Axes, typename Scalar, TimePoint Time>
struct StampedSensorReading : SensorReading<Axes, Scalar, Time> {
  Time true_time;  ///< when the sample was taken
};

/// Puts errors into the measurements of a perfect sensor with `Axes` axes, in the order of time: one run of one sensor.
/// ImuErrors does this for an IMU.
///
///   SensorErrors barometer(ErrorModel{RandomWalk{0.02}, WhiteNoise{0.1}}, StreamKey(seed) / "barometer");
///   const double altitude = barometer.apply(time, 120.0, 0.02)->value;
///
///   auto gnss = sensor_errors<3>(model, stamps, StreamKey(seed) / "gnss");
///   if (const auto fix = gnss.apply(time, position, 0.1)) …     // empty if the sample is dropped
template <typename Model, int Axes = 1, typename Stamps = ErrorModel<>, typename Scalar = double,
          TimePoint Time = double, BitGenerator Generator = Xoshiro256>
class SensorErrors {
  static constexpr int axes = detail::checked_axes<Axes>();
  static_assert(detail::SensorModel<Model>,
                "a sensor has an ErrorModel: SensorErrors(ErrorModel{WhiteNoise{0.01}}, key); errors of time stamps "
                "(ClockOffset, DroppedSamples, …) are a second one: SensorErrors(model, stamps, key)");
  static_assert(detail::ClockModel<Stamps>,
                "the second model of a sensor is the ErrorModel of its stamps (ClockOffset, DroppedSamples, …): "
                "SensorErrors(model, stamps, key)");
  using Sample = SensorSample<Scalar, axes>;
  using State = detail::StateOfModel<Model, axes, Generator>;
  using Clock = detail::RunClock<Stamps, Scalar, Time, Generator>;
  static_assert(detail::AppliesTo<Model, Sample&, State>,
                "a term of the error model does not apply to a sensor with this number of axes and this scalar type "
                "(WhiteNoise{0.01} uses double, WhiteNoise{0.01F} float), or it needs the truth of an IMU, as "
                "GSensitivity does");
  static_assert(detail::AppliesTo<Stamps, Stamp<Scalar>&, typename Clock::State>,
                "the error terms of the stamps use another scalar type than the sensor");

 public:
  using Value = detail::SensorValue<Scalar, axes>;
  using Reading = std::conditional_t<Clock::has_stamps, StampedSensorReading<axes, Scalar, Time>,
                                     SensorReading<axes, Scalar, Time>>;

  /// `sensor` names the random numbers: a part of StreamKey(seed) for each sensor of a run.
  SensorErrors(const Model& model, StreamKey sensor) : SensorErrors(model, Stamps{}, sensor) {}
  SensorErrors(const Model& model, const Stamps& stamps, StreamKey sensor)
      : model_(model),
        stamps_(stamps),
        state_(model.template start<axes, Generator>(sensor / "value")),
        clock_(stamps.template start<Stamp<Scalar>::axes, Generator>(sensor / "stamps")) {}

  /// The reading of a measurement taken at `time`, `interval` s after the previous one (for the first: the sampling
  /// interval). Without clock errors its stamp is `time`, which is not checked. With clock errors stamps increase
  /// strictly: a stamp that would be before next_stamp() of the last one becomes next_stamp(). With clock errors it is
  /// empty if the sample is dropped, and throws std::invalid_argument for a stamp that is not finite, std::out_of_range
  /// for one that an integer Time cannot hold. Requires interval > 0, and of an integer Time that it holds the
  /// difference to the first time (64 bits of nanoseconds: 292 years).
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE std::optional<Reading> apply(Time time, const Value& truth,
                                                                      const Scalar& interval) {
    const auto now = clock_.sample_at(time, interval);
    Sample sample{AxisVector<Scalar, axes>(truth), AxisVector<Scalar, axes>::Zero(), interval, now.first, now.elapsed};
    model_.apply(sample, state_);
    Reading reading;
    if (!clock_.stamp(stamps_, now, "SensorErrors", reading)) return std::nullopt;
    if constexpr (axes == 1) {
      reading.value = sample.value[0];
      reading.bias = sample.bias[0];
    } else {
      reading.value = sample.value;
      reading.bias = sample.bias;
    }
    return reading;
  }

 private:
  [[no_unique_address]] Model model_;
  [[no_unique_address]] Stamps stamps_;
  [[no_unique_address]] State state_;
  Clock clock_;
};

/// The same with the number of axes, the scalar, the type of time or the generator given, the models deduced:
/// sensor_errors<2>(model, key), sensor_errors<3, double, std::chrono::nanoseconds>(model, stamps, key).
template <int Axes, typename Scalar = double, TimePoint Time = double, BitGenerator Generator = Xoshiro256,
          typename Model>
[[nodiscard]] auto sensor_errors(const Model& model, StreamKey sensor) {
  return SensorErrors<Model, detail::checked_axes<Axes>(), ErrorModel<>, Scalar, Time, Generator>(model, sensor);
}
template <int Axes, typename Scalar = double, TimePoint Time = double, BitGenerator Generator = Xoshiro256,
          typename Model, typename Stamps>
[[nodiscard]] auto sensor_errors(const Model& model, const Stamps& stamps, StreamKey sensor) {
  return SensorErrors<Model, detail::checked_axes<Axes>(), Stamps, Scalar, Time, Generator>(model, stamps, sensor);
}

}  // namespace splinertia
