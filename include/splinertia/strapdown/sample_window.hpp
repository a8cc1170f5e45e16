// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/finite.hpp>
#include <splinertia/refuse.hpp>
#include <splinertia/strapdown/imu_sample.hpp>
#include <splinertia/strapdown/scheme.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

/// What to do with an interval between samples that is longer than it should be.
enum class GapPolicy { refuse, bridge };

template <typename Scalar>
struct GapOptions {
  Scalar longest = std::numeric_limits<Scalar>::max();  ///< the longest interval that is none, s
  GapPolicy policy = GapPolicy::refuse;                 ///< throw, or integrate across it and count it
};

/// The samples that a scheme looks at, and how far it has come: the part of an integration that knows no state. It
/// calls `take(window, from, time)` for each step that they allow, with the time of its end. No heap; a copy is an
/// independent continuation.
template <typename Scheme, typename Scalar, TimePoint Time>
class SampleWindow {
 public:
  static constexpr bool takes_increments = Scheme::takes_increments;
  struct Interval : StepMean<Scalar> {
    Time time;  // of its end
  };
  using Sample = std::conditional_t<takes_increments, Interval, TimedImuSample<Scalar, Time>>;

  /// Throws std::invalid_argument unless the longest interval is > 0.
  explicit SampleWindow(Time start, const GapOptions<Scalar>& gaps = {}) : last_(start), gaps_(gaps) {
    if (!(gaps.longest > Scalar(0))) {
      refuse("the longest interval is ", gaps.longest, " s, expected one > 0");
    }
    const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
    if constexpr (takes_increments) {
      samples_.fill({{zero, zero, Scalar(0)}, start});
    } else {
      samples_.fill({start, zero, zero});
    }
  }

  /// Adds a point sample: the first one at the start. Throws std::invalid_argument otherwise, for a stamp that is not
  /// after the last one, and for a gap that is refused; then nothing has changed.
  template <typename AnySample>
    requires(!takes_increments && ImuSample<AnySample, Scalar, Time>)
  void push(const AnySample& sample, const auto& take) {
    const Time time = sample.time;
    if (count_ > 0) {
      check(time);
    } else if (!(time == last_)) {
      refuse("the first sample is at ", printable(time), ", the initial state at ", printable(last_));
    }
    append({time, sample.gyro, sample.accel});
    advance(take);
  }

  /// Adds an increment: the first one begins at the start.
  template <typename AnySample>
    requires(takes_increments && ImuIncrement<AnySample, Scalar, Time>)
  void push(const AnySample& sample, const auto& take) {
    const Time time = sample.time;
    check(time);
    append({{sample.delta_angle, sample.delta_velocity, to_seconds<Scalar>(time - last_)}, time});
    advance(take);
  }

  /// The steps that wait for samples which will not come: one-sided, or shorter. Throws std::invalid_argument if there
  /// were fewer samples than the scheme needs.
  void finish(const auto& take) {
    if constexpr (!takes_increments) {
      if (count_ > 1 && count_ < window) {
        refuse(count_, " samples, expected at least ", window, ", which is what the scheme looks at");
      }
    }
    if (count_ > 0) {
      while (waiting() > 0) step(take);
    }
  }

  /// The time of the last sample, or of the start.
  [[nodiscard]] Time last() const { return last_; }
  /// How many gaps have been bridged.
  [[nodiscard]] std::size_t gaps() const { return bridged_; }

 private:
  static constexpr std::size_t window = Scheme::window;

  // Out of the way of what is inlined, and given copies: whose address is taken stays in memory.
  [[noreturn, gnu::noinline, gnu::cold]] static void refuse(auto... parts) {
    splinertia::refuse<std::invalid_argument>("integrate: ", parts...);
  }

  void check(Time time) {
    if (!(time > last_) || !is_finite(time)) {
      refuse("sample ", pushed_, " is at ", printable(time), ", expected a time after ", printable(last_));
    }
    const Scalar interval = to_seconds<Scalar>(time - last_);
    const bool gap = interval > gaps_.longest;
    if (gap && gaps_.policy == GapPolicy::refuse) {
      refuse("sample ", pushed_, " at ", printable(time), " comes ", interval,
             " s after the one before, expected at most ", gaps_.longest, " s");
    }
    if constexpr (Scheme::needs_equal_intervals) {
      using std::abs;
      // A hundredth puts as much of an error into the correction, which is itself small; jitter of stamps is below it.
      if (count_ > 0 && !(abs(interval - samples_.back().interval) <= samples_.back().interval / Scalar(100))) {
        refuse("sample ", pushed_, " at ", printable(time), " comes ", interval, " s after the one before, expected ",
               samples_.back().interval, " s: the scheme needs equal intervals");
      }
    }
    if (gap) ++bridged_;
  }

  void append(const Sample& sample) {
    for (std::size_t i = 0; i + 1 < window; ++i) samples_[i] = samples_[i + 1];
    samples_.back() = sample;
    last_ = sample.time;
    ++pushed_;
    // The position is that of the sample (point samples) or of the increment that the next step begins with.
    from_ = count_ == 0 ? window - 1 : from_ - 1;
    if (count_ < window) ++count_;
  }

  // Intervals that no step has covered yet.
  [[nodiscard]] std::size_t waiting() const { return window - from_ - (takes_increments ? 0 : 1); }

  void advance(const auto& take) {
    if constexpr (!takes_increments) {
      // All steps but the first and the last ones begin at the same place in the window.
      constexpr std::size_t usual = window - 1 - Scheme::stride - Scheme::lead;
      if (count_ == window && from_ == usual) [[likely]] {
        from_ = usual + Scheme::stride;
        take(samples_, usual, samples_[usual + Scheme::stride].time);
        return;
      }
    }
    while (count_ == window && waiting() >= Scheme::stride + Scheme::lead) step(take);
  }

  void step(const auto& take) {
    const std::size_t intervals = std::min(Scheme::stride, waiting());
    const std::size_t from = std::exchange(from_, from_ + intervals);  // first: `take` may throw
    if constexpr (takes_increments) {
      take(samples_, from, samples_[from_ - 1].time);
    } else {
      const auto samples = samples_;  // a copy, so that samples_ can be in registers in all other steps
      take(samples, from, samples[from_].time);
    }
  }

  std::array<Sample, window> samples_;
  std::size_t from_ = 0, count_ = 0, pushed_ = 0, bridged_ = 0;
  Time last_;
  GapOptions<Scalar> gaps_;
};

}  // namespace splinertia
