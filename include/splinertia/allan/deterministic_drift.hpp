// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <splinertia/allan/pooled_spectrum.hpp>
#include <vector>

namespace splinertia::allan {

/// A mean that is no noise: what it gains in −2·log-likelihood, and what it has.
template <typename Scalar>
struct DeterministicDrift {
  Scalar gain{};              ///< less the price of its parameters
  std::vector<Scalar> steps;  ///< times since the beginning, s; none: a smooth drift
};

/// How well slow power can be told by a mean instead: by a smooth drift, a polynomial of time of degree 1 to 4 as of a
/// temperature, or by one to four steps. `expected` is the mean square of b_k without slow noise, by bin. Only the
/// lowest bins count, those of one b_k each: they have all but a hundredth of what is known of either. A coefficient
/// of a polynomial costs 3, a step 3 for its height and 6 for its time. Several spectra have coefficients of their own,
/// and steps at common times.
template <typename Scalar>
[[nodiscard]] DeterministicDrift<Scalar> best_drift(const PooledSpectrum<Scalar>& spectrum,
                                                    const std::vector<bool>& included,
                                                    const std::vector<Scalar>& expected) {
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr std::size_t most_bins = 100, positions = 400;
  constexpr int most_steps = 4, highest_degree = 4;
  constexpr Scalar price = 3, time_price = 6;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < std::min(most_bins, spectrum.bins().size()); ++i) {
    if (included[i]) used.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(used.size());
  const auto n = static_cast<Scalar>(spectrum.samples());
  const auto axes = static_cast<Eigen::Index>(spectrum.spectra());
  DeterministicDrift<Scalar> best;
  if (size < 2 * highest_degree) return best;
  Matrix b(size, axes);
  Column weight(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const std::size_t i = used[static_cast<std::size_t>(j)];
    weight[j] = 1 / std::sqrt(expected[i]);
    for (Eigen::Index a = 0; a < axes; ++a) {
      const auto& sums = spectrum.trend_sums()[static_cast<std::size_t>(a)][i];
      b(j, a) = (sums.odd + sums.even) * weight[j];
    }
  }
  // b_k of a mean m(t), t from 0 to 1: √(2/n) Σ m'·sin(πkt), weighted.
  const auto sine = [&](Eigen::Index j, Scalar t) {
    const auto k = static_cast<Scalar>(used[static_cast<std::size_t>(j)] + 1);
    return std::sin(std::numbers::pi_v<Scalar> * k * t) * weight[j];
  };
  const auto gain_of = [&](const Matrix& basis) {
    const Matrix product = basis.transpose() * b;
    const Matrix information = basis.transpose() * basis;
    return Scalar((product.transpose() * information.ldlt().solve(product)).trace());
  };
  // Derivatives of polynomials: 1, t, t² …, about the middle.
  Matrix powers = Matrix::Zero(size, highest_degree);
  for (std::size_t p = 0; p < positions; ++p) {
    const Scalar t = (static_cast<Scalar>(p) + Scalar(1) / 2) / positions;
    for (Eigen::Index j = 0; j < size; ++j) {
      Scalar value = sine(j, t);
      for (int d = 0; d < highest_degree; ++d, value *= 2 * t - 1) powers(j, d) += value / positions;
    }
  }
  for (int degree = 1; degree <= highest_degree; ++degree) {
    const Scalar gain = gain_of(powers.leftCols(degree)) - price * static_cast<Scalar>(degree * axes);
    if (gain > best.gain) best = {gain, {}};
  }
  // Steps one by one, each where it gains the most beside the others.
  Matrix steps(size, 0);
  std::vector<Scalar> times;
  for (int count = 1; count <= most_steps; ++count) {
    Matrix trial(size, count);
    trial.leftCols(count - 1) = steps;
    Scalar most = 0, time = 0;
    for (std::size_t p = 1; p < positions; ++p) {
      const Scalar t = static_cast<Scalar>(p) / positions;
      for (Eigen::Index j = 0; j < size; ++j) trial(j, count - 1) = sine(j, t);
      if (const Scalar gain = gain_of(trial); gain > most) {
        most = gain;
        time = t;
      }
    }
    if (!(most > 0)) break;
    for (Eigen::Index j = 0; j < size; ++j) trial(j, count - 1) = sine(j, time);
    steps = trial;
    times.push_back(time * n / spectrum.rate());
    const Scalar gain = most - static_cast<Scalar>(count) * (price * static_cast<Scalar>(axes) + time_price);
    if (gain > best.gain) best = {gain, times};
  }
  std::sort(best.steps.begin(), best.steps.end());
  return best;
}

}  // namespace splinertia::allan
