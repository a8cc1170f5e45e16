// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <random>
#include <splinertia/allan/noise_type.hpp>
#include <vector>

#include "allan/reference.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

/// White noise, of which (1 − B)^(alpha/2), B the shift by one sample, is taken: a power law |2 sin πf|^alpha.
/// Kasdin, Proc. IEEE 83 (1995).
std::vector<double> power_law_noise(int alpha, std::size_t n) {
  std::mt19937_64 bits(11);
  std::normal_distribution<double> normal;
  std::vector<double> y(n);
  for (double& value : y) value = normal(bits);
  if (alpha % 2 != 0) {  // half a difference, to a thousand samples
    std::vector<double> weights{1}, result(n, 0.0);
    for (std::size_t k = 1; k < 1000; ++k) {
      weights.push_back(weights.back() * (static_cast<double>(k) - 1.5) / static_cast<double>(k));
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < std::min(i + 1, weights.size()); ++k) result[i] += weights[k] * y[i - k];
    }
    y = result;
    --alpha;
  }
  for (; alpha > 0; alpha -= 2) {
    for (std::size_t i = n - 1; i > 0; --i) y[i] -= y[i - 1];
  }
  for (; alpha < 0; alpha += 2) {
    for (std::size_t i = 1; i < n; ++i) y[i] += y[i - 1];
  }
  return y;
}

template <typename S>
int type_of(const S& signal, std::int64_t m) {
  return noise_type(IntegratedSignal(signal, 200.0), m);
}

}  // namespace

TEST_CASE("Power laws are recognised") {
  for (int alpha = -4; alpha <= 2; ++alpha) {
    const auto noise = power_law_noise(alpha, 20'000);
    INFO("alpha " << alpha);
    CHECK(type_of(noise, 1) == alpha);
    // Of odd ones, half a difference is cut short, which longer averages would see.
    for (std::int64_t m : {10, 100}) {
      if (alpha % 2 == 0) CHECK(type_of(noise, m) == alpha);
    }
    std::vector<double> shifted = noise;
    for (double& y : shifted) y = 1e-6 * y + 3;
    for (std::int64_t m : {1, 10, 100}) CHECK(type_of(shifted, m) == type_of(noise, m));
  }
}

TEST_CASE("Each averaging time has the type of what rules there") {
  // White noise and a random walk of equal Allan variance at m = 50.
  const auto white = power_law_noise(0, 200'000);
  auto walk = power_law_noise(-2, 200'001);
  std::vector<double> sum;
  for (std::size_t i = 0; i < white.size(); ++i) sum.push_back(white[i] + walk[i + 1] * std::sqrt(3.0) / 50);
  CHECK(type_of(sum, 1) == 0);
  CHECK(type_of(sum, 1000) == -2);
}

TEST_CASE("Of fewer than 30 averages the type is that of shorter ones, of fewer than 30 samples white") {
  const auto walk = power_law_noise(-2, 3000);
  CHECK(type_of(walk, 100) == type_of(walk, 1000));
  CHECK(type_of(walk, 100) == type_of(walk, 3000));
  CHECK(type_of(power_law_noise(-2, 30), 1) != 0);
  CHECK(type_of(power_law_noise(-2, 29), 1) == 0);
  CHECK(type_of(std::vector<double>{1, 2, 4}, 1) == 0);
}

TEST_CASE("Only the first 65536 averages are read") {
  auto noise = power_law_noise(0, 65'536);
  const auto walk = power_law_noise(-2, 100'000);
  noise.insert(noise.end(), walk.begin(), walk.end());
  CHECK(type_of(noise, 1) == 0);
  CHECK(type_of(noise, 4) == -2);
}

TEST_CASE("Signals that are no noise have a type, too") {
  std::vector<double> ramp, cubic, warm_up, turns, step, spike(1000, 1.0), plateau(100'000, 9.81);
  for (int i = 0; i < 1000; ++i) {
    const double t = i / 1000.0;
    ramp.push_back(t);
    cubic.push_back(t * t * t);
    warm_up.push_back(1 - std::exp(-3 * t));
    turns.push_back(i % 2 == 0 ? 1 : -1);
    step.push_back(i < 500 ? 0 : 1);
  }
  spike[500] = 2;
  plateau.back() = 9.82;
  CHECK(type_of(turns, 1) == 2);
  // Smoother than any noise with a type: as steep as types go, which degrees of freedom are known for.
  CHECK(type_of(cubic, 1) == -4);
  CHECK(type_of(warm_up, 1) == -4);
  for (const auto& signal : {ramp, cubic, warm_up, turns, step, spike, plateau}) {
    for (std::int64_t m : {1, 2, 7, 33, 500}) {
      const int alpha = type_of(signal, m);
      CHECK(alpha >= -4);
      CHECK(alpha <= 2);
    }
  }
}

TEST_CASE("Types from sums of squares and products") {
  CHECK(power_law(1.0, 0.0, 1e9, 0) == 0);
  CHECK(power_law(1.0, -0.5, 1e9, 0) == 2);
  CHECK(power_law(1.0, -0.9, 1e9, 0) == 2);
  CHECK(power_law(1.0, 0.3, 1e9, 0) == 0);  // δ = 0.231
  CHECK(power_law(1.0, 0.34, 1e9, 0) == std::nullopt);
  CHECK(power_law(1.0, 0.34, 1e9, 2) == -4);
  CHECK(power_law(0.0, 0.0, 1e9, 1) == -2);
  CHECK(power_law(1.0L, 0.9L, 1e9L, 2) == -4);
}
