// SPDX-License-Identifier: MIT
/// Rounding errors, against exact integers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/streaming.hpp>
#include <vector>

#include "../support/harness.hpp"
#include "logs.hpp"

namespace {

/// Σ over i = 0, stride … of the squared second differences.
long double exact_sum(const std::vector<std::int64_t>& phase, std::int64_t m, std::int64_t stride) {
  __extension__ using Integer = __int128;
  Integer sum = 0;
  const auto end = static_cast<std::int64_t>(phase.size()) - 2 * m;
  const std::int64_t* p = phase.data();
  for (std::int64_t i = 0; i < end; i += stride) {
    const std::int64_t difference = p[i + 2 * m] - 2 * p[i + m] + p[i];
    sum += static_cast<Integer>(difference) * difference;
  }
  return static_cast<long double>(sum);
}

int check_accuracy(bool csv, const Settings& settings) {
  constexpr double lsb = 1e-3, deviation = 1e-3, offset = 9.81;
  constexpr std::int64_t mean = 9810;
  constexpr double goal = 1e-9;
  const std::size_t n = settings.samples;
  std::vector<double> y(n);
  std::vector<std::int64_t> phase(n + 1);
  NormalStream<> normal(StreamKey(2) / "white");
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t k = std::llround((offset + deviation * normal()) / lsb);
    y[i] = static_cast<double>(k) * lsb;
    phase[i + 1] = phase[i] + (k - mean);
  }
  double worst = 0, worst_streaming = 0;
  if (!csv) std::printf("%zu samples of %g with noise of %g, LSB %g\n", n, offset, deviation, lsb);
  const auto compare = [&](const char* name, const DeviationPoint<double>& point, std::int64_t stride,
                           double& largest) {
    const long double sum = exact_sum(phase, point.factor, stride);
    const auto m = static_cast<long double>(point.factor);
    const long double exact =
        std::sqrt(sum / (2 * static_cast<long double>(point.terms))) / m * static_cast<long double>(lsb);
    const auto error = static_cast<double>(std::abs(static_cast<long double>(point.deviation) / exact - 1));
    largest = std::max(largest, error);
    if (!csv) {
      std::printf("%-10s m = %9lld: %.15g, relative error %.1e\n", name, static_cast<long long>(point.factor),
                  point.deviation, error);
    }
  };
  for (const auto& point : allan::overlapping(y, rate).points) compare("oadev", point, 1, worst);
  StreamingAllanDeviation<double> streaming(rate);
  for (const double value : y) streaming.push(value);
  for (const auto& point : streaming.curve().points)
    compare("streaming", point, std::max<std::int64_t>(1, point.factor / 16), worst_streaming);
  benchmark::figure(csv, "worst_error_oadev", worst, "1");
  benchmark::figure(csv, "worst_error_streaming", worst_streaming, "1");
  if (!csv) std::printf("worst relative error: oadev %.2e, streaming %.2e\n", worst, worst_streaming);
  return worst <= goal && worst_streaming <= goal ? 0 : 1;
}

}  // namespace
