// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <splinertia/allan/detail/model/model_selection.hpp>
#include <string>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/log_fit.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Selection = ModelSelection<double>;
using Model = Selection::Model;
using Values = std::vector<double>;
constexpr std::size_t size = 20'000;
constexpr double rate = 50, density = 0.02;
constexpr NoiseTerm N = NoiseTerm::white, K = NoiseTerm::random_walk, B = NoiseTerm::bias_instability,
                    Q = NoiseTerm::quantization, R = NoiseTerm::rate_ramp, G = NoiseTerm::gauss_markov,
                    W = NoiseTerm::warm_up;

/// White noise and, where they are not zero, other terms: 400 s at 50 Hz.
Values log_with(std::uint64_t seed, double walk = 0, double ramp = 0, double quantization = 0) {
  return simulated({.n = size,
                    .rate = rate,
                    .white = density,
                    .walk = walk,
                    .quantization = quantization,
                    .ramp = ramp,
                    .seed = seed});
}

Values biased(std::uint64_t seed, double deviation = 0.06, double time = 10) {
  Values y = log_with(seed);
  add_gauss_markov(y, rate, deviation, time, seed);
  return y;
}

Values warming(std::uint64_t seed, double height = 0.3) {
  Values y = log_with(seed);
  add_warm_up(y, rate, height, 60);
  return y;
}

std::string descriptions_of(const Selection& selection) {
  std::string all;
  for (const Model& model : selection.descriptions()) all += (all.empty() ? "" : " ") + symbols(model.terms);
  return all;
}

std::string detected_by(const Selection& selection) {
  NoiseTerms terms;
  for (const NoiseTerm term : noise_terms) {
    if (selection.detects(term)) terms = terms.with(term);
  }
  return symbols(terms);
}

/// In how many of the logs of seeds 1 … `logs` exactly these terms are detected.
int count_detected(int logs, const std::string& expected, const std::function<Values(std::uint64_t)>& log_of) {
  int count = 0;
  for (int seed = 1; seed <= logs; ++seed) {
    const LogFit log(log_of(static_cast<std::uint64_t>(seed)), rate);
    count += detected_by(Selection(log.fit, NoiseTerms::all())) == expected ? 1 : 0;
  }
  return count;
}

/// What the docs say that a model costs beside its likelihood.
double price(NoiseTerms terms, double spectra) {
  double price = 0;
  for (const NoiseTerm term : {N, K, B, Q, W}) price += terms.has(term) ? 3 : 0;
  if (terms.has(G)) price += 6;  // and its time
  if (terms.has(R) || terms.has(W)) price += 9 * spectra;
  return price;
}

}  // namespace

TEST_CASE("White noise and a strong walk are the only description") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const LogFit log(log_with(seed, 0.02), rate);
    const Selection selection(log.fit, NoiseTerms::all());
    INFO("seed " << seed);
    CHECK(descriptions_of(selection) == "NK");
    CHECK(selection.detects(N));
    CHECK_FALSE(selection.detects(B));
    CHECK_FALSE(selection.detects(G));
    CHECK_FALSE(selection.detects(R));
  }
  // Whether it forgets after more than the log, only some logs leave open.
  CHECK(count_detected(8, "NK", [](std::uint64_t seed) { return log_with(seed, 0.02); }) >= 6);
}

TEST_CASE("White noise alone has one description") {
  CHECK(count_detected(12, "N", [](std::uint64_t seed) { return log_with(seed); }) == 12);
  const LogFit log(log_with(1), rate);
  CHECK(descriptions_of(Selection(log.fit, NoiseTerms::all())) == "N");
}

TEST_CASE("A weak walk can be something else") {
  int several = 0, walks = 0, ramps = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const LogFit log(log_with(seed, 6e-4), rate);
    const Selection selection(log.fit, NoiseTerms::all());
    CHECK_FALSE(selection.detects(B));
    CHECK_FALSE(selection.detects(R));
    CHECK_FALSE(selection.detects(W));
    CHECK_FALSE(selection.detects(G));
    const auto descriptions = selection.descriptions();
    several += descriptions.size() > 1 ? 1 : 0;
    if (descriptions.size() > 1) CHECK(detected_by(selection) == "N");
    for (const Model& model : descriptions) {
      walks += model.terms == NoiseTerms{N, K} ? 1 : 0;
      ramps += model.terms == NoiseTerms{N, R} || model.terms == NoiseTerms{N, W} ? 1 : 0;
    }
  }
  CHECK(several >= 4);
  CHECK(walks >= 4);
  CHECK(ramps >= 2);
}

TEST_CASE("A weak ramp can be a walk") {
  int both = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const LogFit log(log_with(seed, 0, 4e-5), rate);
    const Selection selection(log.fit, NoiseTerms::all());
    CHECK(detected_by(selection) == "N");
    const std::string descriptions = descriptions_of(selection);
    both += descriptions.find("NR") != std::string::npos && descriptions.find("NK") != std::string::npos ? 1 : 0;
  }
  CHECK(both >= 4);
}

TEST_CASE("What is strong is named for what it is") {
  CHECK(count_detected(8, "NG", [](std::uint64_t seed) { return biased(seed); }) >= 7);
  CHECK(count_detected(8, "NW", [](std::uint64_t seed) { return warming(seed); }) == 8);
  CHECK(count_detected(8, "NR", [](std::uint64_t seed) { return log_with(seed, 0, 1e-3); }) >= 7);
  CHECK(count_detected(8, "NQ", [](std::uint64_t seed) { return log_with(seed, 0, 0, 2e-3); }) == 8);
  CHECK(count_detected(8, "NKQ", [](std::uint64_t seed) { return log_with(seed, 0.03, 0, 2e-3); }) >= 6);
}

TEST_CASE("A bias that forgets is neither a walk nor flicker noise") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const LogFit log(biased(seed), rate);
    const Selection selection(log.fit, NoiseTerms::all());
    INFO("seed " << seed << ": " << descriptions_of(selection));
    CHECK_FALSE(selection.detects(K));
    CHECK_FALSE(selection.detects(B));
    CHECK(selection.best().terms.has(G));
  }
}

TEST_CASE("Models cost their price, and are listed as promised") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const Values& y : {log_with(seed, 6e-4), biased(seed, 0.02), warming(seed, 0.02), log_with(seed, 0, 4e-5)}) {
      const LogFit log(y, rate);
      const Selection selection(log.fit, NoiseTerms::all());
      const auto best = selection.best_models(), descriptions = selection.descriptions();
      const double least = selection.best().cost;
      REQUIRE_FALSE(best.empty());
      REQUIRE_FALSE(descriptions.empty());
      CHECK(best.front().terms == selection.best().terms);
      for (const auto& models : {best, descriptions}) {
        double last = least;
        for (const Model& model : models) {
          INFO(symbols(model.terms));
          CHECK(model.cost >= last);
          last = model.cost;
          CHECK_THAT(model.cost - model.result.objective, WithinAbs(price(model.terms, 1), 1e-6));
        }
      }
      CHECK(best.back().cost < least + 3);
      CHECK(descriptions.back().cost <= least + 6);
      for (const Model& model : descriptions) {
        for (const Model& other : descriptions) {
          if (other.terms == model.terms) continue;
          INFO(symbols(model.terms) << " and " << symbols(other.terms));
          CHECK_FALSE(other.terms.within(model.terms));
          // A bias that forgets tends to a walk, unless that it does gains more than its time costs.
          if (model.terms.has(G) && other.cost <= model.cost + 3) {
            CHECK_FALSE(other.terms.without(K).within(model.terms));
          }
        }
        for (const NoiseTerm term : noise_terms) {
          if (term != K && selection.detects(term)) CHECK(model.terms.has(term));
        }
      }
    }
  }
}

TEST_CASE("A bias that forgets more slowly than the log shows counts as a walk") {
  int walks = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const LogFit log(biased(seed, 0.3, 400), rate);  // as long as the log
    const Selection selection(log.fit, NoiseTerms::all());
    INFO("seed " << seed << ": " << descriptions_of(selection));
    for (const Model& model : selection.descriptions()) CHECK(model.terms.has(K));
    walks += selection.detects(K) ? 1 : 0;
    // Without the walk it is what is left.
    const Selection without(log.fit, NoiseTerms::all().without(K));
    CHECK(without.best().terms.has(G));
  }
  CHECK(walks >= 6);
}

TEST_CASE("Only candidates are tried") {
  const std::vector<NoiseTerms> candidates{{N},          {N, K},       {N, B, G}, {N, R, W},
                                           {K, B, Q, R}, {N, K, Q, W}, {K, G, W}, {Q, R}};
  for (const NoiseTerms allowed : candidates) {
    for (const Values& y : {log_with(1, 0.01), biased(1), warming(1)}) {
      const LogFit log(y, rate);
      const Selection selection(log.fit, allowed);
      INFO("candidates " << symbols(allowed));
      CHECK(selection.best().terms.within(allowed));
      for (const Model& model : selection.best_models()) CHECK(model.terms.within(allowed));
      for (const Model& model : selection.descriptions()) CHECK(model.terms.within(allowed));
      for (const NoiseTerm term : noise_terms) {
        if (!allowed.has(term)) CHECK_FALSE(selection.detects(term));
      }
    }
  }
}

TEST_CASE("Some sets are no models") {
  // Whatever the log: a bias or a warm-up only beside white noise, one trend, two slow terms or a walk, flicker noise
  // and a trend.
  Values bias_alone(size), warm_walk = simulated({.n = size, .rate = rate, .walk = 0.01, .seed = 1});
  add_gauss_markov(bias_alone, rate, 0.06, 10, 1);
  add_warm_up(warm_walk, rate, 3, 20);
  for (const NoiseTerms candidates : {NoiseTerms::all(), NoiseTerms::all().without(N)}) {
    for (const Values& y :
         {bias_alone, warm_walk, biased(1, 0.02), warming(1, 0.02), log_with(1, 6e-4), log_with(1, 0, 4e-5, 1e-3)}) {
      const LogFit log(y, rate);
      const Selection selection(log.fit, candidates);
      auto models = selection.best_models();
      const auto descriptions = selection.descriptions();
      models.insert(models.end(), descriptions.begin(), descriptions.end());
      for (const Model& model : models) {
        INFO(symbols(model.terms));
        if (!model.terms.has(N)) {
          CHECK_FALSE(model.terms.has(G));
          CHECK_FALSE(model.terms.has(W));
        }
        CHECK_FALSE((model.terms.has(R) && model.terms.has(W)));
        int slow = 0;
        for (const NoiseTerm term : {K, B, R, G, W}) slow += model.terms.has(term) ? 1 : 0;
        CHECK(slow <= (model.terms.has(K) && model.terms.has(B) && !model.terms.has(G) ? 3 : 2));
        if (model.terms.has(W)) CHECK(model.result.times.decay <= log.pooled.duration());
      }
    }
  }
}

TEST_CASE("Each axis pays for its own trend") {
  std::vector<DifferenceSpectrum<double>> axes;
  for (const double sign : {1.0, -1.0, 2.0}) {
    axes.emplace_back(IntegratedSignal<double>(log_with(1, 0, 1e-3 * sign), rate));
  }
  const PooledSpectrum<double> pooled(axes);
  const SpectralFit<double> fit(pooled, std::vector<bool>(pooled.bins().size(), true));
  const Selection selection(fit, NoiseTerms::all());
  CHECK(symbols(selection.best().terms) == "NR");
  CHECK_THAT(selection.best().cost - selection.best().result.objective, WithinAbs(price({N, R}, 3), 1e-6));
}
