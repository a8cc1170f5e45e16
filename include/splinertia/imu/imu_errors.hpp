// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/detail/run_clock.hpp>
#include <splinertia/imu/imu.hpp>
#include <splinertia/imu/imu_sensor_sample.hpp>
#include <splinertia/time.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

/// Puts the errors of an IMU into the measurements of a perfect one, in the order of time: one run of one IMU.
/// simulate() does this along a motion; ImuErrors is for measurements from elsewhere, at any times. SensorErrors is for
/// any other sensor.
///
///   ImuErrors errors(imu, StreamKey(seed));    // over double seconds; others: ImuErrors<Sensors, Scalar, Time>
///   ImuReading reading;
///   if (errors.apply(time, ideal, interval, reading)) …
template <typename Sensors, typename Scalar = double, TimePoint Time = double, BitGenerator Generator = Xoshiro256>
class ImuErrors {
  static_assert(detail::is_imu<std::remove_const_t<Sensors>>,
                "the errors of an IMU are an Imu: Imu{ErrorModel{WhiteNoise{0.01}}, ErrorModel{}}");
  using Clock = detail::RunClock<decltype(Sensors::stamps), Scalar, Time, Generator>;

 public:
  using Reading = std::conditional_t<Clock::has_stamps, StampedImuReading<Scalar, Time>, BasicImuReading<Scalar, Time>>;

  /// `run` names the random numbers: StreamKey(seed), or a part of it if a run has several IMUs.
  SPLINERTIA_ALWAYS_INLINE ImuErrors(const Sensors& imu, StreamKey run)
      : ImuErrors(imu, imu.gyro.template start<3, Generator>(run / "gyro"),
                  imu.accel.template start<3, Generator>(run / "accel"),
                  imu.stamps.template start<Stamp<Scalar>::axes, Generator>(run / "stamps")) {}

  /// Makes the reading of a measurement taken at `time`, `interval` s after the previous one (for the first: the
  /// sampling interval). Without clock errors its stamp is `time`, which is not checked. With clock errors stamps
  /// increase strictly: a stamp that would be before next_stamp() of the last one becomes next_stamp(). With clock
  /// errors it returns false if the sample is dropped, and throws std::invalid_argument for a stamp that is not finite,
  /// std::out_of_range for one that an integer Time cannot hold; `reading` is then unchanged. Requires interval > 0, and
  /// of an integer Time that it holds the difference to the first time (64 bits of nanoseconds: 292 years).
  SPLINERTIA_ALWAYS_INLINE bool apply(Time time, const ImuMeasurement<Scalar>& ideal, const Scalar& interval,
                                      Reading& reading) {
    const auto now = clock_.sample_at(time, interval);
    ImuSensorSample<Scalar> gyro{{ideal.gyro, Eigen::Vector3<Scalar>::Zero(), interval, now.first, now.elapsed}, ideal};
    ImuSensorSample<Scalar> accel{{ideal.accel, Eigen::Vector3<Scalar>::Zero(), interval, now.first, now.elapsed},
                                  ideal};
    imu_.gyro.apply(gyro, gyro_);
    imu_.accel.apply(accel, accel_);
    if (!clock_.stamp(imu_.stamps, now, "ImuErrors", reading)) return false;
    reading.gyro = gyro.value;
    reading.accel = accel.value;
    reading.gyro_bias = gyro.bias;
    reading.accel_bias = accel.bias;
    return true;
  }

 private:
  using GyroState = detail::StateOfModel<decltype(Sensors::gyro), 3, Generator>;
  using AccelState = detail::StateOfModel<decltype(Sensors::accel), 3, Generator>;
  static_assert(detail::AppliesTo<decltype(Sensors::gyro), ImuSensorSample<Scalar>&, GyroState> &&
                    detail::AppliesTo<decltype(Sensors::accel), ImuSensorSample<Scalar>&, AccelState> &&
                    detail::AppliesTo<decltype(Sensors::stamps), Stamp<Scalar>&, typename Clock::State>,
                "the error terms use another scalar type than the motion (WhiteNoise{0.01} uses double, "
                "WhiteNoise{0.01F} float), "
                "or are not for sensors with three axes");

  // States are moved in, not constructed in place: once a function that is not inlined has had the address of a state,
  // the state can no longer be kept in registers.
  SPLINERTIA_ALWAYS_INLINE ImuErrors(const Sensors& imu, GyroState gyro, AccelState accel, typename Clock::State stamps)
      : imu_(imu), gyro_(std::move(gyro)), accel_(std::move(accel)), clock_(std::move(stamps)) {}

  [[no_unique_address]] Sensors imu_;
  [[no_unique_address]] GyroState gyro_;
  [[no_unique_address]] AccelState accel_;
  Clock clock_;
};

}  // namespace splinertia
