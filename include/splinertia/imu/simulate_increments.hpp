// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/imu/detail/mean_imu.hpp>
#include <splinertia/imu/detail/run_along_motion.hpp>
#include <splinertia/imu/detail/run_iterator.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

/// One simulated increment: an increment with the true biases that it contains.
template <typename Scalar = double, TimePoint Time = double>
struct ImuIncrementReading : ImuIncrement<Scalar, Time> {
  Eigen::Vector3<Scalar>
      gyro_bias;  ///< mean over the interval, rad/s: delta_angle contains gyro_bias times the interval
  Eigen::Vector3<Scalar> accel_bias;  ///< the same in delta_velocity, m/s²
  Time true_time;                     ///< when the interval ended; differs from `time` if the stamps have errors
};

namespace detail {

/// The increments of an IMU on a moving body: a range that computes each when it is reached, in constant memory. Each
/// begin() starts again at the first one. See simulate_increments().
template <typename Motion, typename Sensors, BitGenerator Generator = Xoshiro256, typename Mount = NotMounted>
class IncrementSimulation : public RunAlongMotion<Motion, Sensors, Mount> {
  using Base = RunAlongMotion<Motion, Sensors, Mount>;

 public:
  using typename Base::Trajectory, typename Base::Scalar, typename Base::Time;
  using Reading = ImuIncrementReading<Scalar, Time>;
  using Options = SimulationOptions<Scalar, Time>;

  IncrementSimulation(Motion&& motion, const Sensors& sensors, const Options& options, const Mount& mounting = {})
      : Base("simulate_increments", std::forward<Motion>(motion), sensors, options, mounting) {}

  /// The number of increments, dropped ones included.
  [[nodiscard]] std::size_t size() const { return clock_.size() - 1; }
  /// The time at which increment i begins and increment i − 1 ends. Requires i <= size().
  using Base::time;

 private:
  class Run;

 public:
  using Iterator = RunIterator<Run>;

  [[nodiscard]] Iterator begin() const { return Iterator(std::in_place, *this); }
  [[nodiscard]] Iterator end() const { return {}; }

 private:
  // The state of one iteration.
  class Run {
   public:
    using Reading = IncrementSimulation::Reading;

    explicit Run(const IncrementSimulation& simulation)
        : simulation_(&simulation), errors_(simulation.sensors_, simulation.key_) {}

    [[nodiscard]] const Reading& reading() const { return reading_; }

    [[nodiscard]] std::size_t next(std::size_t index) {
      const IncrementSimulation& s = *simulation_;
      for (; index < s.size(); ++index) {
        const Time begin = s.time(index), end = s.time(index + 1);
        const auto mean = mean_(s.motion_, begin, end, [&s](Time t) { return s.ideal(t); });
        if (!is_finite(finiteness(mean))) [[unlikely]]
          s.refuse_increment(index);
        typename Errors::Reading with_errors;
        if (!errors_.apply(end, mean, s.clock_.interval(), with_errors)) continue;
        const Scalar h = to_seconds<Scalar>(end - begin);
        reading_ = {{with_errors.time, with_errors.gyro * h, with_errors.accel * h},
                    with_errors.gyro_bias,
                    with_errors.accel_bias,
                    end};
        return index;
      }
      return no_reading;
    }

   private:
    using Errors = ImuErrors<Sensors, Scalar, Time, Generator>;

    const IncrementSimulation* simulation_;
    MeanImu<Trajectory> mean_;
    Errors errors_;
    Reading reading_;
  };

  [[noreturn]] SPLINERTIA_COLD void refuse_increment(std::size_t i) const {
    refuse<std::invalid_argument>("simulate_increments: the motion gives readings that are not finite in increment ", i,
                                  ", time ", seconds_or_ticks(time(i)), " to ", seconds_or_ticks(time(i + 1)),
                                  ", expected finite numbers");
  }

  using Base::ideal, Base::motion_, Base::sensors_, Base::clock_, Base::key_;
};

}  // namespace detail

/// What an IMU in the body frame delivers along a motion if it integrates its readings, with the errors of `sensors`:
///
///   Δθ = ∫ω dt,  Δv = ∫f dt   over each interval of 1/rate, in the turning axes of the IMU
///
/// without corrections for coning and sculling, which the schemes of coning_sculling.hpp make:
///
///   const auto initial = nav_state(curve.evaluate<1>(curve.start()), curve.start());
///   integrate<TwoSampleIncrements>(initial, simulate_increments(curve, imu))
///
/// Each increment is an ImuIncrement with the time at the end of its interval, and has gyro_bias, accel_bias and
/// true_time. The integrals are exact but for 5.7e-10 (ωh)⁸ of the amplitude of a reading that oscillates with ω rad/s
/// (h: the interval; for a spline the part of it between knots). The errors are those of the mean readings over the
/// interval, times its length: white noise of density N has standard deviation N·√h in an increment, a bias b adds b·h,
/// and saturation and quantization act on the mean. A dropped increment is lost.
///
/// Options, motion and random numbers are as for simulate(): one more time than increments. Throws
/// std::invalid_argument as simulate() does.
template <BitGenerator Generator = Xoshiro256, typename Motion, typename Sensors>
  requires(Trajectory<std::remove_cvref_t<Motion>, 2> && Pose<typename std::remove_cvref_t<Motion>::Group>)
[[nodiscard]] detail::IncrementSimulation<Motion, Sensors, Generator> simulate_increments(
    Motion&& motion, const Sensors& sensors,
    const typename detail::IncrementSimulation<Motion, Sensors, Generator>::Options& options = {}) {
  return {std::forward<Motion>(motion), sensors, options};
}

/// The same for an IMU that is mounted on the body (simulate()).
template <BitGenerator Generator = Xoshiro256, typename Motion, typename Sensors, typename Scalar>
  requires(Trajectory<std::remove_cvref_t<Motion>, 2> && Pose<typename std::remove_cvref_t<Motion>::Group>)
[[nodiscard]] detail::IncrementSimulation<Motion, Sensors, Generator, detail::MountingOn<Motion>> simulate_increments(
    Motion&& motion, const Sensors& sensors, const Mounting<Scalar>& mounting,
    const typename detail::IncrementSimulation<Motion, Sensors, Generator>::Options& options = {}) {
  return {std::forward<Motion>(motion), sensors, options, detail::mounting_on<Motion>(mounting)};
}

}  // namespace splinertia
