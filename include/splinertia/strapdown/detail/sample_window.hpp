// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/strapdown/detail/sample_stamps.hpp>
#include <splinertia/strapdown/gap_options.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// The window of samples that a scheme looks at, and its progress: the part of an integration that needs no state. It
/// calls `take(window, from, time)` for each step that the samples allow; `time` is the end of the step. It uses no
/// heap. A copy continues independently.
template <typename Scheme, typename Scalar, TimePoint Time>
class SampleWindow {
 public:
  static constexpr bool takes_increments = Scheme::takes_increments;
  struct Interval : StepMean<Scalar> {
    Time time;  // of its end
  };
  using Sample = std::conditional_t<takes_increments, Interval, ImuSample<Scalar, Time>>;

  /// Throws std::invalid_argument for a start that is not finite and unless the longest interval is > 0. Messages begin
  /// with the name of the function `whose`.
  explicit SampleWindow(Time start, const GapOptions<Scalar>& gaps = {}, const char* whose = "integrate")
      : stamps_(whose, start, gaps, window > 1 ? static_cast<int>(window) - 1 : 1) {
    const Eigen::Vector3<Scalar> zero = Eigen::Vector3<Scalar>::Zero();
    if constexpr (takes_increments) {
      samples_.fill({{zero, zero, Scalar(0)}, start});
    } else {
      samples_.fill({start, zero, zero});
    }
  }

  /// Adds a point sample; the first one has to be at the start. Throws std::invalid_argument if it is not, for readings
  /// that are not finite or beyond largest_factor(), for a stamp that is not after the last one, and for a gap that is
  /// refused. Then nothing has changed.
  template <typename AnySample>
    requires(!takes_increments && ImuSampleOf<AnySample, Scalar, Time>)
  SPLINERTIA_ALWAYS_INLINE void push(const AnySample& any, const auto& take) {
    const Time time = any.time;
    check(time, any.gyro, any.accel);
    append({time, any.gyro, any.accel});
    advance(take);
  }

  /// Adds an increment; the first one begins at the start. Throws as above.
  template <typename AnySample>
    requires(takes_increments && ImuIncrementOf<AnySample, Scalar, Time>)
  SPLINERTIA_ALWAYS_INLINE void push(const AnySample& any, const auto& take) {
    const Time time = any.time;
    check(time, any.delta_angle, any.delta_velocity);
    append({{any.delta_angle, any.delta_velocity, stamps_.since_last(time)}, time});
    advance(take);
  }

  /// Takes the steps that wait for further samples without them: one-sided or shorter. If there are fewer point samples
  /// than the window holds, the first one is repeated at intervals of 0.
  void finish(const auto& take) {
    if constexpr (!takes_increments) {
      if (pushed_ > 0 && pushed_ < window) std::fill_n(samples_.begin(), window - pushed_, samples_[window - pushed_]);
    }
    if (pushed_ > 0) {
      while (waiting() > 0) step(take);
    }
  }

  /// The time of the last sample, or of the start.
  [[nodiscard]] Time last() const { return stamps_.last(); }
  /// The time from last() to a later one, s.
  [[nodiscard]] Scalar since_last(Time time) const { return stamps_.since_last(time); }
  /// The number of bridged gaps.
  [[nodiscard]] std::size_t gaps() const { return stamps_.gaps(); }

 private:
  static constexpr std::size_t window = Scheme::window;
  using Stamps = SampleStamps<Scalar, Time>;

  SPLINERTIA_ALWAYS_INLINE void check(Time time, const Eigen::Vector3<Scalar>& rate,
                                      const Eigen::Vector3<Scalar>& force) {
    using std::abs;
    if constexpr (Scheme::needs_equal_intervals) {
      // A deviation of 1 % causes an error of 1 % of the correction, which is itself small. Stamps jitter by less.
      const Scalar interval = stamps_.since_last(time), expected = samples_.back().interval;
      if (pushed_ > 0 && time > last() && !(abs(interval - expected) <= expected / Scalar(100))) {
        refuse<std::invalid_argument>(stamps_.whose(), ": sample ", pushed_, " at ", seconds_or_ticks(time), " comes ",
                                      interval, " s after the one before, expected ", expected,
                                      " s: the scheme needs equal intervals");
      }
    }
    // The sum is finite only if all readings are. That of large readings may exceed most(): examine() decides. Readings
    // beyond largest_factor() that cancel each other in the sum pass.
    const Scalar sum = abs((rate + force).sum());
    if (!(stamps_.follows(time) && sum <= most() && (!finite_math_only || is_finite(sum)))) [[unlikely]]
      examine(time, rate, force);
  }

  // The largest magnitude of a reading: schemes multiply up to three readings.
  [[nodiscard]] static constexpr Scalar most() {
    if constexpr (std::floating_point<Scalar>) {
      constexpr Scalar factor = largest_factor<Scalar>();
      return factor;
    } else {
      return (std::numeric_limits<Scalar>::max)();
    }
  }

  // Not inlined, because it is rare.
  SPLINERTIA_COLD void examine(Time time, const Eigen::Vector3<Scalar>& rate, const Eigen::Vector3<Scalar>& force) {
    Stamps stamps = stamps_;
    if (takes_increments || pushed_ > 0) {
      stamps = stamps_.judged(time, pushed_, takes_increments ? pushed_ : pushed_ - 1);
    } else if (is_finite(time) && time == last()) {
      stamps = stamps_.begun();
    } else {
      refuse<std::invalid_argument>(stamps_.whose(), ": the first sample is at ", seconds_or_ticks(time),
                                    ", the initial state at ", seconds_or_ticks(last()), ", expected the same time");
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      check_reading(rate[i], takes_increments ? "delta_angle" : "gyro", i, time);
      check_reading(force[i], takes_increments ? "delta_velocity" : "accel", i, time);
    }
    stamps_ = stamps;
  }

  void check_reading(const Scalar& reading, const char* sensor, Eigen::Index axis, Time time) const {
    if (!is_finite(reading)) {
      refuse<std::invalid_argument>(stamps_.whose(), ": sample ", pushed_, " at ", seconds_or_ticks(time), " has ",
                                    sensor, '[', axis, "] = ", reading, ", expected a finite number");
    }
    if (!(-most() <= reading && reading <= most())) {
      refuse<std::invalid_argument>(stamps_.whose(), ": sample ", pushed_, " at ", seconds_or_ticks(time), " has ",
                                    sensor, '[', axis, "] = ", reading, ", expected at most ", most(), " in magnitude");
    }
  }

  void append(const Sample& sample) {
    for (std::size_t i = 0; i + 1 < window; ++i) samples_[i] = samples_[i + 1];
    samples_.back() = sample;
    stamps_.append(sample.time);
    ++pushed_;
  }

  // Intervals that no step has covered yet.
  [[nodiscard]] std::size_t waiting() const { return window - from_ - (takes_increments ? 0 : 1); }

  SPLINERTIA_ALWAYS_INLINE void advance(const auto& take) {
    // The index of the sample or increment with which the next step begins.
    const std::size_t from = from_ - 1;
    // All steps but the first and the last ones begin at the same index.
    constexpr std::size_t usual = window - (takes_increments ? 0 : 1) - Scheme::stride - Scheme::lead;
    if (from == usual && (usual == 0 || pushed_ >= window)) [[likely]] {
      from_ = usual + Scheme::stride;
      take(samples_, usual, samples_[usual + Scheme::stride - (takes_increments ? 1 : 0)].time);
      return;
    }
    from_ = from;
    if constexpr (usual > 0) {
      if (from > usual) return;
      while (pushed_ >= window && waiting() >= Scheme::stride + Scheme::lead) step(take);
    }
  }

  void step(const auto& take) {
    const std::size_t intervals = (std::min)(Scheme::stride, waiting());
    const std::size_t from = std::exchange(from_, from_ + intervals);  // before `take`, which may throw
    if constexpr (takes_increments) {
      take(samples_, from, samples_[from_ - 1].time);
    } else {
      const auto samples = samples_;  // a copy, so that samples_ can stay in registers in all other steps
      take(samples, from, samples[from_].time);
    }
  }

  std::array<Sample, window> samples_;
  std::size_t from_ = window;
  Stamps stamps_;
  std::size_t pushed_ = 0;
};

}  // namespace splinertia::detail
