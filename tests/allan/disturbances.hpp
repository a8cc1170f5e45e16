// SPDX-License-Identifier: MIT
/// What real logs have beside the noise terms of simulated.hpp. Each function changes a signal in place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/random/normal.hpp>
#include <vector>

namespace splinertia::testing {

/// A stationary Gauss–Markov process with a standard deviation and a correlation time in s.
inline void add_gauss_markov(std::vector<double>& y, double rate, double deviation, double time, std::uint64_t seed) {
  NormalStream<> normal(StreamKey(seed) / 77);
  const double keep = std::exp(-1 / (rate * time)), fresh = deviation * std::sqrt(-std::expm1(-2 / (rate * time)));
  double state = deviation * normal();
  for (double& value : y) {
    value += state;
    state = keep * state + fresh * normal();
  }
}

/// height·exp(−t/time), time in s.
inline void add_warm_up(std::vector<double>& y, double rate, double height, double time) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += height * std::exp(-static_cast<double>(i) / (rate * time));
}

/// A sine with a frequency in Hz.
inline void add_line(std::vector<double>& y, double rate, double amplitude, double frequency) {
  const double step = 2 * std::numbers::pi * frequency / rate;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += amplitude * std::sin(step * static_cast<double>(i) + 0.3);
}

/// A resonance that white noise drives: an autoregressive process of order 2 whose poles have this frequency in Hz and
/// quality factor, scaled to the standard deviation (Box and Jenkins, "Time Series Analysis", 3.2.4).
inline void add_resonance(std::vector<double>& y, double rate, double frequency, double quality, double deviation,
                          std::uint64_t seed) {
  NormalStream<> normal(StreamKey(seed) / 78);
  const double angle = 2 * std::numbers::pi * frequency / rate, radius = std::exp(-angle / (2 * quality));
  const double a = 2 * radius * std::cos(angle), b = -radius * radius;
  const double fresh = deviation * std::sqrt((1 + b) * ((1 - b) * (1 - b) - a * a) / (1 - b));
  double last = 0, before = 0;
  const auto settle = static_cast<std::int64_t>(20 * quality * rate / frequency);
  for (std::int64_t i = -settle; i < static_cast<std::int64_t>(y.size()); ++i) {
    const double next = a * last + b * before + fresh * normal();
    before = last;
    last = next;
    if (i >= 0) y[static_cast<std::size_t>(i)] += next;
  }
}

/// A level that changes at a sample, at once or over `duration` samples.
inline void add_step(std::vector<double>& y, std::size_t sample, double height, std::size_t duration = 0) {
  for (std::size_t i = sample; i < y.size(); ++i) {
    y[i] += height * std::min(1.0, static_cast<double>(i - sample + 1) / static_cast<double>(duration + 1));
  }
}

/// One value for `length` samples.
inline void freeze(std::vector<double>& y, std::size_t sample, std::size_t length) {
  std::fill_n(y.begin() + static_cast<std::ptrdiff_t>(sample), length, y[sample]);
}

/// To multiples of a resolution.
inline void round_to(std::vector<double>& y, double resolution) {
  for (double& value : y) value = resolution * std::round(value / resolution);
}

/// A filter of first order: each output takes this share of its input.
inline void low_pass(std::vector<double>& y, double share) {
  for (std::size_t i = 1; i < y.size(); ++i) y[i] = y[i - 1] + share * (y[i] - y[i - 1]);
}

/// The power between two frequencies in Hz, both included, times a factor: the differences on sines, where each has one
/// frequency.
inline void scale_power(std::vector<double>& y, double rate, double lowest, double highest, double factor) {
  std::vector<double> differences;
  for (std::size_t i = 1; i < y.size(); ++i) differences.push_back(y[i] - y[i - 1]);
  auto b = allan::detail::sine_transform(differences);
  for (std::size_t k = 1; k <= b.size(); ++k) {
    const double frequency = static_cast<double>(k) * rate / static_cast<double>(2 * y.size());
    if (lowest <= frequency && frequency <= highest) b[k - 1] *= std::sqrt(factor);
  }
  differences = allan::detail::sine_transform(b);  // its own inverse
  for (std::size_t i = 1; i < y.size(); ++i) y[i] = y[i - 1] + differences[i - 1];
}

}  // namespace splinertia::testing
