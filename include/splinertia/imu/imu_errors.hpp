// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <splinertia/detail/require.hpp>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/imu/imu.hpp>
#include <splinertia/time.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

/// Puts the errors of an IMU into the measurements of a perfect one, in the order of time: one run of one IMU.
/// simulate() does this along a motion; ImuErrors is for measurements from elsewhere, at any times.
///
///   ImuErrors errors(imu, StreamKey(seed));    // over double seconds; others: ImuErrors<Sensors, Scalar, Time>
///   ImuReading reading;
///   if (errors.apply(time, ideal, interval, reading)) …
template <typename Sensors, typename Scalar = double, TimePoint Time = double, BitGenerator Generator = Xoshiro256>
class ImuErrors {
  static constexpr bool has_stamps = !std::is_same_v<decltype(Sensors::stamps), ErrorModel<>>;

 public:
  using Reading = std::conditional_t<has_stamps, StampedImuReading<Scalar, Time>, BasicImuReading<Scalar, Time>>;

  /// `run` names the random numbers: StreamKey(seed), or a part of it if a run has several IMUs.
  [[gnu::always_inline]] ImuErrors(const Sensors& imu, StreamKey run)
      : ImuErrors(imu, imu.gyro.template start<Generator>(run / "gyro"),
                  imu.accel.template start<Generator>(run / "accel"),
                  imu.stamps.template start<Generator>(run / "stamps")) {}

  /// Makes the reading of a measurement taken at `time`, `interval` s after the previous one (for the first: the
  /// sampling interval). Returns false if the sample is dropped; `reading` is then unchanged. Stamps increase strictly:
  /// a stamp that its errors would put before next_stamp() of the last one becomes next_stamp(). Requires interval > 0.
  /// Throws std::invalid_argument for a stamp that is not finite.
  [[gnu::always_inline]] bool apply(Time time, const ImuMeasurement<Scalar>& ideal, const Scalar& interval,
                                    Reading& reading) {
    const bool first = first_;
    if (first) start_ = time;
    first_ = false;
    const Scalar elapsed = to_seconds<Scalar>(time - start_);
    Sample<Scalar> gyro{ideal.gyro, Vector3<Scalar>::Zero(), interval, first, elapsed, ideal};
    Sample<Scalar> accel{ideal.accel, Vector3<Scalar>::Zero(), interval, first, elapsed, ideal};
    imu_.gyro.apply(gyro, gyro_);
    imu_.accel.apply(accel, accel_);
    Time stamped = time;
    if constexpr (has_stamps) {
      Stamp<Scalar> stamp{Scalar(0), false, interval, first, elapsed};
      imu_.stamps.apply(stamp, stamps_);
      if (stamp.dropped) return false;
      stamped = after(time, static_cast<double>(stamp.offset));
      if (last_stamp_) stamped = (std::max)(stamped, next_stamp(*last_stamp_));
      require_finite("ImuErrors", "stamp", printable(stamped));
      last_stamp_ = stamped;
      reading.true_time = time;
    }
    reading.time = stamped;
    reading.gyro = gyro.value;
    reading.accel = accel.value;
    reading.gyro_bias = gyro.bias;
    reading.accel_bias = accel.bias;
    return true;
  }

 private:
  using GyroState = StateOfModel<decltype(Sensors::gyro), Generator>;
  using AccelState = StateOfModel<decltype(Sensors::accel), Generator>;
  using StampsState = StateOfModel<decltype(Sensors::stamps), Generator>;
  static_assert(
      AppliesTo<decltype(Sensors::gyro), Sample<Scalar>&, GyroState> &&
          AppliesTo<decltype(Sensors::accel), Sample<Scalar>&, AccelState> &&
          AppliesTo<decltype(Sensors::stamps), Stamp<Scalar>&, StampsState>,
      "the error terms use another scalar type than the motion: WhiteNoise{0.01} uses double, WhiteNoise{0.01F} "
      "float");
  struct Nothing {};

  // States are moved in, not constructed in place: once a function that is not inlined has had the address of a state,
  // the state can no longer be kept in registers.
  [[gnu::always_inline]] ImuErrors(const Sensors& imu, GyroState gyro, AccelState accel, StampsState stamps)
      : imu_(imu), gyro_(std::move(gyro)), accel_(std::move(accel)), stamps_(std::move(stamps)) {}

  [[no_unique_address]] Sensors imu_;
  [[no_unique_address]] GyroState gyro_;
  [[no_unique_address]] AccelState accel_;
  [[no_unique_address]] StampsState stamps_;
  [[no_unique_address]] std::conditional_t<has_stamps, std::optional<Time>, Nothing> last_stamp_{};
  Time start_{};
  bool first_ = true;
};

}  // namespace splinertia
