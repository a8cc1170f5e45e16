// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <splinertia/allan/record/saturation.hpp>
#include <vector>

#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::testing;

TEST_CASE("Clipped samples are counted at the end where they are") {
  const auto y = simulated({.n = 20'000, .white = 1, .seed = 1});
  for (const double limit : {1.0, 2.0, 2.5}) {
    auto high = y, both = y;
    for (std::size_t i = 0; i < y.size(); ++i) {
      high[i] = std::min(y[i], limit);
      both[i] = std::clamp(y[i], -limit, limit);
    }
    const auto above = std::count_if(y.begin(), y.end(), [&](double value) { return value >= limit; });
    CHECK(find_saturation(high).highest == above);
    CHECK(find_saturation(high).lowest == 0);
    CHECK(find_saturation(both).highest == above);
    CHECK(find_saturation(both).samples() > above);
  }
}

TEST_CASE("Noise does not saturate, however it is rounded") {
  for (const double resolution : {0.0, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      auto y = simulated({.n = 20'000, .white = 1, .walk = 0.001, .seed = seed, .mean = 0.3});
      for (double& value : y) {
        if (resolution > 0) value = resolution * std::round(value / resolution);
      }
      INFO("resolution " << resolution);
      CHECK(find_saturation(y).samples() == 0);
    }
  }
  CHECK(find_saturation(std::vector<double>(100, 1.0)).samples() == 0);
  CHECK(find_saturation(std::vector<double>{}).samples() == 0);
}
