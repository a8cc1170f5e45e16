// SPDX-License-Identifier: MIT
/// Sums of squared differences of running sums, for all averaging factors at once.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/detail/compensated_sum.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan::detail {

/// Factors m, 2m, 4m … Their second differences share reads: x_{i+2m} of one is x_{i+m} of the next.
struct DoublingChain {
  static constexpr std::size_t longest = 4;
  std::int64_t first;
  std::vector<std::size_t> indices;  ///< the index of each factor in the list
};

[[nodiscard]] inline std::vector<DoublingChain> doubling_chains(const std::vector<std::int64_t>& factors,
                                                                std::size_t longest) {
  std::vector<DoublingChain> chains;
  std::vector<bool> used(factors.size());
  for (std::size_t j = 0; j < factors.size(); ++j) {
    if (used[j]) continue;
    DoublingChain chain{factors[j], {j}};
    for (std::size_t length = 1; length < longest; ++length) {
      const auto next = std::lower_bound(factors.begin(), factors.end(), factors[j] << length);
      const auto index = static_cast<std::size_t>(next - factors.begin());
      if (next == factors.end() || *next != factors[j] << length || used[index]) break;
      used[index] = true;
      chain.indices.push_back(index);
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

/// Σ over i from `begin` to before `end` of the squared second differences of x over m, 2m … 2^(Factors−1)·m (Order 2),
/// or third differences over m (Order 3).
template <int Order, std::size_t Factors, typename Scalar>
[[nodiscard]] std::array<Scalar, Factors> squared_differences(const Scalar* x, std::int64_t m, std::int64_t begin,
                                                              std::int64_t end) {
  static_assert(Order == 2 || (Order == 3 && Factors == 1));
  constexpr int lanes = Factors > 2 ? 8 : 16;  // enough to keep the adders busy, few enough for 16 AVX registers
  using SimdPack = Eigen::Array<Scalar, lanes, 1>;
  using At = Eigen::Map<const SimdPack>;
  std::array<SimdPack, Factors> squares;
  for (SimdPack& s : squares) s.setZero();
  std::array<Scalar, Factors> rest{};
  // Differences of differences: neighbouring sums are close to each other, so that no digits are lost.
  const auto accumulate = [m](auto at, auto& sums, auto square) {
    const auto x0 = at(0);
    auto middle = at(m);
    for (std::size_t k = 0; k < Factors; ++k) {
      const auto distant = at(m << (k + 1));
      auto difference = ((distant - middle) - (middle - x0));
      if constexpr (Order == 3) {
        const auto farthest = at(3 * m);
        sums[k] += square(((farthest - distant) - (distant - middle)) - difference);
      } else {
        sums[k] += square(difference);
      }
      middle = distant;
    }
  };
  std::int64_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    accumulate([p = x + i](std::int64_t k) { return SimdPack(At(p + k)); }, squares,
               [](const auto& d) { return d.square(); });
  }
  for (; i < end; ++i) {
    accumulate([p = x + i](std::int64_t k) { return p[k]; }, rest, [](Scalar d) { return d * d; });
  }
  for (std::size_t k = 0; k < Factors; ++k) rest[k] += squares[k].sum();
  return rest;
}

/// For each factor m, the sum of the squared differences of this order over all places where they fit: for order 2,
/// (x_{i+2m} − 2x_{i+m} + x_i)² for i = 0 … n − 2m; for order 3, (x_{i+3m} − 3x_{i+2m} + 3x_{i+m} − x_i)².
///
/// x is read tile by tile, with all factors for each tile, so that short factors read from the fastest cache. Factors
/// that double share their reads. Requires factors in ascending order, at most n/Order. Relative error ≤ 1e-13 for
/// double.
template <int Order, typename Scalar>
[[nodiscard]] std::vector<Scalar> overlapping_difference_sums(const std::vector<Scalar>& x,
                                                              const std::vector<std::int64_t>& factors) {
  constexpr std::int64_t tile = 1024;
  const auto points = static_cast<std::int64_t>(x.size());
  constexpr std::size_t longest = Order == 2 ? DoublingChain::longest : 1;
  const auto chains = doubling_chains(factors, longest);
  std::vector<CompensatedSum<Scalar>> sums(factors.size());
  for (std::int64_t tile_begin = 0; tile_begin < points; tile_begin += tile) {
    for (const DoublingChain& chain : chains) {
      std::int64_t begin = tile_begin;
      const auto run = [&]<std::size_t Factors>() {
        // Where the differences over the longest factor no longer fit, those over shorter ones go on.
        const std::int64_t reach = Order == 2 ? chain.first << Factors : Order * chain.first;
        const std::int64_t end = (std::min)(tile_begin + tile, points - reach);
        if (Factors > chain.indices.size() || begin >= end) return;
        const auto part = squared_differences<Order, Factors>(x.data(), chain.first, begin, end);
        for (std::size_t k = 0; k < Factors; ++k) sums[chain.indices[k]].add(part[k]);
        begin = end;
      };
      [&]<std::size_t... Index>(std::index_sequence<Index...>) {
        (run.template operator()<longest - Index>(), ...);
      }(std::make_index_sequence<longest>{});
    }
  }
  std::vector<Scalar> result;
  for (const auto& sum : sums) result.push_back(sum.value());
  return result;
}

/// As above, but at every m-th sample only: differences that do not overlap.
template <int Order, typename Scalar>
[[nodiscard]] Scalar separate_difference_sum(const std::vector<Scalar>& x, std::int64_t m) {
  const auto points = static_cast<std::int64_t>(x.size());
  CompensatedSum<Scalar> sum;
  for (std::int64_t i = 0; i + Order * m < points; i += m) {
    sum.add(squared_differences<Order, 1>(x.data(), m, i, i + 1)[0]);
  }
  return sum.value();
}

/// Σ_j (Σ_{i=j}^{j+m−1} x_{i+2m} − 2x_{i+m} + x_i)² for j = 0 … n + 1 − 3m: what the modified deviation averages.
///
/// The inner sum is updated from j to j + 1 and computed anew after 8m steps (at least 1024), before rounding errors
/// accumulate. Cost: 9/8 of the work. Relative error ≤ 1e-12 for double.
template <typename Scalar>
[[nodiscard]] Scalar modified_difference_sum(const std::vector<Scalar>& x, std::int64_t m) {
  const auto at = [p = x.data()](std::int64_t i) { return p[i]; };
  const std::int64_t terms = static_cast<std::int64_t>(x.size()) - 3 * m + 1;
  const std::int64_t run = std::max<std::int64_t>(1024, 8 * m);
  CompensatedSum<Scalar> sum;
  for (std::int64_t begin = 0; begin < terms; begin += run) {
    const std::int64_t end = (std::min)(begin + run, terms);
    Scalar inner = 0;
    for (std::int64_t i = begin; i < begin + m; ++i) inner += (at(i + 2 * m) - at(i + m)) - (at(i + m) - at(i));
    Scalar squares = inner * inner;
    for (std::int64_t j = begin; j + 1 < end; ++j) {
      inner += (at(j + 3 * m) - at(j)) - 3 * (at(j + 2 * m) - at(j + m));
      squares += inner * inner;
    }
    sum.add(squares);
  }
  return sum.value();
}

/// The part of the total deviation beyond the overlapping one: the second differences about i = 1 … m − 1 and
/// n − m + 1 … n − 1, with x extended by reflection about its ends: x_{−j} = 2x_0 − x_j. Requires m of at most n/2.
template <typename Scalar>
[[nodiscard]] Scalar reflected_difference_sum(const std::vector<Scalar>& x, std::int64_t m) {
  const Scalar* first = x.data();
  const Scalar* last = first + (x.size() - 1);
  CompensatedSum<Scalar> sum;
  for (std::int64_t i = 1; i < m; ++i) {
    const Scalar left = (first[i + m] - first[i]) - (first[i] - (2 * first[0] - first[m - i]));
    const Scalar right = (last[-i - m] - last[-i]) - (last[-i] - (2 * last[0] - last[i - m]));
    sum.add(left * left + right * right);
  }
  return sum.value();
}

}  // namespace splinertia::allan::detail
