// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/strapdown/gap_options.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia::detail {

/// Checks the stamps of a run of samples for order, overflow and gaps. follows() accepts most of them with two
/// comparisons. judged() looks at the others and returns a changed copy, so that nothing changes if it throws.
template <typename Scalar, TimePoint Time>
class SampleStamps {
 public:
  /// `intervals`: the number of intervals across which times are subtracted later, which must not overflow. `whose`: the
  /// function whose name begins all messages. Throws std::invalid_argument for a start that is not finite and unless the
  /// longest interval is > 0.
  SampleStamps(const char* whose, Time start, const GapOptions<Scalar>& gaps, int intervals)
      : last_(start), origin_(start), gaps_(gaps), whose_(whose), intervals_(intervals) {
    if (!is_finite(start)) {
      refuse<std::invalid_argument>(whose_, ": the initial time is ", seconds_or_ticks(start),
                                    ", expected a finite number");
    }
    if (gaps.longest && ((finite_math_only && !is_finite(*gaps.longest)) || !(*gaps.longest > Scalar(0)))) {
      refuse<std::invalid_argument>(whose_, ": the longest interval is ", *gaps.longest, " s, expected one > 0");
    }
  }

  /// Whether a stamp comes after the last one and needs no closer look.
  [[nodiscard]] bool follows(Time time) const {
    if (finite_math_only && !is_finite(time)) return false;
    return time > last_ && time_between(last_, time) <= unquestioned_;
  }

  /// A copy of this for the samples after the first one, which is at the start.
  [[nodiscard]] SampleStamps begun() const {
    SampleStamps result = *this;
    result.unquestioned_ = unquestioned();
    return result;
  }

  /// A copy of this that has accepted sample `index` at `time`, and counted it if it ends a gap; append() comes next.
  /// `intervals` is the number of intervals before this one. Throws std::invalid_argument for a stamp that is not after
  /// the last one or too far from it for the type of time, and for a gap that is refused.
  [[nodiscard]] SampleStamps judged(Time time, std::size_t index, std::size_t intervals) const {
    if (!is_finite(time) || !(time > last_)) {
      refuse<std::invalid_argument>(whose_, ": sample ", index, " is at ", seconds_or_ticks(time),
                                    ", expected a time after ", seconds_or_ticks(last_));
    }
    const Time difference = time_between(last_, time);
    if (difference > largest()) {
      refuse<std::invalid_argument>(whose_, ": sample ", index, " is at ", seconds_or_ticks(time),
                                    ", the one before at ", seconds_or_ticks(last_),
                                    ": their difference does not fit the type of time");
    }
    SampleStamps result = begun();
    if (gaps_.longest) {
      result.judge_by_longest(time, to_seconds<Scalar>(difference), index);
    } else {
      result.judge_by_mean(time, to_seconds<Scalar>(difference), index, intervals - bridged_);
    }
    return result;
  }

  void append(Time time) { last_ = time; }

  [[nodiscard]] Time last() const { return last_; }
  [[nodiscard]] const char* whose() const { return whose_; }
  [[nodiscard]] std::size_t gaps() const { return bridged_; }
  /// The time from the last stamp to a later one, s.
  [[nodiscard]] Scalar since_last(Time time) const { return to_seconds<Scalar>(time_between(last_, time)); }

 private:
  void judge_by_longest(Time time, const Scalar& interval, std::size_t index) {
    if (!(interval > *gaps_.longest)) return;
    if (gaps_.policy == GapPolicy::refuse) {
      refuse<std::invalid_argument>(whose_, ": sample ", index, " at ", seconds_or_ticks(time), " comes ", interval,
                                    " s after the one before, expected at most ", *gaps_.longest, " s");
    }
    ++bridged_;
  }

  void judge_by_mean(Time time, const Scalar& interval, std::size_t index, std::size_t intervals) {
    const Scalar least = Scalar(1) / Scalar(10), many(10);
    if (intervals == 0) {  // nothing to compare with: the next sample has to be judged, too
      if (interval > least) unquestioned_ = Time(0);
      return;
    }
    const Scalar mean = to_seconds<Scalar>(time_between(origin_, last_)) / Scalar(static_cast<double>(intervals));
    if (intervals == 1 && mean > least && mean > many * interval) {  // then the first one was the gap
      if (gaps_.policy == GapPolicy::refuse) {
        refuse<std::invalid_argument>(whose_, ": sample ", index - 1, " at ", seconds_or_ticks(last_), " comes ", mean,
                                      " s after the one before, sample ", index, " only ", interval, " s after it",
                                      way_out);
      }
      ++bridged_;
      origin_ = last_;
      return;
    }
    const Scalar longest = mean * many > least ? Scalar(mean * many) : least;
    Scalar rounding(0);  // of the stamps
    if constexpr (std::floating_point<Time>) {
      rounding = Scalar(2) * static_cast<Scalar>(std::numeric_limits<Time>::epsilon() * std::abs(time));
    }
    if (!(interval > longest + rounding)) return;
    if (gaps_.policy == GapPolicy::refuse) {
      refuse<std::invalid_argument>(whose_, ": sample ", index, " at ", seconds_or_ticks(time), " comes ", interval,
                                    " s after the one before, expected at most ", longest, " s", way_out);
    }
    ++bridged_;
    origin_ += time - last_;
  }

  static constexpr const char* way_out = " (GapOptions sets another limit, or bridges gaps)";

  [[nodiscard]] Time largest() const {
    if constexpr (is_integer_duration<Time>) {
      return Time(((Time::max)().count() - 1) / intervals_);  // −1: time_between() saturates at max()
    } else {
      return (std::numeric_limits<Time>::max)() / static_cast<Time>(intervals_);
    }
  }

  // The longest interval that needs no closer look.
  [[nodiscard]] Time unquestioned() const {
    const Time most = largest();
    if (!gaps_.longest) {
      if constexpr (is_integer_duration<Time>) {
        return (std::min)(most, std::chrono::duration_cast<Time>(std::chrono::milliseconds(100)));
      } else {
        return (std::min)(most, Time(1) / Time(10));
      }
    }
    if constexpr (std::floating_point<Scalar>) {
      if constexpr (is_integer_duration<Time>) {
        const Scalar ticks = *gaps_.longest / to_seconds<Scalar>(Time(1));
        return ticks < static_cast<Scalar>(most.count()) ? Time(static_cast<typename Time::rep>(ticks)) : most;
      } else {
        return *gaps_.longest < static_cast<Scalar>(most) ? static_cast<Time>(*gaps_.longest) : most;
      }
    } else {
      return Time(0);  // the closer look compares them as Scalars
    }
  }

  Time last_, origin_;  // the origin is the start, shifted by the lengths of the gaps
  Time unquestioned_{};
  GapOptions<Scalar> gaps_;
  std::size_t bridged_ = 0;
  const char* whose_;
  int intervals_;
};

}  // namespace splinertia::detail
