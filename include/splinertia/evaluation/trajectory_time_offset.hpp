// SPDX-License-Identifier: MIT
/// The clock offset between two trajectories of one body, estimated from its angular speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <ranges>
#include <span>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/message.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/evaluation/detail/angular_speed.hpp>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace splinertia {

struct TimeOffsetOptions {
  double range = 1;   ///< s: offsets from −range to range are tried
  double window = 0;  ///< s: angular speeds are averaged over this; 0: chosen, at least 0.1 s and 4 pose intervals
};

struct TimeOffset {
  double offset;              ///< s: to be added to the estimate's stamps
  double standard_deviation;  ///< s: estimated from the residuals of the angular speeds
  double correlation;         ///< of the angular speeds at this offset
  double window;              ///< s: the one that was used
};

namespace detail {

/// Twice the decrease of the log-likelihood of `n` independent samples from one correlation to another.
[[nodiscard]] inline double likelihood_drop(double n, double from, double to) {
  const auto left = [](double c) { return (std::max)(1e-12, 1 - (std::max)(c, 0.0) * (std::max)(c, 0.0)); };
  return n * std::log(left(to) / left(from));
}

/// For messages.
[[nodiscard]] inline double rounded(double x) { return std::round(1e4 * x) / 1e4; }

/// Finds the offset with the largest correlation between the angular speeds of both trajectories on one grid.
class OffsetSearch {
 public:
  /// An offset, or why there is none.
  struct Result {
    TimeOffset found;
    std::string refusal;
  };

  OffsetSearch(const AngularSpeed& reference, const AngularSpeed& estimate, double range, double window)
      : estimate_(estimate), window_(window), step_(window / 8), lags_(static_cast<std::ptrdiff_t>(range / step_) + 1) {
    start_ = (std::max)(reference.begin(), estimate.begin() - range);
    const double length = (std::min)(reference.end(), estimate.end() + range) - start_;
    const std::size_t count = length > 0 ? static_cast<std::size_t>(length / step_) + 1 : 0;
    reference_speeds_ = reference.sampled(start_, window, count);
    estimate_speeds_ = estimate.sampled(start_ - static_cast<double>(lags_) * step_, window,
                                        count + 2 * static_cast<std::size_t>(lags_));
  }

  [[nodiscard]] Result run() const {
    std::vector<double> correlation;
    std::vector<std::size_t> counts;
    for (std::ptrdiff_t lag = -lags_; lag <= lags_; ++lag) {
      const auto shifted = std::span(estimate_speeds_).subspan(static_cast<std::size_t>(lags_ - lag), size());
      const SpeedRegression regression(shifted, reference_speeds_);
      correlation.push_back(regression.correlation);
      counts.push_back(regression.count);
    }
    const std::size_t most = *std::max_element(counts.begin(), counts.end());
    if (most < 20 * 8) {
      return {{},
              message("the angular speeds of both overlap for ", rounded(static_cast<double>(most) * step_),
                      " s, expected at least ", rounded(20 * window_), " s")};
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (2 * counts[i] < most) correlation[i] = 0;
    }
    const auto best = std::max_element(correlation.begin(), correlation.end()) - correlation.begin();
    if (const std::string fault = objection(correlation, best, independent_samples(most)); !fault.empty()) {
      return {{}, fault};
    }
    return refined(offset(best));
  }

 private:
  struct Squares {
    std::vector<double> blocks;
    double correlation;
  };

  [[nodiscard]] std::size_t size() const { return reference_speeds_.size(); }
  [[nodiscard]] double offset(std::ptrdiff_t index) const { return static_cast<double>(index - lags_) * step_; }

  /// The squared residuals of a regression of the reference's speeds on the estimate's, summed over blocks of time.
  [[nodiscard]] Squares squares(double offset, std::size_t blocks) const {
    const auto shifted = estimate_.sampled(start_ - offset, window_, size());
    const SpeedRegression regression(shifted, reference_speeds_);
    Squares sums{std::vector<double>(blocks, 0.0), regression.correlation};
    regression.squares(shifted, reference_speeds_,
                       [&](std::size_t i, double square) { sums.blocks[i * blocks / size()] += square; });
    return sums;
  }

  /// The least-squares offset near a given one. At the minimum the slopes of the blocks add up to zero. What is left of
  /// each slope is due to noise, and gives the standard deviation. If that is not far below the window, noise may have
  /// caused the minimum itself. Derivatives are differences over h, which is chosen large enough for the noise and
  /// small enough for a cost that is not a parabola.
  [[nodiscard]] Result refined(double offset) const {
    double h = window_ / 4;
    const std::size_t blocks = std::clamp(size() / 80, std::size_t{5}, std::size_t{50});
    for (int iteration = 0;; ++iteration) {
      const auto before = squares(offset - h, blocks), here = squares(offset, blocks),
                 next = squares(offset + h, blocks);
      double slope = 0, curvature = 0, variance = 0;
      for (std::size_t i = 0; i < blocks; ++i) {
        const double block_slope = (next.blocks[i] - before.blocks[i]) / (2 * h);
        slope += block_slope;
        variance += block_slope * block_slope;
        curvature += (next.blocks[i] - 2 * here.blocks[i] + before.blocks[i]) / (h * h);
      }
      if (!(curvature > 0)) return {{}, "the correlation of the angular speeds has no sharp maximum"};
      const double newton = std::clamp(-slope / curvature, -h, h), count = static_cast<double>(blocks);
      const double deviation = std::sqrt(variance * count / (count - 1)) / curvature;
      const double enough = std::clamp(20 * deviation, window_ / 1000, window_ / 4);
      offset += newton;
      if (iteration < 20 && (std::abs(newton) > 1e-6 * window_ || enough < h / 2)) {
        if (std::abs(newton) < h / 10) h = (std::min)(h, enough);
        continue;
      }
      if (!(deviation <= window_ / 40)) {
        return {{},
                message("noise hides it: the standard deviation is ", rounded(deviation),
                        " s, expected at most 1/40 of the window of ", rounded(window_), " s")};
      }
      return {{offset, deviation, here.correlation, window_}, ""};
    }
  }

  /// The effective number of samples: neighbouring speeds are correlated, and so many independent ones would give
  /// correlations of the same variance. Bartlett, "Some aspects of the time-correlation problem in regard to tests of
  /// significance", J. R. Stat. Soc. 98 (1935).
  [[nodiscard]] double independent_samples(std::size_t count) const {
    const auto autocorrelation = [](std::span<const double> speeds, std::size_t lag) {
      return SpeedRegression(speeds.first(speeds.size() - lag), speeds.last(speeds.size() - lag)).correlation;
    };
    double sum = 1;
    for (std::size_t lag = 1; lag < (std::min)(static_cast<std::size_t>(lags_), size() / 4); ++lag) {
      sum += 2 * autocorrelation(reference_speeds_, lag) * autocorrelation(estimate_speeds_, lag);
    }
    return static_cast<double>(count) / (std::max)(1.0, sum);
  }

  /// Why the maximum of the correlation does not determine a single offset; "" if it does.
  [[nodiscard]] std::string objection(const std::vector<double>& correlation, std::ptrdiff_t best,
                                      double independent) const {
    const double most = correlation[static_cast<std::size_t>(best)];
    if (!(likelihood_drop(independent, most, 0) >= 25)) {
      return message("the correlation of the angular speeds is ", rounded(most), " at most, which may be chance");
    }
    if (best == 0 || best == 2 * lags_) {
      return message("the angular speeds agree best at the end of the range, ", rounded(offset(best)), " s");
    }
    for (const std::ptrdiff_t direction : {-1, 1}) {
      double valley = most;
      for (std::ptrdiff_t i = best; i >= 0 && i <= 2 * lags_; i += direction) {
        const double other = correlation[static_cast<std::size_t>(i)];
        valley = (std::min)(valley, other);
        if (likelihood_drop(independent, other, valley) >= 4 && likelihood_drop(independent, most, other) < 10) {
          return message("the motion repeats itself: offsets of ", rounded(offset(best)), " s and ", rounded(offset(i)),
                         " s fit about equally well");
        }
      }
    }
    return "";
  }

  const AngularSpeed& estimate_;
  double window_, step_, start_;
  std::ptrdiff_t lags_;
  std::vector<double> reference_speeds_, estimate_speeds_;
};

}  // namespace detail

/// The clock offset, which is to be added to the estimate's stamps. It maximises the correlation of the angular speeds
/// |ω|, which are independent of the worlds, of the body's axes and of scale. The search is first on a grid of 1/8
/// window over the range, then by least squares. The standard deviation is a sandwich estimate over 5 to 50 blocks of
/// time, so that noise may be correlated over a window. If the offset is not determined and no window is given, windows
/// up to 8 times as long are tried.
///
/// Throws std::invalid_argument for what check_poses() refuses, for bad options, and if the motion does not determine
/// the offset: if both speeds are known for less than 20 windows at once, if they are not correlated beyond chance (a
/// body at rest or at a constant rate, two bodies), if they agree best at an end of the range, if another offset is
/// about as likely, and if the standard deviation is above 1/40 of the window.
template <detail::StampedPoses Reference, detail::StampedPoses Estimate>
  requires std::same_as<std::ranges::range_value_t<Reference>, std::ranges::range_value_t<Estimate>>
[[nodiscard]] TimeOffset estimate_time_offset(const Reference& reference, const Estimate& estimate,
                                              const TimeOffsetOptions& options = {}) {
  detail::check_poses(reference, "reference");
  detail::check_poses(estimate, "estimate");
  const auto origin = std::ranges::begin(reference)->time;
  const detail::AngularSpeed of_reference(reference, origin), of_estimate(estimate, origin);
  double window = options.window;
  if (window == 0) window = (std::max)({0.1, 4 * of_reference.median_interval(), 4 * of_estimate.median_interval()});
  if (!(window > 0) || !detail::is_finite(window)) {
    detail::refuse<std::invalid_argument>("estimate_time_offset: window ", window, " s, expected > 0 s");
  }
  if (!(options.range > 0 && options.range <= 1e5 * window)) {
    detail::refuse<std::invalid_argument>("estimate_time_offset: range ", options.range,
                                          " s, expected > 0 s and at most ", 1e5 * window, " s");
  }
  std::string refusal;
  for (int tries = options.window == 0 ? 4 : 1; tries > 0; --tries, window *= 2) {
    const auto result = detail::OffsetSearch(of_reference, of_estimate, options.range, window).run();
    if (result.refusal.empty()) return result.found;
    if (refusal.empty()) refusal = result.refusal;
  }
  detail::refuse<std::invalid_argument>("estimate_time_offset: the motion does not show the offset: ", refusal);
}

}  // namespace splinertia
