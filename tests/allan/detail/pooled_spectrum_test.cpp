// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <vector>

#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Spectrum = DifferenceSpectrum<double>;

Spectrum spectrum_of(const std::vector<double>& y, double rate) { return Spectrum(IntegratedSignal<double>(y, rate)); }

}  // namespace

TEST_CASE("Powers of several spectra add up in the largest unit") {
  const double rate = 20;
  const auto y = simulated({.n = 3000, .rate = rate, .white = 1, .walk = 0.1, .seed = 1});
  auto large = simulated({.n = 3000, .rate = rate, .white = 300, .seed = 2});
  const std::vector<Spectrum> spectra{spectrum_of(y, rate), spectrum_of(large, rate)};
  const PooledSpectrum<double> pooled(spectra);
  CHECK(pooled.unit() == spectra[1].unit());
  CHECK(pooled.unit() > spectra[0].unit());
  CHECK(pooled.rate() == rate);
  CHECK(pooled.samples() == spectra[0].samples());
  CHECK(pooled.duration() == static_cast<double>(pooled.samples()) / rate);
  CHECK(pooled.spectra() == 2);
  REQUIRE(pooled.bins().size() == spectra[0].bins().size());
  double count = 0;
  for (std::size_t i = 0; i < pooled.bins().size(); ++i) {
    const auto& bin = pooled.bins()[i];
    const auto &one = spectra[0].bins()[i], &other = spectra[1].bins()[i];
    const double power =
        one.power * spectra[0].unit() * spectra[0].unit() + other.power * spectra[1].unit() * spectra[1].unit();
    CHECK(bin.frequency == one.frequency);
    CHECK_THAT(bin.power * pooled.unit() * pooled.unit(), WithinRel(power, 1e-13));
    CHECK(bin.count == one.count + other.count);
    CHECK(bin.odd_count + bin.even_count == one.count);
    CHECK(bin.ramp_square == one.ramp_square);
    for (std::size_t j = 0; j < Spectrum::powers; ++j) {
      CHECK(bin.basis[static_cast<Eigen::Index>(j)] == one.basis[j]);
    }
    count += bin.count;
  }
  CHECK(count == 2 * (static_cast<double>(pooled.samples()) - 1));
}

TEST_CASE("Trends of several spectra stay apart") {
  const auto y = simulated({.n = 2000, .rate = 20, .white = 1, .ramp = 0.1, .seed = 3});
  auto turned = y;
  for (double& value : turned) value *= -4;
  const std::vector<Spectrum> spectra{spectrum_of(y, 20), spectrum_of(turned, 20)};
  const PooledSpectrum<double> pooled(spectra);
  REQUIRE(pooled.trend_sums().size() == 2);
  for (std::size_t i = 0; i < pooled.bins().size(); ++i) {
    const auto &one = pooled.trend_sums()[0][i], &other = pooled.trend_sums()[1][i];
    // In one unit, they have the ratio that the signals have.
    CHECK_THAT(other.ramp_product, WithinAbs(-4 * one.ramp_product, 1e-12 * (1 + std::abs(one.ramp_product))));
    CHECK_THAT(other.odd, WithinAbs(-4 * one.odd, 1e-12 * (1 + std::abs(one.odd))));
    CHECK_THAT(other.even, WithinAbs(-4 * one.even, 1e-12 * (1 + std::abs(one.even))));
  }
}

TEST_CASE("A bin of several coefficients has the sums that its trend means say") {
  constexpr std::size_t n = 3000;
  const double rate = 5;
  for (const double decay : {4.0, 60.0, 1e5}) {
    std::vector<double> y{0};
    for (std::size_t i = 0; i + 1 < n; ++i) {
      y.push_back(y.back() + std::exp(-static_cast<double>(i) / (rate * decay)));
    }
    const std::vector<Spectrum> spectra{spectrum_of(y, rate)};
    const PooledSpectrum<double> pooled(spectra);
    REQUIRE(pooled.samples() == n);
    std::size_t shared = 0;
    for (std::size_t i = 0; i < pooled.bins().size(); ++i) {
      const auto& bin = pooled.bins()[i];
      if (bin.frequency > rate / 4) break;
      if (bin.count > 1) ++shared;
      const auto means = pooled.trend_means(bin, decay);
      const auto& sums = pooled.trend_sums()[0][i];
      // The mean at a bin's centre and the mean over the bin differ by the square of its relative width, 1/64 at most.
      const double odd = bin.odd_count * means.odd / pooled.unit(), even = bin.even_count * means.even / pooled.unit();
      CHECK_THAT(sums.odd, WithinAbs(odd, 0.01 * std::abs(odd) + 1e-9));
      CHECK_THAT(sums.even, WithinAbs(even, 0.01 * std::abs(even) + 1e-9));
    }
    CHECK(shared > 50);
  }
}
