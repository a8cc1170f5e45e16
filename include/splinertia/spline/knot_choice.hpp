// SPDX-License-Identifier: MIT
/// Knots from the poses themselves: from their rate, their noise and their motion.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <splinertia/group/turn_angle.hpp>
#include <splinertia/spline/pose_statistics.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia {

/// How far neighbouring control points may turn against each other, rad: beyond π they could turn the other way.
inline constexpr double largest_turn = 2 * std::numbers::pi / 3;

/// The mean squares of what poses an interval h apart show.
template <LieGroup G>
struct MotionAtScale {
  Tangent<G> residual_square;      ///< of a pose from the cubic through those at ±h and ±2h
  Tangent<G> acceleration_square;  ///< of the parabola through those at 0 and ±h
};

/// Over all poses with neighbours at these distances to within a quarter of h, of at most a few thousand of them. The
/// largest fiftieth is left out, and at least what two jumps reach, which is `reached` poses each. None if there are
/// fewer than three.
template <LieGroup G, TimePoint Time>
[[nodiscard]] std::optional<MotionAtScale<G>> motion_at_scale(const std::vector<Stamped<G, Time>>& poses, double h,
                                                              std::size_t reached) {
  using Scalar = ScalarOf<G>;
  constexpr std::size_t most = 4096;
  const auto since_first = [&](std::size_t i) { return seconds<double>(poses[i].time - poses.front().time); };
  std::array<std::size_t, 5> at{};
  std::vector<Tangent<G>> residuals, accelerations;
  const std::size_t step = std::max<std::size_t>(1, poses.size() / most);
  for (std::size_t i = 0; i < poses.size(); i += step) {
    bool found = true;
    for (std::size_t j = 0; j < at.size() && found; ++j) {
      const double wanted = since_first(i) + h * (static_cast<double>(j) - 2);
      std::size_t& k = at[j];
      while (k + 1 < poses.size() && std::abs(since_first(k + 1) - wanted) <= std::abs(since_first(k) - wanted)) ++k;
      found = std::abs(since_first(k) - wanted) <= h / 4;
    }
    if (!found) continue;
    const auto n = neighbour_residual(poses, at);
    residuals.push_back(n.residual.cwiseAbs2());
    accelerations.push_back(n.acceleration.cwiseAbs2());
  }
  if (residuals.size() < 3) return std::nullopt;
  const std::size_t left_out = std::min(residuals.size() / 3, std::max(residuals.size() / 50, 2 * (reached / step)));
  const auto trimmed_mean = [left_out](const std::vector<Tangent<G>>& squares) {
    Tangent<G> mean;
    std::vector<Scalar> values(squares.size());
    const std::size_t kept = squares.size() - left_out;
    for (int row = 0; row < mean.size(); ++row) {
      std::transform(squares.begin(), squares.end(), values.begin(), [&](const auto& s) { return s[row]; });
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept - 1), values.end());
      Scalar sum(0);
      for (std::size_t i = 0; i < kept; ++i) sum += values[i];
      mean[row] = sum / static_cast<Scalar>(kept);
    }
    return mean;
  };
  return MotionAtScale<G>{trimmed_mean(residuals), trimmed_mean(accelerations)};
}

/// What keeps chosen knots from being further apart.
enum class KnotLimit {
  motion,  ///< the curve would be off by more than its noise, or by more than a two-thousandth of the acceleration
  poses,   ///< the same at any interval that the poses hold: they are too sparse for their motion
  turn,    ///< neighbouring control points would turn by more than 120° against each other
  length,  ///< 64 poses to a knot, or eight segments in all: the poses show no motion
};

/// A knot interval for poses, and why.
template <LieGroup G>
struct KnotChoice {
  double interval;  ///< s
  KnotLimit limit;
  double pose_interval;  ///< s, the median
  Tangent<G> noise;      ///< standard deviation of a pose, of each component (noise_of)
};

/// The longest interval that poses turn by less than 120° in, s; infinity if they do not turn. A single jump does not
/// count.
template <LieGroup G, TimePoint Time>
[[nodiscard]] double longest_unambiguous_interval(const std::vector<Stamped<G, Time>>& poses) {
  std::vector<double> rate;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto turn = TurnAngle<G>::of(increment<G>(poses[i - 1].value, poses[i].value));
    rate.push_back(static_cast<double>(turn) / seconds<double>(poses[i].time - poses[i - 1].time));
  }
  double fastest = rate.size() < 3 ? *std::max_element(rate.begin(), rate.end()) : 0;
  for (std::size_t i = 2; i < rate.size(); ++i) {
    const double &a = rate[i - 2], &b = rate[i - 1], &c = rate[i];
    fastest = std::max(fastest, std::max(std::min(a, b), std::min(std::max(a, b), c)));  // the middle of the three
  }
  return largest_turn / fastest;
}

/// The errors of the first two derivatives of a spline, from the sizes of h² x″ and h⁴ x⁗. A spline of order k is off
/// by √(|B₂ₖ₋₂|/(2k−2)!) hᵏ⁻¹ |x⁽ᵏ⁾| in x′ and by √(|B₂ₖ₋₄|/(2k−4)!) hᵏ⁻² |x⁽ᵏ⁾| in x″, root mean squares of
/// Bernoulli's polynomials (de Boor, A Practical Guide to Splines, XII). Orders above 4 are taken for 4, and |x‴| for
/// √(|x″| |x⁗|), as of a sine.
struct SplineErrors {
  double first, second;  ///< of h x′ and h² x″

  SplineErrors(int order, double h2_second, double h4_fourth) {
    if (order > 3) {
      first = 5.75e-3 * h4_fourth;
      second = 0.0373 * h4_fourth;
    } else if (order == 3) {
      first = 0.0373 * std::sqrt(h2_second * h4_fourth);
      second = 0.289 * std::sqrt(h2_second * h4_fourth);
    } else {
      first = 0.289 * h2_second;
      second = h2_second;
    }
  }
};

/// How far apart the knots of a curve should be for its rate to be right: the longest interval h of which the error is
/// below the noise, per component. The cubic through poses at ±h and ±2h is off by h⁴ |x⁗|/6, which gives the errors of
/// the spline; the noise of its velocity is about 1.5 σ/(h √N), with N poses to a knot. Requires two poses in ascending
/// order of time.
template <LieGroup G, TimePoint Time>
[[nodiscard]] KnotChoice<G> choose_knot_interval(const std::vector<Stamped<G, Time>>& poses, int order = 4) {
  const double span = seconds<double>(poses.back().time - poses.front().time);
  KnotChoice<G> choice{0, KnotLimit::length, median_interval(poses), noise_of(poses)};
  const auto good = [&](double h, const MotionAtScale<G>& motion) {
    const double poses_to_a_knot = h / choice.pose_interval;
    for (int row = 0; row < choice.noise.size(); ++row) {
      const auto noise = static_cast<double>(choice.noise[row]);
      // Of the residual r, 17/18 σ² is what noise adds at four even neighbours.
      const double square = static_cast<double>(motion.residual_square[row]) - 1.944 * noise * noise;
      if (!(square > 0)) continue;
      const double acceleration = std::sqrt(static_cast<double>(motion.acceleration_square[row]));
      const SplineErrors error(order, h * h * acceleration, 6 * std::sqrt(square));
      const double noise_of_first = 1.5 * noise / std::sqrt(poses_to_a_knot);
      if (error.first > noise_of_first && error.second > 5e-4 * h * h * acceleration) return false;
    }
    return true;
  };
  const double shortest = 1.25 * choice.pose_interval;
  const double longest = std::max(shortest, std::min(64 * choice.pose_interval, span / 8));
  choice.interval = shortest;
  bool any = false;
  for (double h = 2 * choice.pose_interval; h < 1.19 * longest; h *= 1.19) {
    const auto reached = static_cast<std::size_t>(4 * h / choice.pose_interval);
    const auto motion = motion_at_scale(poses, std::min(h, longest), reached);
    if (!motion && !any) continue;
    if (!motion) break;
    if (!good(std::min(h, longest), *motion)) {
      choice.limit = any ? KnotLimit::motion : KnotLimit::poses;
      break;
    }
    any = true;
    choice.interval = std::min(h, longest);
  }
  const double unambiguous = longest_unambiguous_interval(poses);
  if (unambiguous < choice.interval) {
    choice.interval = unambiguous;
    choice.limit = KnotLimit::turn;
  }
  return choice;
}

}  // namespace splinertia
