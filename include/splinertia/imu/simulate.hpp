// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/imu/detail/ideal_block.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/imu.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

template <typename Scalar, TimePoint Time>
struct SimulationOptions {
  double rate = 200;                                     ///< samples per second, Hz
  std::uint64_t seed = 0;                                ///< of the run; the same seed gives the same samples
  std::uint64_t imu = 0;                                 ///< number of the IMU in the run: each has its own errors
  Vector3<Scalar> gravity = standard_gravity<Scalar>();  ///< acceleration of free fall in the world, m/s²
  std::optional<Time> start{};                           ///< of the first sample; default: start of the motion
  std::optional<Time> end{};                             ///< no sample after it; default: end of the motion
};

/// The samples of an IMU on a moving body: a range that computes each sample when it is reached, in constant memory.
/// Each begin() starts again at the first sample. See simulate().
template <typename Motion, typename Sensors, BitGenerator Generator = Xoshiro256>
class Simulation {
 public:
  using Trajectory = std::remove_cvref_t<Motion>;
  using Scalar = ScalarOf<typename Trajectory::Group>;
  using Time = typename Trajectory::Time;
  using Errors = ImuErrors<Sensors, Scalar, Time, Generator>;
  using Reading = typename Errors::Reading;
  using Options = SimulationOptions<Scalar, Time>;

  Simulation(Motion&& motion, const Sensors& sensors, const Options& options)
      : motion_(std::forward<Motion>(motion)),
        sensors_(sensors),
        gravity_(options.gravity),
        rate_(options.rate),
        seed_(options.seed),
        imu_(options.imu),
        start_(options.start.value_or(motion_.start())),
        end_(options.end.value_or(motion_.end())) {
    if (!(rate_ > 0 && splinertia::is_finite(rate_))) {
      refuse<std::invalid_argument>("simulate: rate is ", rate_, " Hz, expected a positive finite number");
    }
    if (const auto interval = static_cast<Scalar>(1 / rate_);
        !(interval > Scalar(0) && splinertia::is_finite(interval)))
      refuse<std::invalid_argument>("simulate: rate is ", rate_, " Hz, expected a finite, non-zero interval 1/rate");
    for (int axis = 0; axis < 3; ++axis) require_finite("simulate", "gravity", gravity_[axis]);
    if (options.start) require_finite("simulate", "start", printable(start_));
    if (options.end) require_finite("simulate", "end", printable(end_));
    if (!(motion_.start() <= start_ && start_ <= end_ && end_ <= motion_.end())) {
      refuse<std::invalid_argument>("simulate: samples wanted from ", printable(start_), " to ", printable(end_),
                                    ", the motion is defined from ", printable(motion_.start()), " to ",
                                    printable(motion_.end()));
    }
    if (!(splinertia::is_finite(start_) && splinertia::is_finite(end_))) {
      refuse<std::invalid_argument>("simulate: the motion has no bounds, expected options .start and .end");
    }
    size_ = count_samples();
  }

  /// The number of samples taken. Both ends are sampled if they fall on a sample. Dropped samples are counted, too.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Trajectory& motion() const { return motion_; }

  class Iterator {
   public:
    using value_type = Reading;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::input_iterator_tag;

    [[gnu::always_inline]] explicit Iterator(const Simulation& simulation)
        : simulation_(&simulation),
          size_(simulation.size_),
          interval_(static_cast<Scalar>(1 / simulation.rate_)),
          errors_(simulation.sensors_, StreamKey(simulation.seed_) / simulation.imu_) {
      sample();
    }
    [[nodiscard]] const Reading& operator*() const { return reading_; }
    [[nodiscard]] const Reading* operator->() const { return &reading_; }
    [[gnu::always_inline]] Iterator& operator++() {
      ++index_;
      sample();
      return *this;
    }
    void operator++(int) { ++*this; }
    [[nodiscard, gnu::always_inline]] bool operator==(std::default_sentinel_t) const { return index_ == size_; }

   private:
    // Makes the next sample from index_ on that is not dropped.
    [[gnu::always_inline]] void sample() {
      const Simulation& s = *simulation_;
      for (; index_ < size_; ++index_) {
        if constexpr (LaneCurve<Trajectory>) {
          if (!ahead_.holds(index_)) {
            const std::size_t count = (std::min)(size_ - index_, ahead_.capacity);
            if (!ahead_.fill(s.motion_, s.gravity_, s.rate_, index_, count, [&s](std::size_t i) { return s.time(i); }))
                [[unlikely]]
              s.check(index_, count);
          }
          if (errors_.apply(ahead_.time(index_), ahead_[index_], interval_, reading_)) return;
        } else {
          const Time time = s.time(index_);
          const auto ideal = s.ideal(time);
          if (!splinertia::is_finite(finiteness(ideal))) [[unlikely]]
            s.refuse_sample(index_);
          if (errors_.apply(time, ideal, interval_, reading_)) return;
        }
      }
    }

    struct Nothing {};
    template <typename C>
    struct Ahead {
      using type = Nothing;
    };
    template <LaneCurve C>
    struct Ahead<C> {
      using type = IdealImuBlock<C>;
    };

    const Simulation* simulation_;
    [[no_unique_address]] typename Ahead<Trajectory>::type ahead_;
    std::size_t size_;
    std::size_t index_ = 0;
    Scalar interval_;
    Errors errors_;
    Reading reading_;
  };

  [[nodiscard, gnu::always_inline]] Iterator begin() const {
    // Moved, because a function that is not inlined has had the address of `first`: see ImuErrors.
    Iterator first = first_sample();
    return Iterator(std::move(first));
  }
  [[nodiscard]] std::default_sentinel_t end() const { return {}; }

  /// The time of sample i, computed from the start so that rounding does not accumulate. Requires i < size().
  [[nodiscard]] Time time(std::size_t i) const {
    Time t = start_;
    if constexpr (std::floating_point<Time>) {
      t += static_cast<Time>(elapsed(i));
    } else {  // as after(), without its checks, which count_samples() has made
      using Ticks = std::chrono::duration<double, typename Time::period>;
      t +=
          Time(static_cast<typename Time::rep>(std::llround(Ticks(std::chrono::duration<double>(elapsed(i))).count())));
    }
    return t < end_ ? t : end_;
  }

 private:
  // Not inlined, so that loops over the samples contain the code of a sample only once.
  [[nodiscard, gnu::noinline]] Iterator first_sample() const { return Iterator(*this); }

  // The time from the start to sample i, s.
  [[nodiscard]] double elapsed(std::size_t i) const {
    return static_cast<double>(static_cast<std::ptrdiff_t>(i)) / rate_;
  }

  // Counts both ends if they fall on a sample.
  [[nodiscard]] std::size_t count_samples() const {
    constexpr double most = (std::min)(0x1p53, static_cast<double>((std::numeric_limits<std::ptrdiff_t>::max)()));
    check_span("simulate", "samples", start_, end_);
    const double duration = to_seconds<double>(end_ - start_), intervals = duration * rate_;
    if (!(intervals < most)) {
      refuse<std::invalid_argument>("simulate: ", rate_, " Hz for ", duration, " s makes ", intervals,
                                    " samples, expected fewer than ", most);
    }
    // A sample that only rounding puts past the end still belongs to the run.
    const auto size = static_cast<std::size_t>(intervals * (1 + 4 * std::numeric_limits<double>::epsilon())) + 1;
    if (size > 1 && !(1 / rate_ >= resolution())) {
      refuse<std::invalid_argument>("simulate: rate is ", rate_, " Hz, expected samples at least ", resolution(),
                                    " s apart, so that their times differ");
    }
    static_cast<void>(after(start_, elapsed(size - 1)));  // throws unless Time holds the last time, and so all
    return size;
  }

  // The smallest difference that keeps two times of the run different numbers, s.
  [[nodiscard]] double resolution() const {
    if constexpr (std::floating_point<Time>) {
      // Each of two times is rounded three times (elapsed time, sum): together below 4 units in the last place.
      return static_cast<double>(4 * std::numeric_limits<Time>::epsilon() *
                                 (std::max)(std::abs(start_), std::abs(end_)));
    } else {
      return to_seconds<double>(Time(1));
    }
  }

  [[nodiscard, gnu::always_inline]] ImuMeasurement<Scalar> ideal(Time time) const {
    return flattened<Scalar>([this, time] { return ideal_imu(motion_.template evaluate<2>(time), gravity_); });
  }

  // Throws if the motion gives a reading that is not finite at one of the samples first … first + count − 1.
  [[gnu::cold, gnu::noinline]] void check(std::size_t first, std::size_t count) const {
    for (std::size_t i = first; i < first + count; ++i) {
      const ImuMeasurement<Scalar> m = ideal(time(i));
      for (const auto& [name, reading] : {std::pair("gyro", m.gyro), std::pair("accel", m.accel)}) {
        for (int axis = 0; axis < 3; ++axis) {
          if (splinertia::is_finite(reading[axis])) continue;
          refuse<std::invalid_argument>("simulate: the motion gives ", name, ' ', "xyz"[axis], " = ", reading[axis],
                                        " at sample ", i, ", time ", printable(time(i)), ", expected a finite number");
        }
      }
    }
  }
  // Does not return, so that the calling loop keeps nothing alive across the call.
  [[noreturn, gnu::cold, gnu::noinline]] void refuse_sample(std::size_t i) const {
    check(i, 1);
    refuse<std::invalid_argument>("simulate: the motion gives readings whose sum overflows at sample ", i, ", time ",
                                  printable(time(i)));
  }

  Motion motion_;  // a reference where the caller keeps the motion, else the motion itself
  [[no_unique_address]] Sensors sensors_;
  Vector3<Scalar> gravity_;
  double rate_;
  std::uint64_t seed_;
  std::uint64_t imu_;
  Time start_;
  Time end_;
  std::size_t size_;
};

/// What an IMU in the body frame measures along a motion, with the errors of `sensors`:
///
///   for (const auto& r : simulate(curve, Imu{gyro, accel}, {.rate = 200, .seed = 42})) …
///
/// Each sample has r.time, r.gyro, r.accel, r.gyro_bias, r.accel_bias, and r.true_time if the stamps have errors.
/// Random numbers come from Generator, any uniform random bit generator: simulate<std::mt19937_64>(…). A motion passed
/// as an lvalue is kept by reference and must outlive the simulation; a temporary is moved into it.
/// Throws std::invalid_argument for a rate that is not positive and finite or that is too high for the clock to tell
/// samples apart, for gravity that is not finite, for times outside the motion, and for a motion without bounds if
/// start or end is missing. While it runs, throws it if the motion gives a reading, or the errors a stamp, that is not
/// finite.
template <BitGenerator Generator = Xoshiro256, typename Motion, typename Sensors>
  requires(Trajectory<std::remove_cvref_t<Motion>, 2> && Pose<typename std::remove_cvref_t<Motion>::Group>)
[[nodiscard]] Simulation<Motion, Sensors, Generator> simulate(
    Motion&& motion, const Sensors& sensors,
    const typename Simulation<Motion, Sensors, Generator>::Options& options = {}) {
  return {std::forward<Motion>(motion), sensors, options};
}

}  // namespace splinertia
