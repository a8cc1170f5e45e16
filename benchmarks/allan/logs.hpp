// SPDX-License-Identifier: MIT
/// What the parts of the benchmark program allan_analysis share: its settings, and simulated white noise.
#pragma once

#include <cstddef>
#include <filesystem>
#include <splinertia/random/normal.hpp>
#include <string>
#include <vector>

using namespace splinertia;
using namespace splinertia::allan;

namespace {

constexpr double rate = 200;  // Hz
constexpr std::size_t two_hours = 1'440'000;

struct Settings {
  std::size_t samples = 1'000'000;
  int repetitions = 9;
  bool huge = false;
  bool accuracy = false;
  bool statistics = false;
  int runs = 200;
  std::string only_case;
  std::filesystem::path written, analysed;
};

/// White noise about an offset.
std::vector<double> white_signal(std::size_t n) {
  NormalStream<> normal(StreamKey(1) / "white");
  std::vector<double> y(n);
  for (double& value : y) value = 9.81 + 0.01 * normal();
  return y;
}

}  // namespace
