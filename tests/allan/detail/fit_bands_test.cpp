// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/fit_bands.hpp>
#include <vector>

#include "allan/detail/chi_square_tails.hpp"
#include "allan/disturbances.hpp"
#include "allan/log_fit.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Bands = FitBands<double>;
using Octave = Bands::Octave;
constexpr std::size_t size = 20'000;
constexpr double rate = 50;

std::vector<double> white(std::uint64_t seed, std::size_t n = size) {
  return simulated({.n = n, .rate = rate, .white = 0.02, .seed = seed});
}

/// A log, white noise fitted to it and the comparison of the two.
struct Compared {
  explicit Compared(const std::vector<double>& y, double tolerance = 0)
      : log(y, rate),
        included(log.pooled.bins().size(), true),
        best(log.likelihood.maximise({NoiseTerm::white})),
        bands(log.fit, best, false, tolerance) {}

  [[nodiscard]] double probability() const { return Bands::probability(bands.octaves(included), 1, 0.0); }

  LogFit log;
  std::vector<bool> included;
  SpectralFit<double>::Result best;
  Bands bands;
};

/// An octave with a ratio of its power to the model's.
Octave octave(double count, double ratio) { return {{{1, 2}, ratio, std::sqrt(2 / count)}, count}; }

}  // namespace

TEST_CASE("Octaves are all bins, each in one") {
  Compared compared(white(1));
  const auto& bins = compared.log.pooled.bins();
  for (std::size_t i = 0; i < bins.size(); ++i) compared.included[i] = i % 7 != 3;
  const auto octaves = compared.bands.octaves(compared.included);
  double count = 0, expected = 0, above = rate;
  for (const Octave& octave : octaves) {
    const auto& band = octave.fit.frequencies;
    CHECK(band.upper >= band.lower);
    CHECK(band.upper <= 2 * band.lower);
    CHECK(band.upper < above);
    CHECK_THAT(octave.fit.standard_error, WithinRel(std::sqrt(2 / octave.count), 1e-12));
    double inside = 0, ratios = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (!compared.included[i] || bins[i].frequency < band.lower || bins[i].frequency > band.upper) continue;
      inside += bins[i].count;
      ratios += bins[i].power / (bins[i].basis[0] * compared.best.theta[0]);
    }
    CHECK(inside == octave.count);
    CHECK_THAT(octave.fit.ratio, WithinRel(ratios / inside, 1e-12));
    above = band.lower;
    count += octave.count;
  }
  for (std::size_t i = 0; i < bins.size(); ++i) expected += compared.included[i] ? bins[i].count : 0;
  CHECK(count == expected);
  CHECK(octaves.size() >= 13);  // of 20000 coefficients
  CHECK(octaves.size() <= 15);
}

TEST_CASE("An octave of which nothing is used is no octave") {
  Compared compared(white(1));
  const auto& bins = compared.log.pooled.bins();
  const std::size_t all = compared.bands.octaves(compared.included).size();
  for (std::size_t i = 0; i < bins.size(); ++i) compared.included[i] = bins[i].frequency < 3 || bins[i].frequency > 13;
  CHECK(compared.bands.octaves(compared.included).size() == all - 2);  // 3.1 to 6.2 and to 12.5 Hz
}

TEST_CASE("Good logs have probabilities that are spread evenly") {
  constexpr int logs = 60;
  double sum = 0, squares = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const double probability = Compared(white(seed, 3000)).probability();
    CHECK(probability > 1e-5);
    sum += probability / logs;
    squares += probability * probability / logs;
  }
  // Five standard errors of the means of p and p²: 1/√12 and √(4/45) of one.
  CHECK_THAT(sum, WithinAbs(0.5, 5 / std::sqrt(12.0 * logs)));
  CHECK_THAT(squares, WithinAbs(1.0 / 3, 5 * std::sqrt(4 / (45.0 * logs))));
}

TEST_CASE("Too little power in a few coefficients is a misfit as too much is") {
  // Two octaves of 48 coefficients together, where those above have some 20000.
  const double lowest = 15.5 * rate / (2 * size), highest = 63.5 * rate / (2 * size);
  for (const double factor : {0.1, 4.0}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      INFO(factor << " times the power, seed " << seed);
      auto y = white(seed);
      scale_power(y, rate, lowest, highest, factor);
      const Compared compared(y);
      CHECK(compared.probability() < 1e-3);
      const auto worst = compared.bands.worst(compared.included);
      CHECK(worst.begin < 40);
      CHECK(worst.end > 40);
      CHECK(worst.end <= 80);
      CHECK((worst.off > 0) == (factor > 1));
      CHECK(std::abs(worst.off) > 5);
    }
  }
}

TEST_CASE("The probability is that of the chi-square law") {
  // With one octave, the probability of a ratio as unlikely, up or down.
  for (const double count : {30.0, 1000.0}) {
    for (const double probability : {0.3, 0.01, 1e-3}) {
      const double above = chi_square_upper_quantile(probability / 2, count) / count;
      const double below = chi_square_quantile(probability / 2, count) / count;
      CHECK_THAT(Bands::probability({octave(count, above)}, 0.0, 0.0), WithinRel(probability, 0.15));
      CHECK_THAT(Bands::probability({octave(count, below)}, 0.0, 0.0), WithinRel(probability, 0.15));
    }
  }
  // Octaves that are right add freedom, parameters take it.
  const Octave off = octave(100, 1.5), right = octave(100, 1 - 2 / 900.0);
  const std::vector<Octave> three{off, right, right};
  CHECK(Bands::probability(three, 0.0, 0.0) > Bands::probability({off}, 0.0, 0.0));
  CHECK(Bands::probability(three, 2.0, 0.0) < Bands::probability(three, 0.0, 0.0));
  CHECK_THAT(Bands::probability(three, 9.0, 0.0), WithinRel(Bands::probability({off}, 0.0, 0.0), 0.01));
}

TEST_CASE("Within the tolerance a ratio is right") {
  CHECK(Bands::probability({octave(1e9, 1.004), octave(1e9, 0.996)}, 0.0, 0.005) == 1);
  CHECK(Bands::probability({octave(1e9, 1.004)}, 0.0, 0.0) < 1e-9);
  CHECK(Bands::probability({octave(1e9, 0.994)}, 0.0, 0.005) < 1e-9);
  CHECK(Bands::probability({octave(1e9, 1.006)}, 0.0, 0.005) < 1e-9);
  const Compared lenient(white(1), 1000.0);
  CHECK(lenient.bands.worst(lenient.included).off == 0);
}

TEST_CASE("The worst window is a line's bin, or a band, with too much or too little power") {
  // One coefficient, which has a bin of its own, with so much power that windows about it have too much as well, but
  // less significantly.
  auto line = white(4);
  const double ratio = Compared(line).bands.band(59, 60).ratio, frequency = 60 * rate / (2 * size);
  scale_power(line, rate, frequency * 0.999, frequency * 1.001, 25 / ratio);
  const Compared lined(line);
  const auto bin = lined.bands.worst(lined.included);
  CHECK(bin.begin == 59);
  CHECK(bin.end == 60);
  CHECK(bin.off > 4);

  // Half an octave.
  for (const double factor : {2.0, 0.5}) {
    auto band = white(4);
    scale_power(band, rate, 2, 2.83, factor);
    const Compared compared(band);
    const auto& bins = compared.log.pooled.bins();
    const auto window = compared.bands.worst(compared.included);
    INFO(factor << " times the power in a band");
    CHECK_THAT(bins[window.begin].frequency, WithinAbs(2, 0.2));
    CHECK_THAT(bins[window.end - 1].frequency, WithinAbs(2.83, 0.2));
    CHECK((window.off > 0) == (factor > 1));
    CHECK(std::abs(window.off) > 6);
  }
}

TEST_CASE("The worst window is one of what is included") {
  auto y = white(5);
  scale_power(y, rate, 2, 2.83, 3);
  scale_power(y, rate, 8, 9, 1.5);
  Compared compared(y);
  const auto& bins = compared.log.pooled.bins();
  for (std::size_t i = 0; i < bins.size(); ++i) {
    compared.included[i] = bins[i].frequency < 1.9 || bins[i].frequency > 3;
  }
  const auto window = compared.bands.worst(compared.included);
  CHECK_THAT(bins[window.begin].frequency, WithinAbs(8, 0.5));
  CHECK_THAT(bins[window.end - 1].frequency, WithinAbs(9, 0.5));
  for (auto&& used : compared.included) used = false;
  CHECK(compared.bands.worst(compared.included).off == 0);
}

TEST_CASE("Chance alone is no window") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Compared compared(white(seed, 3000));
    CHECK(std::abs(compared.bands.worst(compared.included).off) < 5.25);
  }
}

TEST_CASE("The spectrum of white noise is N at all frequencies") {
  Compared compared(white(6));
  const auto& bins = compared.log.pooled.bins();
  for (std::size_t i = 0; i < bins.size(); ++i) compared.included[i] = bins[i].frequency < 5 || bins[i].frequency > 6;
  const auto points = compared.bands.spectrum(compared.included);
  const double model = std::sqrt(compared.best.theta[0] / rate) * compared.log.pooled.unit();
  CHECK_THAT(model, WithinRel(0.02, 0.03));
  double count = 0, last = 0;
  for (const auto& point : points) {
    INFO(point.frequency << " Hz");
    CHECK_THAT(point.expected, WithinRel(model, 1e-12));
    const double square = point.density * point.density / (0.02 * 0.02) * point.count;
    CHECK(chi_square_cdf(square, point.count) > 1e-6);
    CHECK(chi_square_upper_tail(square, point.count) > 1e-6);
    CHECK(point.frequency > last);
    CHECK(point.used == (point.frequency < 5 || point.frequency > 6));
    count += point.count;
    last = point.frequency;
  }
  CHECK(count == static_cast<double>(compared.log.pooled.samples() - 1));
  // About eight an octave, where there are as many bins.
  const auto high =
      std::count_if(points.begin(), points.end(), [](const auto& point) { return point.frequency > rate / 32; });
  CHECK(high >= 4 * 8);
  CHECK(high <= 4 * 12);
}

TEST_CASE("The spectrum and a band have what is beside a trend") {
  auto y = simulated({.n = size, .rate = rate, .white = 0.02, .ramp = 0.01, .seed = 7});
  const LogFit log(y, rate);
  const auto best = log.likelihood.maximise({NoiseTerm::white, NoiseTerm::rate_ramp});
  const std::vector<bool> included(log.pooled.bins().size(), true);
  const Bands with(log.fit, best, true, 0), without(log.fit, best, false, 0);
  CHECK(Bands::probability(with.octaves(included), 1.0, 0.0) > 1e-4);
  CHECK(Bands::probability(without.octaves(included), 1.0, 0.0) < 1e-9);
  CHECK(with.spectrum(included).front().density < 0.1);
  CHECK(without.spectrum(included).front().density > 1);
}

TEST_CASE("A band has the ratio of its power to the model's") {
  auto y = white(8);
  scale_power(y, rate, 4, 6, 5);
  const Compared compared(y);
  const auto& bins = compared.log.pooled.bins();
  const auto at = [&](double frequency) {
    return static_cast<std::size_t>(
        std::count_if(bins.begin(), bins.end(), [&](const auto& bin) { return bin.frequency < frequency; }));
  };
  const auto band = compared.bands.band(at(4.1), at(5.9));
  // The model has the mean of all: 23 of 25 Hz as they were and 2 with five times the power.
  CHECK_THAT(band.ratio, WithinAbs(5 / 1.32, 5 * 5 * band.standard_error));
  CHECK_THAT(band.frequencies.lower, WithinAbs(4.1, 0.1));
  CHECK_THAT(band.frequencies.upper, WithinAbs(5.9, 0.1));
  CHECK_THAT(band.standard_error, WithinRel(std::sqrt(2 / (1.8 * 2 * size / rate)), 0.05));
}
