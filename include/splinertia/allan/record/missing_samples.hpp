// SPDX-License-Identifier: MIT
/// Finds the samples that a log lacks, from stamps that jitter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <splinertia/detail/require.hpp>
#include <vector>

namespace splinertia::allan {

/// A place where samples are missing.
struct MissingSamples {
  std::int64_t interval;  ///< index of the interval in which they are missing, from 0
  std::int64_t count;     ///< how many, at least 1
};

}  // namespace splinertia::allan

namespace splinertia::detail {

/// Follows the most likely sampling grid along the stamps. With r_i the time of sample i less i nominal intervals, in
/// nominal intervals, r_i = φ + m_i + jitter: m_i is the number of samples missing so far and φ the phase of the grid.
///
/// Each hypothesis about m_i keeps its own φ, by a loop of second order, so that a nominal interval that is slightly
/// off and clocks that drift do no harm. Its cost is the sum of the squared jitter in units of twice its variance, each
/// at most that of a whole interval, plus a price for every place with missing samples. A single late stamp is cheaper
/// as jitter, a lasting delay is cheaper as missing samples. The best few hypotheses survive, one for each m_i
/// (Viterbi's algorithm with per-survivor phases: Raheli, Polydoros and Tzou 1995).
class GridSearch {
 public:
  /// `deviation`: standard deviation of the jitter, in intervals.
  explicit GridSearch(double deviation) : weight_(1 / (2 * deviation * deviation)) {}

  /// Adds the next sample. `length` is its interval to the one before, in nominal intervals.
  void add(std::int64_t interval, double length) {
    position_ += (std::min)(length, longest) - 1;
    next_.clear();
    for (const Hypothesis& h : hypotheses_) {
      const double ahead = position_ - h.phase - static_cast<double>(h.missing);
      extend(h, ahead, 0, interval);
      if (ahead < earliest) continue;
      const auto least = static_cast<std::int64_t>(std::floor(ahead));
      if (least > 0) extend(h, ahead, least, interval);
      extend(h, ahead, least + 1, interval);
    }
    std::sort(next_.begin(), next_.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
    // The best hypothesis can still add missing samples later, for one price. One that has more of them and costs ten
    // prices more is hopeless.
    const Hypothesis leader = next_.front();
    std::erase_if(next_,
                  [&](const Hypothesis& h) { return h.missing > leader.missing && h.cost > leader.cost + 10 * price; });
    // The one with the fewest missing stays: late stamps may catch up, and no other way leads back to it.
    const auto fewest = std::min_element(next_.begin(), next_.end(),
                                         [](const auto& a, const auto& b) { return a.missing < b.missing; });
    if (fewest - next_.begin() >= survivors) next_[survivors - 1] = *fewest;
    if (next_.size() > survivors) next_.resize(survivors);
    hypotheses_.swap(next_);
    // Only differences of costs matter. The best is subtracted to keep them bounded.
    const double best = hypotheses_.front().cost;
    for (Hypothesis& h : hypotheses_) h.cost -= best;
    while (hypotheses_.back().cost > hopeless) hypotheses_.pop_back();
    ++samples_;
  }

  /// The missing samples of the best hypothesis, in order.
  [[nodiscard]] std::vector<allan::MissingSamples> found() const {
    std::vector<allan::MissingSamples> result;
    for (std::size_t link = hypotheses_.front().last; link != none; link = links_[link].before) {
      result.push_back(links_[link].place);
    }
    std::reverse(result.begin(), result.end());
    return result;
  }

 private:
  static constexpr std::ptrdiff_t survivors = 6;
  static constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
  static constexpr double longest = 1e9;   // limit of an interval, so that sums of missing samples fit in 64 bits
  static constexpr double hopeless = 1e4;  // cost above the best at which a hypothesis is dropped
  static constexpr double price = 15;      // of a place with missing samples: by chance once in e^15 samples
  static constexpr double earliest = 0.3;  // a stamp after a missing sample is at least this late on the grid
  static constexpr double trusted = 0.6;   // jitter beyond it does not move the phase
  static constexpr std::int64_t first_samples = 16;  // these always move the phase: the first may be off by its jitter
  static constexpr double slowest = 1.0 / 32;        // share of its jitter by which a stamp moves the phase, at last

  struct Hypothesis {
    std::int64_t missing = 0;
    double phase = 0, drift = 0;  // of the grid, and its change per sample
    double cost = 0;
    std::size_t last = none;  // in links_
  };
  struct Link {
    allan::MissingSamples place;
    std::size_t before;
  };

  /// Adds the hypothesis that `more` samples are missing here, unless one with the same total is cheaper.
  void extend(const Hypothesis& from, double ahead, std::int64_t more, std::int64_t interval) {
    const double jitter = ahead - static_cast<double>(more);
    Hypothesis to = from;
    to.missing += more;
    to.cost += weight_ * (std::min)(1.0, jitter * jitter) + (more > 0 ? price : 0);
    const auto same = std::find_if(next_.begin(), next_.end(), [&](const auto& h) { return h.missing == to.missing; });
    if (same != next_.end() && same->cost <= to.cost) return;
    if (more > 0) {
      links_.push_back({{interval, more}, from.last});
      to.last = links_.size() - 1;
    }
    to.phase += to.drift;
    if (std::abs(jitter) < trusted || samples_ < first_samples) {
      const double gain = (std::max)(slowest, 1.0 / static_cast<double>(samples_ + 2));
      to.phase += gain * jitter;
      if (gain == slowest) to.drift += slowest * slowest / 4 * jitter;  // critically damped
    }
    if (same != next_.end()) {
      *same = to;
    } else {
      next_.push_back(to);
    }
  }

  double weight_;
  double position_ = 0;
  std::int64_t samples_ = 0;
  std::vector<Hypothesis> hypotheses_{Hypothesis{}}, next_;
  std::vector<Link> links_;
};

}  // namespace splinertia::detail

namespace splinertia::allan {

/// Finds the samples that are missing between stamps. `intervals` are those from one stamp to the next and `nominal` is
/// the sampling interval to within some percent, both in s. The search uses cumulated time, so that a late stamp before
/// a short interval is no gap: with jitter of up to 0.3 intervals (rms, of the stamps) nothing is missing in a regular
/// log, and every missing sample is found. Its place is then off by some samples. A sample missing among the last few
/// cannot be told from a late stamp. Throws std::invalid_argument unless `nominal` is positive and finite.
[[nodiscard]] inline std::vector<MissingSamples> find_missing_samples(const std::vector<double>& intervals,
                                                                      double nominal) {
  splinertia::detail::require_positive("find_missing_samples", "nominal", nominal);
  if (intervals.empty()) return {};
  std::vector<double> deviations;
  deviations.reserve(intervals.size());
  for (const double interval : intervals) deviations.push_back(std::abs(interval / nominal - 1));
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  // An interval has the jitter of two stamps. The median of its magnitude is 0.6745 standard deviations.
  const double jitter = *middle / 0.6745 / std::sqrt(2.0);
  splinertia::detail::GridSearch search(std::clamp(jitter, 0.1, 0.4));
  for (std::size_t i = 0; i < intervals.size(); ++i) search.add(static_cast<std::int64_t>(i), intervals[i] / nominal);
  return search.found();
}

}  // namespace splinertia::allan
