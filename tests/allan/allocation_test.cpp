// SPDX-License-Identifier: MIT
// What Allan analysis allocates: the running sums once, results and little else, and nothing for a sample of a stream.
#define EIGEN_RUNTIME_NO_MALLOC
#include <cstddef>
#include <cstdint>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/expected_accuracy.hpp>
#include <splinertia/allan/streaming.hpp>
#include <vector>

#include "allan/reference.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

TEST_CASE("Running sums are allocated once, as large as they become") {
  const auto y = scaled(noisy_integers(10'000, 100, 30, 0), 1.0f);
  const auto angles = scaled(phase_of(noisy_integers(10'000, 100, 30, 0)), 1.0);
  std::optional<IntegratedSignal<double>> signal;
  CHECK(allocations_of([&] { signal.emplace(y, 200.0); }) == 1);
  CHECK(signal->sums().capacity() == 10'001);
  CHECK(allocations_of([&] { signal = IntegratedSignal<double>::from_integral(angles, 200.0); }) == 1);
  CHECK(signal->sums().capacity() == 10'001);
}

TEST_CASE("Deviations allocate their results, and nothing in proportion to the log") {
  const IntegratedSignal signal(scaled(noisy_integers(100'000, 100, 30, 0), 1.0), 200.0);
  const IntegratedSignal longer(scaled(noisy_integers(300'000, 100, 30, 0), 1.0), 200.0);
  const std::vector<std::int64_t> factors{1, 2, 4, 8, 16, 48, 1000, 30'000};
  for_each_deviation([&]<typename D>() {
    std::vector<double> result;
    const std::size_t count = allocations_of([&] { result = deviations<D>(signal, factors); });
    CHECK(count <= 30);
    CHECK(allocations_of([&] { result = deviations<D>(longer, factors); }) == count);
  });
  DeviationCurve<double> result;
  const std::size_t count = allocations_of(
      [&] { result = curve<OverlappingAllanDeviation>(signal, {.factors = AveragingFactors::given(factors)}); });
  CHECK(count <= 60);
}

TEST_CASE("A stream allocates for an octave, not for a sample") {
  StreamingAllanDeviation<double> stream(200.0), limited(200.0, {}, 1 << 10);
  const auto y = scaled(noisy_integers(1 << 17, 100, 30, 0), 1.0f);
  std::size_t count = 0, last = 0, limited_count = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t one = allocations_of([&] { stream.push(y[i]); });
    limited_count += allocations_of([&] { limited.push(y[i]); });
    if (one > 0) last = i + 1;
    count += one;
  }
  CHECK(last == 1 << 16);  // samples; more follow at their double
  CHECK(count <= 17);
  CHECK(limited_count <= 6);
  // A copy of it has all that it keeps: about 600 bytes an octave.
  CHECK(allocations_of([&] { stream = limited; }) <= 1);
}

TEST_CASE("Expected accuracies allocate nothing") {
  double sum = 0;
  CHECK(allocations_of([&] { sum += expected_accuracy(200.0, 7200, 0.015, 5e-5).K; }) == 0);
  CHECK(allocations_of([&] { sum += duration_for_random_walk(200.0, 0.015, 5e-5, 0.1); }) == 0);
  CHECK(sum > 0);
}
