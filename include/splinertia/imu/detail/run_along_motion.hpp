// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/imu/detail/sample_clock.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/imu_measurement.hpp>
#include <splinertia/imu/mounting.hpp>
#include <splinertia/random/random_stream.hpp>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// The Mounting of an IMU on a body that moves so.
template <typename Motion>
using MountingOn = Mounting<ScalarOf<typename std::remove_cvref_t<Motion>::Group>>;

/// A mounting as that of an IMU on a body that moves so: it needs the same scalar.
template <typename Motion, typename Scalar>
[[nodiscard]] MountingOn<Motion> mounting_on(const Mounting<Scalar>& mounting) {
  constexpr bool same = std::is_same_v<Mounting<Scalar>, MountingOn<Motion>>;
  static_assert(same,
                "the Mounting has another scalar type than the motion: a motion in float needs a Mounting<float>");
  if constexpr (same) {
    return mounting;
  } else {
    return {};
  }
}

/// What a simulated run of an IMU along a motion is made of. Mount is Mounting<Scalar> if the IMU is not at the body
/// frame.
template <typename Motion, typename Sensors, typename Mount>
class RunAlongMotion {
 public:
  using Trajectory = std::remove_cvref_t<Motion>;
  using Scalar = ScalarOf<typename Trajectory::Group>;
  using Time = typename Trajectory::Time;

  [[nodiscard]] const Trajectory& motion() const { return motion_; }
  /// The time of sample i, computed from the start so that rounding does not accumulate. Requires i to be less than the
  /// number of samples.
  [[nodiscard]] Time time(std::size_t i) const { return clock_(i); }

 protected:
  /// `options`: SimulationOptions. Throws std::invalid_argument, in the name of the function `whose`, for bad options and
  /// a mounting that is not finite.
  RunAlongMotion(const char* whose, Motion&& motion, const Sensors& sensors, const auto& options, const Mount& mounting)
      : motion_(std::forward<Motion>(motion)),
        sensors_(sensors),
        mounting_(mounting),
        gravity_(options.gravity),
        clock_(whose, motion_, options),
        key_(StreamKey(options.seed) / options.imu) {
    if constexpr (!std::is_same_v<Mount, NotMounted>) require_finite(whose, mounting);
  }

  /// What a perfect IMU measures.
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE ImuMeasurement<Scalar> ideal(Time time) const {
    return flattened<Scalar>([this, time] {
      if constexpr (std::is_same_v<Mount, NotMounted>) {
        return ideal_imu(motion_.template evaluate<2>(time), gravity_);
      } else {
        return ideal_imu(motion_.template evaluate<2>(time), gravity_, mounting_);
      }
    });
  }

  Motion motion_;  // a reference where the caller keeps the motion, else the motion itself
  [[no_unique_address]] Sensors sensors_;
  [[no_unique_address]] Mount mounting_;
  Eigen::Vector3<Scalar> gravity_;
  SampleClock<Scalar, Time> clock_;
  StreamKey key_;
};

}  // namespace splinertia::detail
