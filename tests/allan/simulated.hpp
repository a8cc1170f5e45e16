// SPDX-License-Identifier: MIT
/// Static logs whose noise terms are known.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <splinertia/random/normal.hpp>
#include <vector>

namespace splinertia::testing {

/// Coefficients in units of the signal and seconds, as of NoiseTerm.
struct SimulatedNoise {
  std::size_t n;
  double rate = 1;
  double white = 0, walk = 0, flicker = 0, quantization = 0, ramp = 0;
  std::uint64_t seed = 0;
  double mean = 0;
};

/// As the terms are defined, none with the help of the library's spectra. Flicker noise is a sum of Gauss–Markov
/// processes, two each octave of correlation time from half a sample to sixteen logs (van der Ziel, Physica 16 (1950)),
/// with variance B² ln 2/(2π) each: about B²/6 less in a sample than what identify() calls flicker noise has.
[[nodiscard]] inline std::vector<double> simulated(const SimulatedNoise& noise) {
  NormalStream<> normal(StreamKey(noise.seed) / noise.n);
  std::vector<double> y(noise.n);
  const double interval = 1 / noise.rate;
  double drift = noise.mean, error = noise.quantization * normal();
  for (std::size_t i = 0; i < noise.n; ++i) {
    const double next = noise.quantization * normal();
    y[i] = drift + noise.white * std::sqrt(noise.rate) * normal() + (next - error) * noise.rate +
           noise.ramp * interval * static_cast<double>(i);
    error = next;
    drift += noise.walk * std::sqrt(interval) * normal();
  }
  if (noise.flicker > 0) {
    const double deviation = noise.flicker * std::sqrt(std::numbers::ln2 / (2 * std::numbers::pi));
    for (double time = 0.5; time < 16 * static_cast<double>(noise.n); time *= std::numbers::sqrt2) {
      const double keep = std::exp(-1 / time), fresh = deviation * std::sqrt(1 - keep * keep);
      double state = deviation * normal();
      for (double& value : y) {
        value += state;
        state = keep * state + fresh * normal();
      }
    }
  }
  return y;
}

}  // namespace splinertia::testing
