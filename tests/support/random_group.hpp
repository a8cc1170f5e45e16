// SPDX-License-Identifier: MIT
/// Random group elements for tests: the same on every platform.
#pragma once

#include <cstdint>
#include <random>
#include <splinertia/group/lie_group.hpp>
#include <vector>

namespace splinertia::testing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [−1, 1).
  double symmetric() { return static_cast<double>(static_cast<std::int64_t>(bits_())) * 0x1p-63; }

  /// A tangent with components uniform in [−size, size).
  template <LieGroup G>
  Tangent<G> tangent(double size = 1) {
    Tangent<G> tau;
    for (int i = 0; i < tau.size(); ++i) tau[i] = static_cast<ScalarOf<G>>(size * symmetric());
    return tau;
  }

  /// A walk over the group in steps exp(τ), τ as above, from a first element exp(2 τ).
  template <LieGroup G>
  std::vector<G> walk(std::size_t count, double step = 0.5) {
    std::vector<G> points{GroupTraits<G>::exp(tangent<G>(2))};
    while (points.size() < count) {
      points.push_back(GroupTraits<G>::compose(points.back(), GroupTraits<G>::exp(tangent<G>(step))));
    }
    return points;
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace splinertia::testing
