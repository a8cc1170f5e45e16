// SPDX-License-Identifier: MIT
/// The angular speed |ω| of a trajectory, and the regression of one such speed on another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <ranges>
#include <span>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia::detail {

/// The mean angular speed of a trajectory over a window. Times are in seconds from a common origin.
class AngularSpeed {
 public:
  static constexpr double unknown = -1;

  template <StampedPoses Poses>
  AngularSpeed(const Poses& poses, decltype(std::ranges::begin(poses)->time) origin) {
    for (const auto& [time, pose] : poses) {
      times_.push_back(to_seconds<double>(time_between(origin, time)));
      attitudes_.push_back(splinertia::rotation(pose).template cast<double>());
    }
  }

  [[nodiscard]] double begin() const { return times_.front(); }
  [[nodiscard]] double end() const { return times_.back(); }
  [[nodiscard]] double median_interval() const {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < times_.size(); ++i) intervals.push_back(times_[i] - times_[i - 1]);
    if (intervals.empty()) return 0;
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    return *middle;
  }

  /// The mean over the window about time t, rad/s; `unknown` if the window begins or ends outside the trajectory or
  /// between poses further apart than the window.
  [[nodiscard]] double at(double t, double window) const {
    const auto from = attitude(t - window / 2, window), to = attitude(t + window / 2, window);
    return from && to ? increment(*from, *to).norm() / window : unknown;
  }

  /// The speeds at start, start + window/8, …, each averaged over another window, so that noise varies as slowly as the
  /// mean speed.
  [[nodiscard]] std::vector<double> sampled(double start, double window, std::size_t count) const {
    constexpr std::size_t taps = 9;
    const double step = window / 8;
    std::vector<double> speeds(count + taps - 1);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      speeds[i] = at(start + (static_cast<double>(i) - 4) * step, window);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto over = std::span(speeds).subspan(i, taps);
      const bool known = std::find(over.begin(), over.end(), unknown) == over.end();
      speeds[i] = known ? std::accumulate(over.begin(), over.end(), 0.0) / double(taps) : unknown;
    }
    speeds.resize(count);
    return speeds;
  }

 private:
  [[nodiscard]] std::optional<Sophus::SO3d> attitude(double t, double longest_interval) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), t);
    if (after == times_.begin() || after == times_.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double interval = times_[i + 1] - times_[i];
    if (interval > longest_interval) return std::nullopt;
    const Eigen::Vector3d turn = increment(attitudes_[i], attitudes_[i + 1]);
    return attitudes_[i] * GroupTraits<Sophus::SO3d>::exp((t - times_[i]) / interval * turn);
  }

  std::vector<double> times_;
  std::vector<Sophus::SO3d> attitudes_;
};

/// The least-squares line y = intercept + slope x through the speeds that are known in both. Speeds that vary by less
/// than `resolution`, which is what poses in files resolve, count as constant: slope and correlation are 0.
struct SpeedRegression {
  static constexpr double resolution = 1e-7;  // rad/s
  std::size_t count = 0;
  double slope = 0, intercept = 0, correlation = 0;

  SpeedRegression(std::span<const double> x, std::span<const double> y) {
    double mean_x = 0, mean_y = 0, xx = 0, yy = 0, xy = 0;
    for_known(x, y, [&](std::size_t i) {
      ++count;
      mean_x += x[i];
      mean_y += y[i];
    });
    if (count == 0) return;
    mean_x /= static_cast<double>(count);
    mean_y /= static_cast<double>(count);
    for_known(x, y, [&](std::size_t i) {
      xx += (x[i] - mean_x) * (x[i] - mean_x);
      yy += (y[i] - mean_y) * (y[i] - mean_y);
      xy += (x[i] - mean_x) * (y[i] - mean_y);
    });
    const double least = static_cast<double>(count) * resolution * resolution;
    if (!(xx > least && yy > least)) return;
    slope = xy / xx;
    intercept = mean_y - slope * mean_x;
    correlation = xy / std::sqrt(xx * yy);
  }

  /// Calls use(i, squared residual) for each i for which both are known.
  void squares(std::span<const double> x, std::span<const double> y, const auto& use) const {
    for_known(x, y, [&](std::size_t i) {
      const double residual = y[i] - intercept - slope * x[i];
      use(i, residual * residual);
    });
  }

 private:
  static void for_known(std::span<const double> x, std::span<const double> y, const auto& use) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] != AngularSpeed::unknown && y[i] != AngularSpeed::unknown) use(i);
    }
  }
};

}  // namespace splinertia::detail
