// SPDX-License-Identifier: MIT
/// Finds when and by how much a signal changed its mean: the second half of find_steps().
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace splinertia::allan::detail {

/// A change of the mean within a window of samples.
struct StepFit {
  std::int64_t begin;     ///< first sample that is no longer at the level before
  std::int64_t duration;  ///< samples on the way from one level to the other, 0 for a sudden step
  double height;          ///< level after − level before, with the drift common to both sides removed
  double difference;      ///< level after − level before, with the drift left in
  double scatter;         ///< error of the height from the scatter of averages on both sides, with slow noise
  double standard_error;  ///< of the height: scatter, and the error of the drift
  double samples;         ///< number of samples in the average of the shorter level
  bool is_knock;          ///< the level is left again after `duration`, at most longest_knock: no step, no height
};

/// A level that is left again within this many samples, 1 s at 200 Hz, is a knock and no step.
inline constexpr std::int64_t longest_knock = 200;

/// Fits one change to the samples of a window. The change is a ramp between two levels, of any duration from 0 on.
class StepFitter {
 public:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Subtracts a line of this slope [per sample] from the window. Keeps a reference to the window.
  explicit StepFitter(std::reference_wrapper<const std::vector<double>> window, double slope = 0)
      : window_(window), size_(static_cast<std::int64_t>(window_.size())) {
    double mean = 0;
    for (const double y : window_) mean += y;
    mean /= static_cast<double>(window_.size());
    sums_.reserve(window_.size() + 1);
    double_sums_.reserve(window_.size() + 2);
    sums_.push_back(0);
    double_sums_.push_back(0);
    double line = slope * static_cast<double>(size_ - 1) / 2 - mean;
    for (const double y : window_) {
      double_sums_.push_back(double_sums_.back() + sums_.back());
      sums_.push_back(sums_.back() + (y + line));
      line -= slope;
    }
    double_sums_.push_back(double_sums_.back() + sums_.back());
  }

  /// The change that begins and ends within `reach` samples of `place`, with levels from up to 2·`reach` samples on
  /// either side. Its error is infinite if a level has fewer than 16 samples. Nothing if the window has fewer than 32
  /// samples.
  [[nodiscard]] std::optional<StepFit> fit(std::int64_t center, std::int64_t reach) const {
    const Range range{(std::max)(least_side, center - reach), (std::min)(size_ - least_side, center + reach)};
    if (range.size() < 0) return std::nullopt;
    const double slope = slope_outside({center - reach, center + reach});
    const Located located = slope == 0 ? locate(range, reach) : StepFitter(window_, slope).locate(range, reach);
    if (located.is_knock)
      return StepFit{located.change.begin, located.change.duration, 0, 0, infinite, infinite, 0, true};
    const Levels of_change = levels(located.change, located.reach);
    return StepFit{located.change.begin, located.change.duration, of_change.height,  of_change.difference,
                   of_change.scatter,    of_change.error,         of_change.samples, false};
  }

 private:
  struct Range {
    std::int64_t begin, end;
    [[nodiscard]] std::int64_t size() const { return end - begin; }
  };
  struct Change {
    std::int64_t begin, duration;
    double gain;  ///< by how much it lowers the sum of squares
  };
  struct Located {
    Change change;
    std::int64_t reach;  ///< range within which it is the only change
    bool is_knock;       ///< the level is left again at once
  };
  static constexpr std::int64_t least_side = 16;
  static constexpr double clearly_better = 0.5;
  static constexpr double clearly = 25;  ///< gain over variance: five standard deviations squared

  /// The change within a range that lowers the sum of squares the most. It is sudden unless some duration is better by
  /// five standard deviations.
  [[nodiscard]] Located locate(Range range, std::int64_t reach) const {
    const Change sudden = best_of_duration(range, 0);
    Change best = sudden;
    for (std::int64_t duration = 1; duration <= range.size(); duration += (duration + 3) / 4) {
      const Change change = best_of_duration(range, duration);
      if (change.gain > best.gain) best = change;
    }
    best = refine(range, best);
    const double least = clearly * levels(best, reach).variance;
    if (best.gain - sudden.gain < least) best = sudden;
    // A second change besides the sudden one.
    const Range left{0, sudden.begin}, right{sudden.begin, size_};
    const Change earlier = best_split(left), later = best_split(right);
    const bool is_earlier = earlier.gain > later.gain;
    const Change& second = is_earlier ? earlier : later;
    const std::int64_t first = (std::min)(sudden.begin, second.begin), distance = std::abs(sudden.begin - second.begin);
    const bool returns = rises({0, size_}, sudden.begin) != rises(is_earlier ? left : right, second.begin);
    if (returns && distance <= longest_knock && second.gain > sudden.gain / 2)
      return {{first, distance, 0}, reach, true};
    // Two sudden steps may be better than a slow one: the window is then too wide for the higher of them.
    if (best.duration == 0 || sudden.gain + second.gain <= best.gain + least) return {best, reach, false};
    return {sudden, (std::min)(reach, distance / 2), false};
  }

  /// Whether the mean of the samples from a place on is above that of those before it.
  [[nodiscard]] bool rises(Range samples, std::int64_t center) const {
    const double before = at(sums_, center) - at(sums_, samples.begin),
                 after = at(sums_, samples.end) - at(sums_, center);
    return after * static_cast<double>(center - samples.begin) > before * static_cast<double>(samples.end - center);
  }

  /// The slope of the samples outside a range, 0 if it is less than three standard errors.
  [[nodiscard]] double slope_outside(Range range) const {
    double xx = 0, xy = 0, yy = 0;
    int count = 0;
    for (const Range& outside : {Range{0, range.begin}, Range{range.end, size_}}) {
      if (outside.size() < least_side) continue;
      const Side side(*this, outside);
      xx += side.xx;
      xy += side.xy;
      yy += side.yy;
      count += pieces - 1;
    }
    return count > 0 && xy * xy > 9 * xx * (yy - xy * xy / xx) / (count - 1) ? xy / xx : 0;
  }

  /// The sum of squares that the ramp from sample `begin` on explains. The ramp is the mean of the sudden steps at
  /// begin, begin + 1, …, begin + duration.
  [[nodiscard]] double gain(std::int64_t begin, std::int64_t duration) const {
    const auto steps = static_cast<double>(duration + 1), after = static_cast<double>(size_ - begin - duration);
    const auto d = static_cast<double>(duration), n = static_cast<double>(size_);
    const double product = -(at(double_sums_, begin + duration + 1) - at(double_sums_, begin)) / steps;
    const double sum = after + d / 2, squares = after + d * (2 * d + 1) / (6 * steps);
    const double norm = squares - sum * sum / n;
    return norm > 0 ? product * product / norm : 0;
  }

  [[nodiscard]] Change best_of_duration(Range range, std::int64_t duration) const {
    Change best{range.begin, duration, -1};
    const std::int64_t stride = std::max<std::int64_t>(1, duration / 8);
    for (std::int64_t begin = range.begin; begin + duration <= range.end; begin += stride) {
      const double of_this = gain(begin, duration);
      if (of_this > best.gain) best = {begin, duration, of_this};
    }
    return best;
  }

  /// Searches from a change of the grid for the best one near it.
  [[nodiscard]] Change refine(Range range, Change best) const {
    for (std::int64_t stride = best.duration / 8; stride >= 1;) {
      const Change last = best;
      for (const auto& [shift, growth] : {std::pair<int, int>{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, 1}, {1, -1}}) {
        const std::int64_t begin = last.begin + shift * stride, duration = last.duration + growth * stride;
        if (duration < 0 || begin < range.begin || begin + duration > range.end) continue;
        const double of_this = gain(begin, duration);
        if (of_this > best.gain) best = {begin, duration, of_this};
      }
      if (best.gain == last.gain) stride /= 2;
    }
    return best;
  }

  /// The best sudden step within these samples alone.
  [[nodiscard]] Change best_split(Range samples) const {
    Change best{samples.begin, 0, 0};
    const double total = at(sums_, samples.end) - at(sums_, samples.begin), count = static_cast<double>(samples.size());
    for (std::int64_t i = samples.begin + least_side; i <= samples.end - least_side; ++i) {
      const auto before = static_cast<double>(i - samples.begin);
      const double product = at(sums_, i) - at(sums_, samples.begin) - total * before / count;
      const double of_this = product * product * count / (before * (count - before));
      if (of_this > best.gain) best = {i, 0, of_this};
    }
    return best;
  }

  /// The levels on both sides and the height that follows from them.
  struct Levels {
    double height = 0;           ///< drift removed
    double difference = 0;       ///< drift left in
    double scatter = infinite;   ///< standard error of the height
    double error = infinite;     ///< scatter and the error of the drift, root of the sum of squares
    double variance = infinite;  ///< of a sample, from the scatter of averages
    double samples = 0;          ///< of the shorter side
  };

  /// Levels from windows of two, one and half times the reach: the widest, unless another one has a clearly smaller
  /// error. A wide window averages more, a narrow one leaves less to drifts and random walks.
  [[nodiscard]] Levels levels(const Change& change, std::int64_t reach) const {
    Levels best;
    for (const std::int64_t width : {2 * reach, reach, reach / 2}) {
      const std::int64_t room = change.duration / 4;  // in case the change begins or ends smoothly
      const std::int64_t before = change.begin - room, after = change.begin + change.duration + room;
      const Range left{std::max<std::int64_t>(0, before - width), before},
          right{after, (std::min)(size_, after + width)};
      if (left.size() < least_side || right.size() < least_side) continue;
      const Levels some = of_sides(Side(*this, left), Side(*this, right));
      if (some.error < clearly_better * best.error) best = some;
    }
    return best;
  }

  static constexpr int pieces = 8;  ///< pieces of a side; their averages are compared

  /// Averages of the pieces of one side: their mean place and value, and the products about these, times samples.
  struct Side {
    Side(const StepFitter& fitter, Range range) {
      const std::int64_t length = (range.end - range.begin) / pieces;
      const std::int64_t begin = range.end - length * pieces;
      samples = static_cast<double>(length * pieces);
      x = static_cast<double>(begin) + samples / 2;
      y = (at(fitter.sums_, range.end) - at(fitter.sums_, begin)) / samples;
      for (int i = 0; i < pieces; ++i) {
        const std::int64_t first = begin + i * length;
        const auto count = static_cast<double>(length);
        const double dx = static_cast<double>(first) + count / 2 - x;
        const double dy = (at(fitter.sums_, first + length) - at(fitter.sums_, first)) / count - y;
        xx += count * dx * dx;
        xy += count * dx * dy;
        yy += count * dy * dy;
      }
    }
    double samples, x, y, xx = 0, xy = 0, yy = 0;
  };

  /// The slope common to both sides is subtracted as far as it is certain, by the factor 1 − 3/t² of James and Stein,
  /// with t the slope over its standard error. The error includes what is left of it.
  [[nodiscard]] static Levels of_sides(const Side& left, const Side& right) {
    const double spread = left.xx + right.xx, slope = (left.xy + right.xy) / spread, distance = right.x - left.x;
    const double products = left.yy + right.yy;
    const double flat = products / (2 * pieces - 2), sloped = (products - slope * slope * spread) / (2 * pieces - 3);
    const double variance = (std::min)(flat, sloped), shares = 1 / left.samples + 1 / right.samples;
    const double uncertain = 3 * sloped / spread, share = (std::max)(0.0, 1 - uncertain / (slope * slope));
    const double drift = (std::min)(sloped / spread, slope * slope / 3) * distance * distance;
    return {right.y - left.y - share * slope * distance, right.y - left.y, std::sqrt(variance * shares),
            std::sqrt(variance * shares + drift),        variance,         (std::min)(left.samples, right.samples)};
  }

  [[nodiscard]] static double at(const std::vector<double>& values, std::int64_t i) {
    return values[static_cast<std::size_t>(i)];
  }

  const std::vector<double>& window_;
  std::int64_t size_;
  std::vector<double> sums_;         ///< of the samples about their mean, from 0
  std::vector<double> double_sums_;  ///< Σ of the first i sums
};

}  // namespace splinertia::allan::detail
