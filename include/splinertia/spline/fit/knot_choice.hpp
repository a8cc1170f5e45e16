// SPDX-License-Identifier: MIT
/// Chooses knots from the rate, the noise and the motion of the poses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <splinertia/detail/finite.hpp>
#include <splinertia/group/detail/tangent_units.hpp>
#include <splinertia/group/detail/turn_angle.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/fit/detail/pose_breaks.hpp>
#include <splinertia/spline/fit/pose_statistics.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia {

namespace detail {

/// The largest rotation between neighbouring control points, rad. Beyond π its direction would be ambiguous.
inline constexpr double largest_turn = 2 * std::numbers::pi / 3;

/// The poses without those that are astray between two breaks. part[i] is the index of the part between jumps that pose
/// i is in.
template <LieGroup G, TimePoint Time>
struct UnbrokenPoses {
  std::vector<Stamped<G, Time>> poses;
  std::vector<std::size_t> part;

  explicit UnbrokenPoses(const std::vector<Stamped<G, Time>>& all) {
    constexpr std::size_t most_astray = 4;  // poses between two breaks
    const auto breaks = breaks_between(all);
    std::size_t from = 0;
    for (std::size_t b = 0; b < breaks.size(); ++b) {
      const auto to = static_cast<std::ptrdiff_t>(breaks[b] + 1);
      const bool astray = b > 0 && breaks[b] <= breaks[b - 1] + most_astray;
      if (!astray) poses.insert(poses.end(), all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + to);
      from = breaks[b] + 1;
    }
    poses.insert(poses.end(), all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
    part.assign(poses.size(), 0);
    for (const std::size_t jump : breaks_between(poses)) ++part[jump + 1];
    std::partial_sum(part.begin(), part.end(), part.begin());
  }
};

/// Mean squares, per component, over poses that are an interval h apart.
template <LieGroup G>
struct MotionAtScale {
  Tangent<G> residual_square;      ///< residual of a pose against the cubic through those at ±h and ±2h
  Tangent<G> acceleration_square;  ///< acceleration of the parabola through those at 0 and ±h
};

/// The means over all poses with neighbours at these distances to within a quarter of h and no jump between them; at
/// most a few thousand poses are used. Empty if fewer than three qualify.
template <LieGroup G, TimePoint Time>
[[nodiscard]] std::optional<MotionAtScale<G>> motion_at_scale(const UnbrokenPoses<G, Time>& unbroken, double h) {
  constexpr std::size_t most = 4096;
  const auto& poses = unbroken.poses;
  const auto& part = unbroken.part;
  const auto since_first = [&](std::size_t i) { return to_seconds<double>(poses[i].time - poses.front().time); };
  std::array<std::size_t, 5> at{};
  MotionAtScale<G> sum{Tangent<G>::Zero(), Tangent<G>::Zero()};
  std::size_t count = 0;
  for (std::size_t i = 0; i < poses.size(); i += std::max<std::size_t>(1, poses.size() / most)) {
    bool found = true;
    for (std::size_t j = 0; j < at.size() && found; ++j) {
      const double wanted = since_first(i) + h * (static_cast<double>(j) - 2);
      std::size_t& k = at[j];
      while (k + 1 < poses.size() && std::abs(since_first(k + 1) - wanted) <= std::abs(since_first(k) - wanted)) ++k;
      found = std::abs(since_first(k) - wanted) <= h / 4;
    }
    if (!found || part[at.front()] != part[at.back()]) continue;
    const auto n = neighbour_residual(poses, at);
    sum.residual_square += n.residual.cwiseAbs2();
    sum.acceleration_square += n.acceleration.cwiseAbs2();
    ++count;
  }
  if (count < 3) return std::nullopt;
  const auto number = static_cast<ScalarOf<G>>(count);
  return MotionAtScale<G>{sum.residual_square / number, sum.acceleration_square / number};
}

}  // namespace detail

/// What limits the chosen knot interval.
enum class KnotLimit {
  motion,  ///< a longer one has a velocity error above the noise and an acceleration error above a two-thousandth
  poses,   ///< the same at every interval that the poses allow: they are too sparse for their motion
  turn,    ///< neighbouring control points would turn by more than 120° relative to each other
  length,  ///< 64 poses per knot, or eight segments in all, are reached: the poses show no motion
};

namespace detail {

/// A knot interval chosen for poses, and what limits it.
template <LieGroup G>
struct KnotChoice {
  double interval;  ///< s
  KnotLimit limit;
  double pose_interval;  ///< s, the median
  double unambiguous;    ///< s: in longer intervals the poses turn by more than 120°
  Tangent<G> noise;      ///< standard deviation of a pose, of each component (pose_noise)
};

/// The longest interval in which poses turn by less than 120°, s; infinity if they do not turn. A single jump does not
/// count. 3·noise is subtracted from each turn; `noise` is the length of the standard deviation of a rotation, rad.
template <LieGroup G, TimePoint Time>
[[nodiscard]] double longest_unambiguous_interval(const std::vector<Stamped<G, Time>>& poses, double noise = 0) {
  std::vector<double> rate;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto turn = TurnAngle<G>::of(increment<G>(poses[i - 1].value, poses[i].value));
    const double length = to_seconds<double>(poses[i].time - poses[i - 1].time);
    rate.push_back((std::max)(0., static_cast<double>(turn) - 3 * noise) / length);
  }
  double fastest = rate.size() < 3 ? *std::max_element(rate.begin(), rate.end()) : 0;
  for (std::size_t i = 2; i < rate.size(); ++i) {
    const double &a = rate[i - 2], &b = rate[i - 1], &c = rate[i];
    fastest =
        (std::max)(fastest, (std::max)((std::min)(a, b), (std::min)((std::max)(a, b), c)));  // median of the three
  }
  return largest_turn / fastest;
}

/// The errors of the first two derivatives of a spline, from the magnitudes of h² x″ and h⁴ x⁗. The RMS error of a
/// spline of order k is √(|B₂ₖ₋₂|/(2k−2)!) hᵏ⁻¹ |x⁽ᵏ⁾| in x′ and √(|B₂ₖ₋₄|/(2k−4)!) hᵏ⁻² |x⁽ᵏ⁾| in x″, from the
/// Bernoulli polynomials (de Boor, A Practical Guide to Splines, XII). Orders above 4 are treated as 4, and |x‴| as
/// √(|x″| |x⁗|), as for a sine.
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

/// Whether a spline of this order with knots h seconds apart follows a motion to within the noise of the poses: see
/// choose_knot_interval().
template <LieGroup G>
[[nodiscard]] bool follows_motion(const KnotChoice<G>& choice, int order, double h, const MotionAtScale<G>& motion) {
  const double poses_to_a_knot = h / choice.pose_interval;
  bool all = true;
  TangentUnits<G>::for_each([&](int first, int rows) {
    const auto noise = static_cast<double>(choice.noise.segment(first, rows).squaredNorm()) / rows;
    const double noise_of_first = 1.5 * std::sqrt(noise / poses_to_a_knot);
    for (int row = first; row < first + rows; ++row) {
      // With evenly spaced neighbours, noise adds 35/18 σ² to the square of the residual, and 6 σ² to that of h² x″.
      const auto own_noise = static_cast<double>(choice.noise[row] * choice.noise[row]);
      const auto without_noise = [&](double square, double share) {
        return std::sqrt((std::max)(0., square - share * own_noise));
      };
      const double second = without_noise(std::pow(h, 4) * static_cast<double>(motion.acceleration_square[row]), 6);
      const double fourth = 6 * without_noise(static_cast<double>(motion.residual_square[row]), 35. / 18);
      const SplineErrors error(order, second, fourth);
      all = all && (error.first <= noise_of_first || error.second <= 5e-4 * second);
    }
  });
  return all;
}

}  // namespace detail

/// Chooses the knot interval for an accurate velocity: the longest interval h for which in each component the error of
/// the velocity is below its noise, or that of the acceleration is below a two-thousandth of it. The noise is the RMS
/// over all components of the same unit. The residual against the cubic through poses at ±h and ±2h is h⁴ |x⁗|/6, which
/// gives the errors of the spline. The noise of the velocity is about 1.5 σ/(h √N), with N poses per knot. Requires at
/// least two poses in ascending order of time.
template <LieGroup G, TimePoint Time>
[[nodiscard]] detail::KnotChoice<G> choose_knot_interval(const std::vector<Stamped<G, Time>>& poses, int order = 4) {
  const double span = to_seconds<double>(poses.back().time - poses.front().time);
  detail::KnotChoice<G> choice{0, KnotLimit::length, median_interval(poses), 0, pose_noise(poses)};
  const double shortest = 1.25 * choice.pose_interval;
  const double longest = (std::max)(shortest, (std::min)(64 * choice.pose_interval, span / 8));
  choice.interval = shortest;
  const detail::UnbrokenPoses<G, Time> unbroken(poses);
  bool any = false;
  for (double h = 2 * choice.pose_interval; h < 1.19 * longest; h *= 1.19) {
    const auto motion = detail::motion_at_scale(unbroken, (std::min)(h, longest));
    if (!motion && !any) continue;
    if (!motion) break;
    if (!detail::follows_motion(choice, order, (std::min)(h, longest), *motion)) {
      choice.limit = any ? KnotLimit::motion : KnotLimit::poses;
      break;
    }
    any = true;
    choice.interval = (std::min)(h, longest);
  }
  const auto noise_of_turns = static_cast<double>(detail::TurnAngle<G>::of(choice.noise));
  choice.unambiguous =
      detail::longest_unambiguous_interval(poses, detail::is_finite(noise_of_turns) ? noise_of_turns : 0);
  if (choice.unambiguous < choice.interval) {
    choice.interval = choice.unambiguous;
    choice.limit = KnotLimit::turn;
  }
  return choice;
}

}  // namespace splinertia
