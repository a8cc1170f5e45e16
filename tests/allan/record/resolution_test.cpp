// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/allan/record/resolution.hpp>
#include <splinertia/random/normal.hpp>
#include <stdexcept>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::allan;

namespace {

/// White noise with deviation 1 about a mean, rounded to multiples of the resolution and then to those of `text`.
std::vector<double> noise(double mean, double resolution, double text = 0) {
  NormalStream<> normal(StreamKey(5) / 1);
  std::vector<double> signal;
  for (int i = 0; i < 50000; ++i) {
    double value = std::round((mean + normal()) / resolution) * resolution;
    if (text > 0) value = std::round(value / text) * text;
    signal.push_back(value);
  }
  return signal;
}

double standard_deviation(const std::vector<double>& signal) {
  double sum = 0, squares = 0;
  for (const double value : signal) {
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(signal.size());
  return std::sqrt(squares / n - sum / n * (sum / n));
}

}  // namespace

TEST_CASE("the resolution of a signal is found") {
  for (const double resolution : {0.003, 0.01, 0.1, 0.3, 1.0, 3.0, 6.0}) {
    const auto found = find_resolution(noise(2.7, resolution));
    INFO(resolution);
    REQUIRE(found.has_value());
    CHECK_THAT(*found, WithinRel(resolution, 1e-9));
  }
}

TEST_CASE("the resolution is found after text has rounded its values") {
  for (const double resolution : {0.01, 0.1, 0.3, 1.0}) {
    for (const double text : {0.013, 0.11, 0.19}) {
      const auto found = find_resolution(noise(9.8, resolution, text * resolution));
      INFO(resolution << ' ' << text);
      REQUIRE(found.has_value());
      CHECK_THAT(*found, WithinRel(resolution, 0.03));
    }
  }
}

TEST_CASE("a stray value does not hide the resolution") {
  auto signal = noise(2.7, 0.5);
  for (std::size_t i = 0; i < signal.size(); i += 500) signal[i] = 0.123;
  const auto found = find_resolution(signal);
  REQUIRE(found.has_value());
  CHECK_THAT(*found, WithinRel(0.5, 0.03));
}

TEST_CASE("there is no resolution without equally spaced values") {
  NormalStream<> normal(StreamKey(5) / 2);
  std::vector<double> signal;
  for (int i = 0; i < 20000; ++i) signal.push_back(normal());
  CHECK_FALSE(find_resolution(signal).has_value());
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = signal[i - i % 10];  // held
  CHECK_FALSE(find_resolution(signal).has_value());
  CHECK_FALSE(find_resolution(std::vector<double>(1000, 1.5)).has_value());
  CHECK_FALSE(find_resolution(std::vector<double>{}).has_value());
}

TEST_CASE("what rounding does to N, at once with what it is said to do") {
  struct Case {
    double resolution, on_value, half_way;  // deviation after rounding, of 1 before
    RoundingEffect effect;
  };
  for (const Case& some :
       {Case{0.3, 1.004, 1.004, RoundingEffect::none}, Case{1, 1.041, 1.041, RoundingEffect::slight},
        Case{1.9, 1.131, 1.150, RoundingEffect::slight}, Case{2.5, 1.151, 1.311, RoundingEffect::invalid},
        Case{4, 0.853, 2.0, RoundingEffect::invalid}, Case{6, 0.312, 3.0, RoundingEffect::invalid}}) {
    const double on_value = standard_deviation(noise(0, some.resolution));
    const double half_way = standard_deviation(noise(some.resolution / 2, some.resolution));
    INFO(some.resolution);
    CHECK_THAT(on_value, WithinRel(some.on_value, 0.02));
    CHECK_THAT(half_way, WithinRel(some.half_way, 0.02));
    CHECK(rounding_effect(some.resolution, on_value) == some.effect);
    CHECK(rounding_effect(some.resolution, half_way) == some.effect);
    if (some.effect == RoundingEffect::invalid) continue;
    CHECK_THAT(white_noise_before_rounding(on_value / 10, some.resolution, 100), WithinRel(0.1, 0.03));
    CHECK_THAT(white_noise_before_rounding(half_way / 10, some.resolution, 100), WithinRel(0.1, 0.03));
  }
  CHECK(white_noise_before_rounding(0.01, 1, 100) == 0);
}

TEST_CASE("bad input to the effect of rounding") {
  using splinertia::test::error_of;
  CHECK(error_of<std::invalid_argument>([] { (void)rounding_effect(-1, 1); }) ==
        "rounding_effect: resolution is -1, expected a finite number >= 0");
  CHECK(error_of<std::invalid_argument>([] { (void)rounding_effect(1, NAN); }) ==
        "rounding_effect: deviation is nan, expected a finite number >= 0");
  CHECK(error_of<std::invalid_argument>([] { (void)white_noise_before_rounding(1, 1, 0); }) ==
        "white_noise_before_rounding: rate is 0, expected a finite number > 0");
}
