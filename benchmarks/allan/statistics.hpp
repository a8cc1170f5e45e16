// SPDX-License-Identifier: MIT
/// How far estimates of noise terms are from the truth, beside the least that any estimate could be.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/expected_accuracy.hpp>
#include <splinertia/allan/fit_curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/bias_instability.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "../support/harness.hpp"
#include "logs.hpp"

using Signals = std::array<std::vector<double>, 3>;

namespace {

struct Case {
  const char* name;
  double N, K, B;
  [[nodiscard]] double truth(NoiseTerm term) const {
    return std::array<double, 5>{N, K, B, 0, 0}[static_cast<std::size_t>(term)];
  }
};

constexpr std::array<Case, 9> cases{{{"N15e3_K5e5", 0.015, 5e-5, 0},
                                     {"N5e3_K1e5", 0.005, 1e-5, 0},
                                     {"N19e3_K5e4", 0.019, 5e-4, 0},
                                     {"N19e3_K1e4", 0.019, 1e-4, 0},
                                     {"N3e4_K1e4", 3e-4, 1e-4, 0},
                                     {"N15e3_K1e5", 0.015, 1e-5, 0},
                                     {"N5e3_B1e3", 0.005, 0, 1e-3},
                                     {"N5e3_K1e4_B1e3", 0.005, 1e-4, 1e-3},
                                     {"N5e3", 0.005, 0, 0}}};

template <typename... Terms>
Signals simulate_terms(const ErrorModel<Terms...>& model, std::size_t n, std::uint64_t seed) {
  using Vector = Eigen::Vector3d;
  auto state = model.start(StreamKey(seed) / "gyro");
  Signals signals;
  for (auto& signal : signals) signal.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    SensorSample<double> sample{Vector::Zero(), Vector::Zero(), 1 / rate, i == 0, static_cast<double>(i) / rate};
    model.apply(sample, state);
    for (std::size_t axis = 0; axis < 3; ++axis) signals[axis][i] = sample.value[static_cast<Eigen::Index>(axis)];
  }
  return signals;
}

Signals simulate_case(const Case& of, std::size_t n, std::uint64_t seed) {
  const WhiteNoise white{of.N};
  const RandomWalk walk{of.K};
  if (of.B > 0) return simulate_terms(ErrorModel{white, walk, BiasInstability{of.B}}, n, seed);
  return simulate_terms(ErrorModel{white, walk}, n, seed);
}

struct Estimates {
  std::array<NoiseEstimates<double>, 3> identified, fitted;  // one for each axis
};

/// All runs of a case, on two processors.
std::vector<Estimates> estimate_case(const Case& of, std::size_t n, int runs, std::uint64_t first_seed) {
  std::vector<Estimates> results(static_cast<std::size_t>(runs));
  std::atomic<std::size_t> next = 0;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto work = [&] {
    for (std::size_t run; (run = next++) < results.size();) {
      const Signals signals = simulate_case(of, n, first_seed + run);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const IntegratedSignal x(signals[axis], rate);
        results[run].identified[axis] = identify(x);
        results[run].fitted[axis] = fit_curve(curve<OverlappingAllanDeviation>(x));
      }
      if (terminal) std::fprintf(stderr, "\r%s: run %zu of %d ", of.name, run + 1, runs);
    }
  };
  std::thread other(work);
  work();
  other.join();
  if (terminal) std::fprintf(stderr, "\r%40s\r", "");
  return results;
}

/// Of one coefficient over all logs, in units of the truth.
void print_estimates(bool csv, const std::string& name, double truth, const std::vector<Estimate<double>>& estimates,
                     std::optional<double> bound) {
  const auto n = static_cast<double>(estimates.size());
  double sum = 0, squares = 0, detected = 0, one = 0, wide = 0, limits = 0, undetected_limits = 0;
  for (const auto& estimate : estimates) {
    if (estimate.detected) ++detected;
    if (truth <= 0) continue;
    sum += estimate.value / truth;
    squares += (estimate.value / truth) * (estimate.value / truth);
    if (estimate.one_sigma.lower <= truth && truth <= estimate.one_sigma.upper) ++one;
    if (estimate.interval.lower <= truth && truth <= estimate.interval.upper) ++wide;
    if (truth <= estimate.interval.upper) ++limits;
    if (truth <= estimate.interval.upper && !estimate.detected) ++undetected_limits;
  }
  benchmark::figure(csv, name + "_detected", detected / n, "1");
  if (truth <= 0) {
    if (!csv) std::printf("  %-24s not there, detected in %.1f %%\n", name.c_str(), 100 * detected / n);
    return;
  }
  const double mean = sum / n, spread = std::sqrt(std::max(0.0, squares / n - mean * mean) * n / (n - 1));
  benchmark::figure(csv, name + "_mean", mean, "1");
  benchmark::figure(csv, name + "_std", spread, "1");
  if (bound) benchmark::figure(csv, name + "_std_over_bound", spread / *bound, "1");
  benchmark::figure(csv, name + "_within_one_sigma", one / n, "1");
  benchmark::figure(csv, name + "_within_95", wide / n, "1");
  benchmark::figure(csv, name + "_limits_hold", limits / n, "1");
  if (csv) return;
  std::printf("  %-24s mean %.4f +- %.5f", name.c_str(), mean, spread);
  bound ? std::printf(" (%.3f of the bound)", spread / *bound) : std::printf("%21s", "");
  std::printf(", within 1 sigma %.1f %%, 95 %%: %.1f %%, detected %.1f %%, limits hold %.1f %%", 100 * one / n,
              100 * wide / n, 100 * detected / n, 100 * limits / n);
  if (detected < n) std::printf(", of undetected %.1f %%", 100 * undetected_limits / (n - detected));
  std::printf("\n");
}

void print_statistics(bool csv, const Settings& settings) {
  const std::size_t n = settings.samples;
  const double duration = static_cast<double>(n) / rate;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case& of = cases[k];
    if (std::string_view(of.name).find(settings.only_case) == std::string_view::npos) continue;
    const auto results = estimate_case(of, n, settings.runs, 1'000'000 * k);
    if (!csv) {
      std::printf("N = %g, K = %g, B = %g: %d logs of %.2f h at %g Hz\n", of.N, of.K, of.B, 3 * settings.runs,
                  duration / 3600, rate);
    }
    for (const auto& [how, which] :
         {std::pair("identify", &Estimates::identified), std::pair("fit_curve", &Estimates::fitted)}) {
      for (const NoiseTerm term : noise_terms) {
        std::vector<Estimate<double>> estimates;
        for (const Estimates& result : results) {
          for (const auto& axis : result.*which) estimates.push_back(axis[term]);
        }
        std::optional<double> bound;
        if (of.K > 0 && of.B <= 0) {
          const auto expected = expected_accuracy(rate, duration, of.N, of.K);
          if (term == NoiseTerm::white) bound = expected.N;
          if (term == NoiseTerm::random_walk) bound = expected.K;
        }
        const std::string prefix = csv ? std::string(of.name) + "_" : std::string();
        print_estimates(csv, prefix + how + "_" + std::string(symbol(term)), of.truth(term), estimates, bound);
      }
    }
    std::fflush(stdout);
  }
}

}  // namespace
