// SPDX-License-Identifier: MIT
/// Whether axes have the same noise, as identify_pooled() tells.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/identify.hpp>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Spectra = std::vector<DifferenceSpectrum<double>>;
constexpr double rate = 50;

DifferenceSpectrum<double> axis(double white, double walk, std::uint64_t seed) {
  const auto y = simulated({.n = 6000, .rate = rate, .white = white, .walk = walk, .seed = seed});
  return DifferenceSpectrum<double>(IntegratedSignal<double>(y, rate));
}

}  // namespace

TEST_CASE("Axes that are alike agree, as often as chance says") {
  constexpr int logs = 40;
  int agree = 0;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    Spectra axes;
    for (std::uint64_t i = 0; i < 3; ++i) axes.push_back(axis(0.02, 0.02, 100 * seed + i));
    const double probability = identify_pooled<double>(axes).agreement_probability;
    agree += probability > 0.01 ? 1 : 0;
    sum += probability / logs;
  }
  // Five standard deviations of 1 % of 40 logs.
  CHECK(agree >= 36);
  CHECK_THAT(sum, WithinAbs(0.5, 5 / std::sqrt(12.0 * logs)));
}

TEST_CASE("Axes that differ do not agree") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const double different =
        identify_pooled<double>({axis(0.02, 0, seed), axis(0.08, 0, seed + 10), axis(0.03, 0, seed + 20)})
            .agreement_probability;
    CHECK(different < 1e-6);
    // By a tenth of white noise, and by a walk that one has.
    const double tenth =
        identify_pooled<double>({axis(0.02, 0.02, seed), axis(0.022, 0.02, seed + 10), axis(0.02, 0.02, seed + 20)})
            .agreement_probability;
    CHECK(tenth < 0.01);
    const double walk =
        identify_pooled<double>({axis(0.02, 0, seed), axis(0.02, 0, seed + 10), axis(0.02, 0.1, seed + 20)})
            .agreement_probability;
    CHECK(walk < 0.01);
  }
}

TEST_CASE("Each axis may have a ramp of its own and a unit of its own") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Spectra axes;
    double number = 0;
    for (const double ramp : {5e-3, -1e-2, 0.0}) {
      auto y = simulated({.n = 6000, .rate = rate, .white = 0.02, .ramp = ramp, .seed = seed + 10 * axes.size()});
      for (double& value : y) value += number;  // gravity on one
      number += 9.81;
      axes.emplace_back(IntegratedSignal<double>(y, rate));
    }
    const auto estimates = identify_pooled<double>(axes);
    CHECK(estimates.agreement_probability > 1e-3);
    CHECK(estimates.R.detected);
    CHECK_THAT(estimates.R.value, WithinRel(std::sqrt((25e-6 + 100e-6) / 3), 0.05));
  }
}

TEST_CASE("One axis agrees with itself") {
  CHECK(identify_pooled<double>({axis(0.02, 0.02, 1)}).agreement_probability == 1);
}

TEST_CASE("A common band is left out of all axes") {
  Spectra axes;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    auto y = simulated({.n = 6000, .rate = rate, .white = 0.02, .seed = seed});
    add_line(y, rate, 0.1, 5);
    axes.emplace_back(IntegratedSignal<double>(y, rate));
  }
  const auto estimates = identify_pooled<double>(axes);
  CHECK(estimates.fits);
  CHECK(estimates.agreement_probability > 1e-3);
  REQUIRE(estimates.excluded.size() == 1);
  CHECK_THAT(estimates.excluded[0].frequencies.lower, WithinAbs(5, 0.5));
  CHECK_THAT(estimates.excluded[0].frequencies.upper, WithinAbs(5, 0.5));
  CHECK_THAT(estimates.N.value, WithinRel(0.02, 0.03));
}
