// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <splinertia/detail/pi.hpp>
#include <vector>

namespace splinertia::allan::detail {

/// A deterministic mean that may explain slow power, and what it gains in −2·log-likelihood.
template <typename Scalar>
struct DeterministicDrift {
  Scalar gain{};              ///< after the price of its parameters
  std::vector<Scalar> steps;  ///< times since the beginning, s; empty: a smooth drift
};

/// Finds the best deterministic mean of one axis in the bins with these k. weight_k scales b_k to unit variance; best()
/// takes b_k that are already scaled.
template <typename Scalar>
class DriftSearch {
 public:
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr int positions = 400, most_steps = 4, highest_degree = 4;

  /// A step at time t of 0 … 1 gives b_k = √(2/n)·sin(πkt) times its height. A mean m(t) gives the integral of that
  /// over m'(t).
  DriftSearch(const Column& k, const Column& weight)
      : steps_(k.size(), positions), powers_(Matrix::Zero(k.size(), highest_degree)) {
    for (Eigen::Index p = 0; p < positions; ++p) {
      const Scalar t = (static_cast<Scalar>(p) + Scalar(1) / 2) / positions;
      steps_.col(p) = ((splinertia::detail::pi_of<Scalar>() * t) * k.array()).sin() * weight.array();
      Scalar power = 1;
      for (int d = 0; d < highest_degree; ++d, power *= 2 * t - 1) powers_.col(d) += power * steps_.col(p);
    }
  }

  /// The best mean of one axis, with times as shares of the log.
  [[nodiscard]] DeterministicDrift<Scalar> best(const Column& b) const {
    constexpr Scalar price = 3, time_price = 6;
    DeterministicDrift<Scalar> best;
    const Scalar all = b.squaredNorm();
    Column rest = b;
    Matrix columns = powers_;
    for (int d = 0; d < highest_degree; ++d) {
      take(columns, d, rest);
      const Scalar gain = all - rest.squaredNorm() - price * static_cast<Scalar>(d + 1);
      if (gain > best.gain) best = {gain, {}};
    }
    // Adds steps one by one, each where it explains the most of what the others leave.
    rest = b;
    columns = steps_;
    std::vector<Scalar> times;
    for (int count = 1; count <= most_steps; ++count) {
      const Column taken = (columns.transpose() * rest)
                               .cwiseAbs2()
                               .cwiseQuotient(columns.colwise().squaredNorm().transpose().cwiseMax(least_norm));
      Eigen::Index column = 0;
      taken.maxCoeff(&column);
      times.push_back((static_cast<Scalar>(column) + Scalar(1) / 2) / positions);
      take(columns, column, rest);
      const Scalar gain = all - rest.squaredNorm() - static_cast<Scalar>(count) * (price + time_price);
      if (gain > best.gain) best = {gain, times};
    }
    return best;
  }

 private:
  static constexpr Scalar least_norm = Scalar(1e-12);

  /// Projects a column out of the others and of the rest, which are then orthogonal to it.
  static void take(Matrix& columns, Eigen::Index column, Column& rest) {
    const Scalar norm = columns.col(column).norm();
    if (!(norm > least_norm)) return;
    const Column unit = columns.col(column) / norm;
    rest -= unit * unit.dot(rest);
    columns -= unit * (unit.transpose() * columns);
  }

  Matrix steps_, powers_;
};

/// How well a deterministic mean explains slow power: for each axis a smooth drift, a polynomial of time of degree 1 to
/// 4 as from temperature, or one to four steps. `expected` is the mean square of b_k without slow noise, by bin. Only
/// the lowest 100 bins, with one b_k each, are used: they have 99 % of the information. A coefficient of a polynomial
/// costs 3, a step 3 for its height and 6 for its time.
template <typename Scalar>
[[nodiscard]] DeterministicDrift<Scalar> best_drift(const PooledSpectrum<Scalar>& spectrum,
                                                    const std::vector<bool>& included,
                                                    const std::vector<Scalar>& expected) {
  using Search = DriftSearch<Scalar>;
  constexpr std::size_t most_bins = 100;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < (std::min)(most_bins, spectrum.bins().size()); ++i) {
    if (included[i]) used.push_back(i);
  }
  DeterministicDrift<Scalar> all;
  const auto size = static_cast<Eigen::Index>(used.size());
  if (size < 2 * Search::highest_degree) return all;
  typename Search::Column k(size), weight(size), b(size);
  // The unit makes the weights near one.
  const Scalar unit = expected[used.front()];
  for (Eigen::Index j = 0; j < size; ++j) {
    const std::size_t i = used[static_cast<std::size_t>(j)];
    k[j] = static_cast<Scalar>(i + 1);
    weight[j] = std::sqrt(unit / expected[i]);
  }
  const Search search(k, weight);
  for (const auto& sums : spectrum.trend_sums()) {
    for (Eigen::Index j = 0; j < size; ++j) {
      const std::size_t i = used[static_cast<std::size_t>(j)];
      b[j] = (sums[i].odd + sums[i].even) / std::sqrt(expected[i]);
    }
    const auto one = search.best(b);
    all.gain += one.gain;
    for (const Scalar time : one.steps) all.steps.push_back(time * spectrum.duration());
  }
  std::sort(all.steps.begin(), all.steps.end());
  return all;
}

}  // namespace splinertia::allan::detail
