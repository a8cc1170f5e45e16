// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/allan/record/freezes.hpp>
#include <splinertia/random/normal.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::allan;
using namespace splinertia::allan::detail;

namespace {

/// White noise with deviation 1 about a mean that walks slowly, each value held for some samples, rounded to multiples
/// of the resolution (0 for none).
std::vector<double> noise(double resolution, std::size_t held = 1, std::uint64_t seed = 0) {
  NormalStream<> normal(StreamKey(seed) / 1);
  std::vector<double> signal;
  double mean = 100 + 0.3 * resolution;
  while (signal.size() < 60000) {
    const double value = (mean += 1e-4 * normal()) + normal();
    signal.insert(signal.end(), held, resolution > 0 ? std::round(value / resolution) * resolution : value);
  }
  return signal;
}

void freeze(std::vector<double>& signal, std::size_t begin, std::size_t length) {
  std::fill_n(signal.begin() + static_cast<std::ptrdiff_t>(begin), length, signal[begin]);
}

}  // namespace

TEST_CASE("values that do not change because of the resolution, or are held, are no freeze") {
  for (const double resolution : {0.0, 0.3, 1.0, 2.0, 4.0, 6.0}) {
    for (const std::size_t held : {1U, 2U, 10U}) {
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        INFO(resolution << ' ' << held << ' ' << seed);
        CHECK(find_freezes(noise(resolution, held, seed)).empty());
      }
    }
  }
}

TEST_CASE("a freeze of half a second is found to the sample") {
  auto signal = noise(0);
  freeze(signal, 31415, 50);
  CHECK(find_freezes(signal) == std::vector<SampleSpan>{{31415, 31465}});
  signal[31464] += 1;
  CHECK(find_freezes(signal).empty());
}

TEST_CASE("freezes of any length are found, at the ends, too") {
  auto signal = noise(0.3);
  freeze(signal, 0, 100);
  freeze(signal, 5000, 300);
  freeze(signal, 20000, 20000);
  freeze(signal, 59000, 1000);
  const auto freezes = find_freezes(signal);
  REQUIRE(freezes.size() == 4);  // a neighbouring value may be the same by chance
  CHECK(freezes[0].begin == 0);
  CHECK_THAT(static_cast<double>(freezes[0].end), WithinAbs(100, 3));
  CHECK_THAT(static_cast<double>(freezes[1].begin), WithinAbs(5000, 3));
  CHECK_THAT(static_cast<double>(freezes[1].end), WithinAbs(5300, 3));
  CHECK_THAT(static_cast<double>(freezes[2].size()), WithinAbs(20000, 6));
  CHECK_THAT(static_cast<double>(freezes[3].begin), WithinAbs(59000, 3));
  CHECK(freezes[3].end == 60000);
}

TEST_CASE("with a coarse resolution, or held values, a freeze has to be longer") {
  struct Case {
    double resolution;
    std::size_t held, length;
  };
  for (const Case& some : {Case{2, 1, 400}, Case{4, 1, 2000}, Case{0, 10, 60}, Case{0.3, 10, 400}}) {
    auto signal = noise(some.resolution, some.held);
    freeze(signal, 30000, some.length);
    INFO(some.resolution << ' ' << some.held);
    const auto freezes = find_freezes(signal);
    REQUIRE(freezes.size() == 1);
    CHECK(freezes[0].begin <= 30000);
    CHECK(freezes[0].end >= 30000 + static_cast<std::int64_t>(some.length));
  }
}

TEST_CASE("a constant signal is a dead axis") {
  CHECK(is_constant(std::vector<float>(1000, 9.8F)));
  CHECK(is_constant(std::vector<double>{}));
  CHECK_FALSE(is_constant(std::vector<double>{1, 1, 2}));
  CHECK(find_freezes(std::vector<float>(1000, 9.8F)).empty());
  CHECK(find_freezes(std::vector<double>{}).empty());
}

TEST_CASE("runs of equal values are counted") {
  const auto runs = find_equal_runs(std::vector<int>{4, 4, 1, 2, 2, 2, 4}, 2);
  CHECK(runs.count == 4);
  CHECK(runs.longer == std::vector<SampleSpan>{{0, 2}, {3, 6}});
}
