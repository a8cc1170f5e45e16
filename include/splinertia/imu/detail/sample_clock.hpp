// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia::detail {

/// The times at which a run along a motion is sampled: start, start + 1/rate, … up to the end.
template <typename Scalar, TimePoint Time>
class SampleClock {
 public:
  /// `options`: SimulationOptions. Throws std::invalid_argument, in the name of the function `whose`, as simulate()
  /// does for rate, gravity, start and end.
  SampleClock(const char* whose, const auto& motion, const auto& options)
      : rate_(options.rate), start_(options.start.value_or(motion.start())), end_(options.end.value_or(motion.end())) {
    if (!(rate_ > 0 && is_finite(rate_))) {
      refuse<std::invalid_argument>(whose, ": rate is ", rate_, " Hz, expected a positive finite number");
    }
    if (const auto interval = static_cast<Scalar>(1 / rate_); !(interval > Scalar(0) && is_finite(interval)))
      refuse<std::invalid_argument>(whose, ": rate is ", rate_, " Hz, expected a finite, non-zero interval 1/rate");
    for (int axis = 0; axis < 3; ++axis) require_finite(whose, "gravity", options.gravity[axis]);
    if (options.start) require_finite(whose, "start", seconds_or_ticks(start_));
    if (options.end) require_finite(whose, "end", seconds_or_ticks(end_));
    if (!(motion.start() <= start_ && start_ <= end_ && end_ <= motion.end())) {
      refuse<std::invalid_argument>(whose, ": samples wanted from ", seconds_or_ticks(start_), " to ",
                                    seconds_or_ticks(end_), ", the motion is defined from ",
                                    seconds_or_ticks(motion.start()), " to ", seconds_or_ticks(motion.end()));
    }
    if (!(is_finite(start_) && is_finite(end_))) {
      refuse<std::invalid_argument>(whose, ": the motion has no bounds, expected options .start and .end");
    }
    size_ = count_samples(whose);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double rate() const { return rate_; }
  /// 1/rate, s.
  [[nodiscard]] Scalar interval() const { return static_cast<Scalar>(1 / rate_); }

  /// The time of sample i, computed from the start so that rounding does not accumulate. Requires i < size().
  [[nodiscard]] Time operator()(std::size_t i) const {
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
  // The time from the start to sample i, s.
  [[nodiscard]] double elapsed(std::size_t i) const {
    return static_cast<double>(static_cast<std::ptrdiff_t>(i)) / rate_;
  }

  // Counts both ends if they fall on a sample.
  [[nodiscard]] std::size_t count_samples(const char* whose) const {
    constexpr double most = (std::min)(0x1p53, static_cast<double>((std::numeric_limits<std::ptrdiff_t>::max)()));
    check_span(whose, "samples", start_, end_);
    const double duration = to_seconds<double>(end_ - start_), intervals = duration * rate_;
    if (!(intervals < most)) {
      refuse<std::invalid_argument>(whose, ": ", rate_, " Hz for ", duration, " s makes ", intervals,
                                    " samples, expected fewer than ", most);
    }
    // A sample that only rounding puts past the end still belongs to the run.
    const auto size = static_cast<std::size_t>(intervals * (1 + 4 * std::numeric_limits<double>::epsilon())) + 1;
    if (size > 1 && !(1 / rate_ >= resolution())) {
      refuse<std::invalid_argument>(whose, ": rate is ", rate_, " Hz, expected samples at least ", resolution(),
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

  double rate_;
  Time start_;
  Time end_;
  std::size_t size_ = 0;
};

}  // namespace splinertia::detail
