// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <splinertia/imu/error_model.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/message.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

/// The errors of the two sensors of an IMU: Imu{gyro, accel}.
template <typename Gyro = ErrorModel<>, typename Accel = ErrorModel<>>
struct Imu {
  [[no_unique_address]] Gyro gyro{};
  [[no_unique_address]] Accel accel{};
};

template <typename Gyro, typename Accel>
Imu(Gyro, Accel) -> Imu<Gyro, Accel>;

/// One simulated sample.
template <typename Scalar, TimePoint Time>
struct BasicImuReading {
  Time time;
  Vector3<Scalar> gyro;        ///< rad/s
  Vector3<Scalar> accel;       ///< m/s²
  Vector3<Scalar> gyro_bias;   ///< the true bias in `gyro`
  Vector3<Scalar> accel_bias;  ///< the true bias in `accel`
};

using ImuReading = BasicImuReading<double, double>;

template <typename Scalar, TimePoint Time>
struct SimulationOptions {
  double rate = 200;                                     ///< samples a second, Hz
  std::uint64_t seed = 0;                                ///< of the run; the same seed gives the same samples
  Vector3<Scalar> gravity = standard_gravity<Scalar>();  ///< acceleration of free fall in the world, m/s²
  std::optional<Time> start{};                           ///< of the first sample; default: where the motion starts
  std::optional<Time> end{};                             ///< no sample after it; default: where the motion ends
};

/// The samples of an IMU on a moving body: a range that makes each sample when it is reached, in constant memory, and
/// from the first one again at each begin(). See simulate().
template <typename Motion, typename Sensors>
class Simulation {
 public:
  using Trajectory = std::remove_cvref_t<Motion>;
  using Scalar = ScalarOf<typename Trajectory::Group>;
  using Time = typename Trajectory::Time;
  using Reading = BasicImuReading<Scalar, Time>;
  using Options = SimulationOptions<Scalar, Time>;

  Simulation(Motion&& motion, const Sensors& sensors, const Options& options)
      : motion_(std::forward<Motion>(motion)),
        sensors_(sensors),
        gravity_(options.gravity),
        rate_(options.rate),
        seed_(options.seed),
        start_(options.start.value_or(motion_.start())),
        end_(options.end.value_or(motion_.end())) {
    if (!(rate_ > 0 && rate_ <= std::numeric_limits<double>::max())) {
      throw std::invalid_argument(message("simulate: rate is ", rate_, " Hz, expected a positive finite number"));
    }
    if (!(motion_.start() <= start_ && start_ <= end_ && end_ <= motion_.end())) {
      throw std::invalid_argument(message("simulate: samples wanted from ", printable(start_), " to ", printable(end_),
                                          ", the motion is defined from ", printable(motion_.start()), " to ",
                                          printable(motion_.end())));
    }
    const double duration = seconds<double>(end_ - start_);
    if (!(duration <= std::numeric_limits<double>::max())) {
      throw std::invalid_argument("simulate: the motion has no bounds, expected options .start and .end");
    }
    // A sample that rounding alone puts behind the end still belongs to the run.
    const double intervals = duration * rate_;
    size_ = static_cast<std::size_t>(intervals * (1 + 4 * std::numeric_limits<double>::epsilon())) + 1;
  }

  /// The number of samples: both ends are sampled where they fall on one.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Trajectory& motion() const { return motion_; }

  class Iterator {
   public:
    using value_type = Reading;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::input_iterator_tag;

    explicit Iterator(const Simulation& simulation)
        : simulation_(&simulation),
          gyro_(simulation.sensors_.gyro.start(StreamKey(simulation.seed_) / "gyro")),
          accel_(simulation.sensors_.accel.start(StreamKey(simulation.seed_) / "accel")) {
      sample();
    }
    [[nodiscard]] const Reading& operator*() const { return reading_; }
    [[nodiscard]] const Reading* operator->() const { return &reading_; }
    Iterator& operator++() {
      if (++index_ < simulation_->size_) sample();
      return *this;
    }
    void operator++(int) { ++*this; }
    [[nodiscard]] bool operator==(std::default_sentinel_t) const { return index_ == simulation_->size_; }

   private:
    void sample() {
      const Simulation& s = *simulation_;
      reading_.time = s.time(index_);
      const auto ideal = ideal_imu(s.motion_.template evaluate<2>(reading_.time), s.gravity_);
      const Scalar interval = static_cast<Scalar>(1 / s.rate_);
      const bool first = index_ == 0;
      Sample<Scalar> gyro{ideal.gyro, Vector3<Scalar>::Zero(), interval, first};
      Sample<Scalar> accel{ideal.accel, Vector3<Scalar>::Zero(), interval, first};
      s.sensors_.gyro.apply(gyro, gyro_);
      s.sensors_.accel.apply(accel, accel_);
      reading_.gyro = gyro.value;
      reading_.accel = accel.value;
      reading_.gyro_bias = gyro.bias;
      reading_.accel_bias = accel.bias;
    }

    const Simulation* simulation_;
    std::size_t index_ = 0;
    [[no_unique_address]] typename decltype(Sensors::gyro)::State gyro_;
    [[no_unique_address]] typename decltype(Sensors::accel)::State accel_;
    Reading reading_;
  };

  [[nodiscard]] Iterator begin() const { return Iterator(*this); }
  [[nodiscard]] std::default_sentinel_t end() const { return {}; }

  /// When sample i is taken: counted from the start, so that no rounding adds up.
  [[nodiscard]] Time time(std::size_t i) const {
    const Time t = after(start_, static_cast<double>(i) / rate_);
    return t < end_ ? t : end_;
  }

 private:
  Motion motion_;  // a reference where the caller keeps the motion, else the motion itself
  [[no_unique_address]] Sensors sensors_;
  Vector3<Scalar> gravity_;
  double rate_;
  std::uint64_t seed_;
  Time start_;
  Time end_;
  std::size_t size_;
};

/// What an IMU in the body frame measures along a motion, with the error terms of `sensors`:
///
///   for (const auto& r : simulate(curve, Imu{gyro, accel}, {.rate = 200, .seed = 42})) …   // r.time, r.gyro, r.accel,
///   …
///
/// A motion passed as an lvalue is referred to and must outlive the simulation; a temporary is kept inside.
/// Throws std::invalid_argument for a rate that is not positive and finite, times outside the motion, or no bounds.
template <typename Motion, typename Sensors>
  requires(Trajectory<std::remove_cvref_t<Motion>, 2> && Pose<typename std::remove_cvref_t<Motion>::Group>)
[[nodiscard]] Simulation<Motion, Sensors> simulate(Motion&& motion, const Sensors& sensors,
                                                   const typename Simulation<Motion, Sensors>::Options& options = {}) {
  return {std::forward<Motion>(motion), sensors, options};
}

}  // namespace splinertia
