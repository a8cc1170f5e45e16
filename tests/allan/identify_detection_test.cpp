// SPDX-License-Identifier: MIT
/// How often terms are detected that are not in a log: at most 1.5 % for each term and kind of log.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <splinertia/allan/identify.hpp>
#include <string>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::testing;

namespace {

using Values = std::vector<double>;
constexpr std::size_t size = 20'000;
constexpr double rate = 50, density = 0.02;
constexpr int logs = 40;

Values log_with(std::uint64_t seed, double walk = 0, double flicker = 0, double ramp = 0) {
  return simulated(
      {.n = size, .rate = rate, .white = density, .walk = walk, .flicker = flicker, .ramp = ramp, .seed = seed});
}

Values biased(std::uint64_t seed, double deviation) {
  Values y = log_with(seed);
  add_gauss_markov(y, rate, deviation, 10, seed);
  return y;
}

Values warming(std::uint64_t seed, double height) {
  Values y = log_with(seed);
  add_warm_up(y, rate, height, 60);
  return y;
}

/// The mean of a binomial number and five standard deviations: 4 of 40, 12 of 240.
int most(int trials) {
  const double mean = 0.015 * trials;
  return static_cast<int>(mean + 5 * std::sqrt(mean * (1 - 0.015)));
}

struct Kind {
  std::string name;
  NoiseTerms terms;  // that it has, or that it cannot be told from
  std::function<Values(std::uint64_t)> log_of;
};

}  // namespace

TEST_CASE("Terms that are not in a log are hardly ever detected") {
  using enum NoiseTerm;
  // Of half of the logs so weak that there are other descriptions, of half strong.
  const auto of = [](std::uint64_t seed, double weak, double strong) { return seed % 2 == 0 ? weak : strong; };
  const std::vector<Kind> kinds{
      {"white noise", {white}, [](auto seed) { return log_with(seed); }},
      {"a walk", {white, random_walk}, [&](auto seed) { return log_with(seed, of(seed, 1e-3, 0.01)); }},
      {"flicker noise", {white, bias_instability}, [&](auto seed) { return log_with(seed, 0, of(seed, 0.005, 0.03)); }},
      {"a bias", {white, gauss_markov}, [&](auto seed) { return biased(seed, of(seed, 0.02, 0.1)); }},
      {"a ramp", {white, rate_ramp}, [&](auto seed) { return log_with(seed, 0, 0, of(seed, 5e-5, 1e-3)); }},
      {"a warm-up", {white, warm_up}, [&](auto seed) { return warming(seed, of(seed, 0.01, 0.3)); }},
  };
  std::array<int, noise_terms.size()> all{}, trials{};
  for (const Kind& kind : kinds) {
    std::array<int, noise_terms.size()> detected{};
    for (int seed = 1; seed <= logs; ++seed) {
      const auto estimates = identify(kind.log_of(static_cast<std::uint64_t>(seed)), rate);
      for (const NoiseTerm term : noise_terms) {
        detected[static_cast<std::size_t>(term)] += estimates[term].detected ? 1 : 0;
      }
    }
    for (const NoiseTerm term : noise_terms) {
      if (kind.terms.has(term)) continue;
      const auto i = static_cast<std::size_t>(term);
      INFO(symbol(term) << " of " << kind.name << ": " << detected[i] << " of " << logs);
      CHECK(detected[i] <= most(logs));
      all[i] += detected[i];
      trials[i] += logs;
    }
    CHECK(detected[static_cast<std::size_t>(white)] == logs);
  }
  for (const NoiseTerm term : noise_terms) {
    const auto i = static_cast<std::size_t>(term);
    INFO(symbol(term) << ": " << all[i] << " of " << trials[i]);
    if (trials[i] > 0) CHECK(all[i] <= most(trials[i]));
  }
}
