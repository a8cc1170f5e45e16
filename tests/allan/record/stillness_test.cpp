// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <splinertia/allan/record/stillness.hpp>
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
  for (const auto& signal : {noise(1, 0), noise(1, 1e-3), noise(1, 1), noise(0, 1)}) {
    for (const std::int64_t length : {20, 200, 1000}) {
      const Stillness still = measure_stillness(signal, length);
      CHECK(still.blocks == 200050 / (length / 2) - 1);
      CHECK(still.disturbed == 0);
    }
  }
}

TEST_CASE("vibration and a coarse resolution are at rest") {
  for (const double resolution : {1.0, 2.0, 4.0, 6.0}) {
    auto signal = noise(1, 0);
    for (double& value : signal) value = resolution * std::round(value / resolution + 0.2);
    CHECK(measure_stillness(signal, 100).disturbed == 0);
  }
  auto signal = noise(1, 0);
  for (std::size_t i = 0; i < signal.size(); ++i) {
    signal[i] += 3 * std::sin(2 * std::numbers::pi * 0.003 * static_cast<double>(i));
  }
  CHECK(measure_stillness(signal, 100).disturbed == 0);
}

TEST_CASE("a knock and a turn are found") {
  auto signal = noise(1, 0);
  signal[70123] += 200;
  for (int i = 0; i < 50000; ++i) signal[static_cast<std::size_t>(150000 + i)] += 0.1 * std::min(i, 300);
  const Stillness still = measure_stillness(signal, 200);
  CHECK(still.disturbed == 2 + 4);  // the blocks are half over each other
  CHECK((still.worst == 70000 || still.worst == 70100));
  CHECK(still.worst_ratio > 50);
}

TEST_CASE("a knock is found wherever it begins") {
  struct Knock {
    double height;
    std::int64_t duration;
  };
  for (const Knock& knock : {Knock{14, 1}, Knock{20, 1}, Knock{8, 10}, Knock{5, 50}, Knock{5, 1000}}) {
    for (const std::int64_t begin : {70000, 70013, 70025, 70049, 70099}) {
      auto signal = noise(1, 0);
      for (std::int64_t i = 0; i < knock.duration; ++i) signal[static_cast<std::size_t>(begin + i)] += knock.height;
      INFO(knock.height << ' ' << knock.duration << ' ' << begin);
      const Stillness still = measure_stillness(signal, 100);
      CHECK(still.disturbed >= 1);
      CHECK(still.disturbed <= 6);
      CHECK(still.worst > begin - 100);
      CHECK(still.worst < begin + knock.duration);
    }
  }
}

TEST_CASE("noise that is twice as strong for a second is found") {
  auto signal = noise(1, 0);
  for (std::size_t i = 90050; i < 90150; ++i) signal[i] += 2.2 * (signal[i] - 1e6);
  const Stillness still = measure_stillness(signal, 100);
  CHECK(still.disturbed >= 1);
  CHECK(still.worst == 90050);
}

TEST_CASE("a fifth of the log in motion does not hide it") {
  auto signal = noise(1, 0);
  for (std::size_t i = 100000; i < 140000; ++i) signal[i] += 20 * std::sin(0.05 * static_cast<double>(i));
  const Stillness still = measure_stillness(signal, 200);
  CHECK(still.disturbed >= 399);
  CHECK(still.disturbed <= 401);
}

TEST_CASE("a resolution too coarse for the noise says nothing") {
  std::vector<float> signal(10000, 5.0F);
  signal[77] = 6;
  CHECK(measure_stillness(signal, 100).disturbed == 0);
  CHECK(measure_stillness(std::vector<double>{1, 2, 3}, 100).blocks == 0);
  CHECK(splinertia::test::error_of<std::invalid_argument>([&] { (void)measure_stillness(signal, 19); }) ==
        "measure_stillness: length is 19, expected at least 20 samples");
}
