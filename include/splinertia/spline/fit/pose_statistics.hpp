// SPDX-License-Identifier: MIT
/// The noise and the motion of stamped poses, estimated without a curve.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia {

/// The median interval between neighbouring poses, s. Requires at least two poses.
template <LieGroup G, TimePoint Time>
[[nodiscard]] double median_interval(const std::vector<Stamped<G, Time>>& poses) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < poses.size(); ++i)
    intervals.push_back(to_seconds<double>(poses[i].time - poses[i - 1].time));
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

namespace detail {

/// The residual of a pose against the polynomial through its neighbours.
template <LieGroup G>
struct NeighbourResidual {
  Tangent<G> residual;        ///< Σ w_j y_j, w_j the weights of the Lagrange polynomial at the time of the pose
  ScalarOf<G> amplification;  ///< √(1 + Σ w_j²): standard deviation of the residual over that of a pose
  Tangent<G> acceleration;    ///< of the parabola through the pose and its nearest two
};

/// The residual of the middle one of N poses, whose indices ascend. y_j is the sum of the increments from it to
/// neighbour j. This is log(x₀⁻¹ x_j) if the increments commute, and unambiguous if neighbours turn by less than π.
template <LieGroup G, TimePoint Time, std::size_t N>
[[nodiscard]] NeighbourResidual<G> neighbour_residual(const std::vector<Stamped<G, Time>>& poses,
                                                      const std::array<std::size_t, N>& indices) {
  using std::sqrt;
  using Scalar = ScalarOf<G>;
  static_assert(N % 2 == 1 && N >= 3);
  constexpr std::size_t middle = N / 2;
  std::array<Scalar, N> time{};
  std::array<Tangent<G>, N> way;
  way[middle].setZero();
  const auto step = [&](std::size_t from, std::size_t to) {
    return increment<G>(poses[indices[from]].value, poses[indices[to]].value);
  };
  for (std::size_t j = middle + 1; j < N; ++j) {
    way[j] = way[j - 1] + step(j - 1, j);
    time[j] = to_seconds<Scalar>(poses[indices[j]].time - poses[indices[middle]].time);
  }
  for (std::size_t j = middle; j-- > 0;) {
    way[j] = way[j + 1] - step(j, j + 1);
    time[j] = -to_seconds<Scalar>(poses[indices[middle]].time - poses[indices[j]].time);
  }
  NeighbourResidual<G> result{Tangent<G>::Zero(), Scalar(1), Tangent<G>::Zero()};
  for (std::size_t j = 0; j < N; ++j) {
    if (j == middle) continue;
    Scalar weight(1);
    for (std::size_t l = 0; l < N; ++l) {
      if (l != j && l != middle) weight *= time[l] / (time[l] - time[j]);
    }
    result.residual += weight * way[j];
    result.amplification += weight * weight;
  }
  result.amplification = sqrt(result.amplification);
  result.acceleration = Scalar(2) / (time[middle + 1] - time[middle - 1]) *
                        (way[middle + 1] / time[middle + 1] - way[middle - 1] / time[middle - 1]);
  return result;
}

}  // namespace detail

/// The standard deviation of a pose, per component, from its residuals against the polynomials through its nearest two,
/// four and six neighbours: the smallest of the three values of 1.4826 · median(|residual|/amplification). It is
/// correct for white noise if the motion between neighbours is smooth compared with the noise, and otherwise an upper
/// bound. If the median is almost zero, poses repeat or are rounded; the 80th percentile over 1.2816 is used instead.
/// Infinite for fewer than three poses.
template <LieGroup G, TimePoint Time>
[[nodiscard]] Tangent<G> pose_noise(const std::vector<Stamped<G, Time>>& poses) {
  using std::abs;
  using Scalar = ScalarOf<G>;
  constexpr Scalar normal = Scalar(1.4826f);
  Tangent<G> least = Tangent<G>::Constant(std::numeric_limits<Scalar>::infinity());
  const auto with = [&]<std::size_t N>() {
    if (poses.size() < N) return;
    std::array<std::vector<Scalar>, static_cast<std::size_t>(DofOf<G>)> magnitudes;
    for (std::size_t i = 0; i + N <= poses.size(); ++i) {
      std::array<std::size_t, N> indices;
      for (std::size_t j = 0; j < N; ++j) indices[j] = i + j;
      const auto [residual, amplification, acceleration] = detail::neighbour_residual(poses, indices);
      for (std::size_t row = 0; row < magnitudes.size(); ++row) {
        magnitudes[row].push_back(abs(residual[static_cast<Eigen::Index>(row)]) / amplification);
      }
    }
    for (std::size_t row = 0; row < magnitudes.size(); ++row) {
      auto& all = magnitudes[row];
      const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
      std::nth_element(all.begin(), middle, all.end());
      const Scalar median = *middle;
      const auto upper = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 4 / 5);
      std::nth_element(all.begin(), upper, all.end());
      const Scalar of_upper = *upper / Scalar(1.2816f);
      Scalar& entry = least[static_cast<Eigen::Index>(row)];
      entry = (std::min)(entry, 10 * normal * median < of_upper ? of_upper : normal * median);
    }
  };
  with.template operator()<3>();
  with.template operator()<5>();
  with.template operator()<7>();
  return least;
}

}  // namespace splinertia
