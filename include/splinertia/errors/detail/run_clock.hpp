// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <optional>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/time.hpp>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// The times of the samples of one run, and the stamps that a clock with the errors `Stamps` gives them.
template <typename Stamps, typename Scalar, TimePoint Time, BitGenerator Generator>
class RunClock {
 public:
  static constexpr bool has_stamps = !std::is_same_v<Stamps, ErrorModel<>>;
  using State = StateOfModel<Stamps, Stamp<Scalar>::axes, Generator>;

  /// A time at which a sample is taken. `interval` and `elapsed` as in SensorSample.
  struct Instant {
    Time time;
    Scalar interval;
    bool first;
    Scalar elapsed;
  };

  SPLINERTIA_ALWAYS_INLINE explicit RunClock(State stamps) : stamps_(std::move(stamps)) {}

  /// The time of the next sample. Requires interval > 0, and of an integer Time that it holds the difference to the
  /// first time.
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE Instant sample_at(Time time, const Scalar& interval) {
    assert(interval > Scalar(0) && "an interval between samples is positive");
    const bool first = first_;
    if (first) start_ = time;
    first_ = false;
    assert(have_difference(start_, time) && "the times of a run span more ticks than their type can count");
    return {time, interval, first, to_seconds<Scalar>(time - start_)};
  }

  /// Writes the stamp of a sample to reading.time and, if stamps have errors, the true time to reading.true_time.
  /// Returns false if the sample is dropped; `reading` is then unchanged. A stamp that would be before next_stamp() of
  /// the last one becomes next_stamp(). Throws std::invalid_argument, in the name of `whose`, for a stamp that is not
  /// finite.
  template <typename Reading>
  SPLINERTIA_ALWAYS_INLINE bool stamp(const Stamps& errors, const Instant& now, const char* whose, Reading& reading) {
    if constexpr (has_stamps) {
      Stamp<Scalar> stamp{Scalar(0), false, now.interval, now.first, now.elapsed};
      errors.apply(stamp, stamps_);
      if (stamp.dropped) return false;
      Time stamped = after(now.time, static_cast<double>(stamp.offset));
      if (last_stamp_) stamped = (std::max)(stamped, next_stamp(*last_stamp_));
      require_finite(whose, "stamp", seconds_or_ticks(stamped));
      last_stamp_ = stamped;
      reading.true_time = now.time;
      reading.time = stamped;
    } else {
      reading.time = now.time;
    }
    return true;
  }

 private:
  struct Nothing {};

  [[nodiscard]] static bool have_difference(Time from, Time to) {
    if constexpr (std::floating_point<Time>) {
      return true;
    } else {
      typename Time::rep difference{};
      return !__builtin_sub_overflow(to.count(), from.count(), &difference);
    }
  }

  [[no_unique_address]] State stamps_;
  [[no_unique_address]] std::conditional_t<has_stamps, std::optional<Time>, Nothing> last_stamp_{};
  Time start_{};
  bool first_ = true;
};

}  // namespace splinertia::detail
