// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>
#include <splinertia/allan/stillness.hpp>
#include <stdexcept>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;

namespace {

/// White noise and a random walk about a large mean.
std::vector<double> noise(double white, double walk) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> signal;
  double bias = 1e6;
  for (int i = 0; i < 200050; ++i) signal.push_back((bias += walk * normal(random)) + white * normal(random));
  return signal;
}

}  // namespace

TEST_CASE("noise is at rest, whether it is white or a walk") {
  for (const auto& signal : {noise(1, 0), noise(1, 1e-3), noise(0, 1)}) {
    const Stillness still = measure_stillness(signal, 200);
    CHECK(still.blocks == 1000);
    CHECK(still.disturbed == 0);
  }
}

TEST_CASE("a knock and a turn are found") {
  auto signal = noise(1, 0);
  signal[70123] += 200;
  for (int i = 0; i < 50000; ++i) signal[static_cast<std::size_t>(150000 + i)] += 0.1 * std::min(i, 300);
  const Stillness still = measure_stillness(signal, 200);
  CHECK(still.disturbed == 2);
  CHECK(still.worst == 70000);
  CHECK_THAT(still.worst_ratio, WithinRel(std::sqrt(1 + 200.0), 0.1));
}

TEST_CASE("a resolution too coarse for the noise says nothing") {
  std::vector<float> signal(10000, 5.0F);
  signal[77] = 6;
  CHECK(measure_stillness(signal, 100).disturbed == 0);
  CHECK(measure_stillness(std::vector<double>{1, 2, 3}, 100).blocks == 0);
  CHECK(splinertia::test::error_of<std::invalid_argument>([&] { (void)measure_stillness(signal, 19); }) ==
        "measure_stillness: length is 19, expected at least 20 samples");
}
