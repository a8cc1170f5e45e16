// SPDX-License-Identifier: MIT
/// Finds where a signal may have changed its mean: the first half of find_steps().
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace splinertia::allan::detail {

/// Block length of find_steps(): it averages this many samples before it looks for changes.
inline constexpr std::int64_t step_block = 16;

/// Differences of averages up to this are rounding errors of the running sums, where the largest sample is near 1.
inline constexpr double step_rounding = 1e-10;

/// A place at which the means on both sides differ more than they usually do in this signal. All in blocks.
struct StepCandidate {
  std::int64_t center;  ///< first block after the change
  std::int64_t width;   ///< width of the compared windows
  std::int64_t before;  ///< blocks used before the place
  std::int64_t after;   ///< blocks used after it
  double ratio;         ///< difference over the usual difference
  double excess;        ///< difference over the threshold, >= 1
};

/// The |z| that the largest of `trials` correlated normal numbers exceeds with this probability, where the unit of z
/// was estimated with this many degrees of freedom.
///
/// For z, the upcrossings of a Gaussian process with covariance 1 − c|t| over a length T: P = 2 T c z φ(z),
/// trials = T c (Pickands, "Upcrossing probabilities for stationary Gaussian processes", Trans. AMS 145 (1969)). For
/// Student's t from z, the inverse of z² = ν ln(1 + t²/ν) (Wallace, "Bounds on normal approximations to Student's and
/// the chi-square distributions", Ann. Math. Statist. 30 (1959)).
[[nodiscard]] inline double step_threshold(double trials, double probability, double degrees_of_freedom) {
  double z = 5;
  for (int i = 0; i < 8; ++i) {
    z = std::sqrt(2 * std::log((std::max)(2.0, 2 * trials * z / (probability * std::sqrt(2 * std::numbers::pi)))));
  }
  return std::sqrt(degrees_of_freedom * std::expm1(z * z / degrees_of_freedom));
}

/// The standard deviation that most of the magnitudes suggest: the larger of two estimates for a normal distribution,
/// from the median and from the 80 % quantile. A fifth of the values may be anything. Reorders the values. 0 for no
/// values, and for rounding errors.
[[nodiscard]] inline double usual_size(std::vector<double>& magnitudes) {
  if (magnitudes.empty()) return 0;
  const auto quantile = [&](double share) {
    const auto center =
        magnitudes.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(magnitudes.size()));
    std::nth_element(magnitudes.begin(), center, magnitudes.end());
    return *center;
  };
  const double high = quantile(0.8) / 1.2816, middle = quantile(0.5) / 0.6745;
  const double size = (std::max)(high, middle);
  return size > step_rounding ? size : 0;
}

/// Clips blocks that stick out of their surroundings: knocks of up to two blocks, which do not change the mean. A block
/// may lie anywhere between the medians of the five blocks before and after it, and up to six usual distances beyond.
inline void clip_knocks(std::vector<double>& means) {
  constexpr std::size_t side = 5;
  if (means.size() < 2 * side + 1) return;
  std::vector<double> medians(means.size() - side + 1);  // of the blocks i … i + 4
  for (std::size_t i = 0; i < medians.size(); ++i) {
    std::array<double, side> five;
    std::copy_n(means.begin() + static_cast<std::ptrdiff_t>(i), side, five.begin());
    std::nth_element(five.begin(), five.begin() + side / 2, five.end());
    medians[i] = five[side / 2];
  }
  std::vector<double> distances;
  const std::size_t stride = means.size() / 8192 + 1;
  for (std::size_t i = side; i + side < means.size(); i += stride) {
    distances.push_back(std::abs(means[i] - (medians[i - side] + medians[i + 1]) / 2));
  }
  const double room = 6 * usual_size(distances);
  for (std::size_t i = side; i + side < means.size(); ++i) {
    const auto [low, high] = std::minmax(medians[i - side], medians[i + 1]);
    means[i] = std::clamp(means[i], low - room, high + room);
  }
}

/// Compares the means of neighbouring windows of many widths, at every eighth of a width.
class StepScan {
 public:
  /// Scans the means of blocks. `false_alarms` is the probability of any candidate in Gaussian noise. `least` is the
  /// smallest height of interest, which counts where the signal is usually constant; 0 for none.
  StepScan(const std::vector<double>& means, double false_alarms, double least)
      : blocks_(static_cast<std::int64_t>(means.size())), least_(least) {
    sums_.reserve(means.size() + 1);
    sums_.push_back(0);
    for (const double mean : means) sums_.push_back(sums_.back() + mean);
    std::vector<std::int64_t> widths;
    for (double width = static_cast<double>(blocks_ / 32); width >= 2; width /= std::numbers::sqrt2) {
      widths.push_back(std::llround(width));
    }
    const double each = false_alarms / (2 * static_cast<double>(widths.size()));
    for (const std::int64_t width : widths) {
      scan_inside(width, each);
      if (width <= widest_at_the_ends) scan_ends(width, each);
    }
  }

  [[nodiscard]] const std::vector<StepCandidate>& candidates() const { return candidates_; }

 private:
  /// Near the ends, only over short times can a drift that bends be told from a step.
  static constexpr std::int64_t widest_at_the_ends = 1024 / step_block;
  /// The usual size is measured on about this many differences of a width.
  static constexpr std::int64_t sample_size = 8192;

  [[nodiscard]] double sum(std::int64_t begin, std::int64_t end) const {
    return sums_[static_cast<std::size_t>(end)] - sums_[static_cast<std::size_t>(begin)];
  }

  /// Mean after − mean before, less a third of the difference of the windows next to these: 2/3 of a step's height, 0
  /// for any parabola. A drift that bends little has no effect, so that warming up is no step.
  [[nodiscard]] double inside(std::int64_t i, std::int64_t w) const {
    const double inner = sum(i, i + w) - sum(i - w, i), outer = sum(i + w, i + 2 * w) - sum(i - 2 * w, i - w);
    return (inner - outer / 3) / static_cast<double>(w);
  }

  /// Mean of w after − mean of w before, less the drift on one side alone (direction 1: after): a step's height, 0 for
  /// a line. On the other side only a window of w is needed.
  [[nodiscard]] double at_end(std::int64_t i, std::int64_t w, std::int64_t direction) const {
    const double inner = sum(i, i + w) - sum(i - w, i);
    const double drift =
        direction > 0 ? sum(i + 2 * w, i + 4 * w) - sum(i, i + 2 * w) : sum(i - 2 * w, i) - sum(i - 4 * w, i - 2 * w);
    return (inner - drift / 4) / static_cast<double>(w);
  }

  template <typename Difference>
  [[nodiscard]] double usual(std::int64_t first, std::int64_t last, std::int64_t width, const Difference& difference) {
    magnitudes_.clear();
    const std::int64_t stride = (std::max)(std::max<std::int64_t>(1, width / 8), (last - first) / sample_size);
    for (std::int64_t i = first; i <= last; i += stride) magnitudes_.push_back(std::abs(difference(i)));
    return usual_size(magnitudes_);
  }

  /// Degrees of freedom of the usual size. With these, the largest difference in simulated white noise, random walks
  /// and sums of both exceeds the threshold less often than the requested probability.
  [[nodiscard]] double degrees_of_freedom(std::int64_t width) const {
    return 2 * static_cast<double>(blocks_) / static_cast<double>(width);
  }

  /// Whether the differences two widths away, on one or both sides, are like this one, which they are not for a step.
  [[nodiscard]] bool is_drift(std::int64_t i, std::int64_t w) const {
    const bool early = i - 4 * w < 0;
    const bool late = i + 4 * w > blocks_;
    const std::int64_t next = late ? -2 * w : 2 * w;
    const double here = inside(i, w);
    const double drift = early || late ? 2 * inside(i + next, w) - inside(i + 2 * next, w)
                                       : (inside(i - 2 * w, w) + inside(i + 2 * w, w)) / 2;
    return std::abs(here - drift) < std::abs(here) / 2;
  }

  void scan_inside(std::int64_t w, double probability) {
    const std::int64_t first = 2 * w, last = blocks_ - 2 * w;
    const auto difference = [&](std::int64_t i) { return inside(i, w); };
    const double spread = usual(first, last, w, difference);
    // c of step_threshold() is 1.75/w, for the weights −1, 3, −3, 1 of four windows of white noise.
    const double trials = 1.75 * static_cast<double>(blocks_) / static_cast<double>(w);
    const double threshold =
        (std::max)(step_threshold(trials, probability, degrees_of_freedom(w)) * spread, spread > 0 ? 0 : least_ / 2);
    if (!(threshold > 0)) return;
    for (std::int64_t i = first; i <= last; i += std::max<std::int64_t>(1, w / 8)) {
      const double size = std::abs(difference(i));
      if (size < threshold || is_drift(i, w)) continue;
      candidates_.push_back({i, w, 2 * w, 2 * w, size / spread, size / threshold});
    }
  }

  void scan_ends(std::int64_t w, double probability) {
    constexpr double trials = 4;  // as in scan_inside(), over the width of a window
    for (const std::int64_t direction : {1, -1}) {
      const auto difference = [&](std::int64_t i) { return at_end(i, w, direction); };
      const std::int64_t before = direction > 0 ? w : 4 * w, after = 5 * w - before;
      const double spread = usual(before, blocks_ - after, w, difference);
      const double threshold =
          (std::max)(step_threshold(trials, probability, degrees_of_freedom(w)) * spread, spread > 0 ? 0 : least_ / 2);
      if (!(threshold > 0)) continue;
      const std::int64_t begin = direction > 0 ? w : blocks_ - 2 * w + 1;
      for (std::int64_t i = begin; i < begin + w; i += std::max<std::int64_t>(1, w / 8)) {
        const double size = std::abs(difference(i));
        if (size >= threshold) candidates_.push_back({i, w, before, after, size / spread, size / threshold});
      }
    }
  }

  std::int64_t blocks_;
  double least_;
  std::vector<double> sums_;
  std::vector<double> magnitudes_;
  std::vector<StepCandidate> candidates_;
};

}  // namespace splinertia::allan::detail
