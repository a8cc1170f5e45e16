// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/imu/detail/ideal_block.hpp>
#include <splinertia/imu/detail/run_along_motion.hpp>
#include <splinertia/imu/detail/run_iterator.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/imu.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

template <typename Scalar = double, TimePoint Time = double>
struct SimulationOptions {
  double rate = 200;       ///< samples per second, Hz
  std::uint64_t seed = 0;  ///< of the run; the same seed gives the same samples
  std::uint64_t imu = 0;   ///< number of the IMU in the run: each has its own errors
  Eigen::Vector3<Scalar> gravity = standard_gravity<Scalar>();  ///< acceleration of free fall in the world, m/s²
  std::optional<Time> start{};                                  ///< of the first sample; default: start of the motion
  std::optional<Time> end{};                                    ///< no sample after it; default: end of the motion
};

namespace detail {

/// The samples of an IMU on a moving body: a range that computes each sample when it is reached, in constant memory.
/// Each begin() starts again at the first sample. Mount is Mounting<Scalar> if the IMU is not at the body frame. See
/// simulate().
template <typename Motion, typename Sensors, BitGenerator Generator = Xoshiro256, typename Mount = NotMounted>
class Simulation : public RunAlongMotion<Motion, Sensors, Mount> {
  using Base = RunAlongMotion<Motion, Sensors, Mount>;

 public:
  using typename Base::Trajectory, typename Base::Scalar, typename Base::Time;
  using Errors = ImuErrors<Sensors, Scalar, Time, Generator>;
  using Reading = typename Errors::Reading;
  using Options = SimulationOptions<Scalar, Time>;

  Simulation(Motion&& motion, const Sensors& sensors, const Options& options, const Mount& mounting = {})
      : Base("simulate", std::forward<Motion>(motion), sensors, options, mounting) {}

  /// The number of samples taken. Both ends are sampled if they fall on a sample. Dropped samples are counted, too.
  [[nodiscard]] std::size_t size() const { return clock_.size(); }

 private:
  class Run;

 public:
  using Base::time;
  using Iterator = RunIterator<Run>;

  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE Iterator begin() const {
    // Moved, because a function that is not inlined has had the address of `first`: see ImuErrors.
    Iterator first = first_sample();
    return Iterator(std::move(first));
  }
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE Iterator end() const { return {}; }

 private:
  // The state of one iteration.
  class Run {
   public:
    using Reading = Simulation::Reading;

    SPLINERTIA_ALWAYS_INLINE explicit Run(const Simulation& simulation)
        : simulation_(&simulation),
          interval_(simulation.clock_.interval()),
          errors_(simulation.sensors_, simulation.key_) {}

    [[nodiscard]] const Reading& reading() const { return reading_; }

    [[nodiscard]] SPLINERTIA_ALWAYS_INLINE std::size_t next(std::size_t index) {
      const Simulation& s = *simulation_;
      for (; index < s.size(); ++index) {
        if constexpr (PackedCurve<Trajectory>) {
          if (!ahead_.holds(index)) {
            const std::size_t count = (std::min)(s.size() - index, ahead_.capacity);
            if (!ahead_.fill(s.motion_, s.gravity_, s.mounting_, s.clock_.rate(), index, count, s.clock_)) [[unlikely]]
              s.check(index, count);
          }
          if (errors_.apply(ahead_.time(index), ahead_[index], interval_, reading_)) return index;
        } else {
          const Time time = s.time(index);
          const auto ideal = s.ideal(time);
          if (!is_finite(finiteness(ideal))) [[unlikely]]
            s.refuse_sample(index);
          if (errors_.apply(time, ideal, interval_, reading_)) return index;
        }
      }
      return no_reading;
    }

   private:
    struct Nothing {};
    template <typename C>
    struct Ahead {
      using type = Nothing;
    };
    template <PackedCurve C>
    struct Ahead<C> {
      using type = IdealImuBlock<C>;
    };

    const Simulation* simulation_;
    [[no_unique_address]] typename Ahead<Trajectory>::type ahead_;
    Scalar interval_;
    Errors errors_;
    Reading reading_;
  };

  // Not inlined, so that loops over the samples contain the code of a sample only once.
  [[nodiscard]] SPLINERTIA_NOINLINE Iterator first_sample() const { return Iterator(std::in_place, *this); }

  // Throws if the motion gives a reading that is not finite at one of the samples first … first + count − 1.
  SPLINERTIA_COLD void check(std::size_t first, std::size_t count) const {
    for (std::size_t i = first; i < first + count; ++i) {
      const ImuMeasurement<Scalar> m = ideal(time(i));
      for (const auto& [name, reading] : {std::pair("gyro", m.gyro), std::pair("accel", m.accel)}) {
        for (int axis = 0; axis < 3; ++axis) {
          if (is_finite(reading[axis])) continue;
          refuse<std::invalid_argument>("simulate: the motion gives ", name, ' ', "xyz"[axis], " = ", reading[axis],
                                        " at sample ", i, ", time ", seconds_or_ticks(time(i)),
                                        ", expected a finite number");
        }
      }
    }
  }
  // Does not return, so that the calling loop keeps nothing alive across the call.
  [[noreturn]] SPLINERTIA_COLD void refuse_sample(std::size_t i) const {
    check(i, 1);
    refuse<std::invalid_argument>("simulate: the motion gives readings whose sum overflows at sample ", i, ", time ",
                                  seconds_or_ticks(time(i)));
  }

  using Base::ideal, Base::motion_, Base::sensors_, Base::mounting_, Base::gravity_, Base::clock_, Base::key_;
};

}  // namespace detail

/// What an IMU in the body frame measures along a motion, with the errors of `sensors`:
///
///   for (const auto& r : simulate(curve, Imu{gyro, accel}, {.rate = 200, .seed = 42})) …
///   write_euroc_imu("imu.csv", simulate(curve, presets::euroc));
///   const std::vector samples = to_vector(simulate(curve, presets::euroc));
///
/// Each sample is an ImuSample with r.time, r.gyro, r.accel, and has r.gyro_bias, r.accel_bias, and r.true_time if the
/// stamps have errors. Random numbers come from Generator, any uniform random bit generator:
/// simulate<std::mt19937_64>(…). A motion passed as an lvalue is kept by reference and must outlive the simulation; a
/// temporary is moved into it. Iterators refer to the simulation.
/// Throws std::invalid_argument for a rate that is not positive and finite or that is too high for the clock to tell
/// samples apart, for gravity that is not finite, for times outside the motion, and for a motion without bounds if
/// start or end is missing. While it runs, throws it if the motion gives a reading, or the errors a stamp, that is not
/// finite.
template <BitGenerator Generator = Xoshiro256, typename Motion, typename Sensors>
  requires(Trajectory<std::remove_cvref_t<Motion>, 2> && Pose<typename std::remove_cvref_t<Motion>::Group>)
[[nodiscard]] detail::Simulation<Motion, Sensors, Generator> simulate(
    Motion&& motion, const Sensors& sensors,
    const typename detail::Simulation<Motion, Sensors, Generator>::Options& options = {}) {
  return {std::forward<Motion>(motion), sensors, options};
}

/// The same for an IMU that is mounted on the body with a rotation and a lever arm:
///
///   simulate(curve, imu, Mounting{R_BI, p_BI}, {.rate = 200, .seed = 42})
///
/// The motion is that of the body, gyro and accel are in the IMU's axes (ideal_imu()). Several IMUs of one run share
/// its seed and have different numbers `options.imu`. Also throws std::invalid_argument for a mounting that is not
/// finite.
template <BitGenerator Generator = Xoshiro256, typename Motion, typename Sensors, typename Scalar>
  requires(Trajectory<std::remove_cvref_t<Motion>, 2> && Pose<typename std::remove_cvref_t<Motion>::Group>)
[[nodiscard]] detail::Simulation<Motion, Sensors, Generator, detail::MountingOn<Motion>> simulate(
    Motion&& motion, const Sensors& sensors, const Mounting<Scalar>& mounting,
    const typename detail::Simulation<Motion, Sensors, Generator>::Options& options = {}) {
  return {std::forward<Motion>(motion), sensors, options, detail::mounting_on<Motion>(mounting)};
}

}  // namespace splinertia
