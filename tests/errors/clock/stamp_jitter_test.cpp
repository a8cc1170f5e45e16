// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <vector>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

TEMPLATE_TEST_CASE("A million stamps are off by normal numbers of the given deviation", "", float, double) {
  using Scalar = TestType;
  const ErrorModel model{StampJitter{Scalar(1e-4)}};
  auto state = model.start(StreamKey(22) / "stamps");
  std::vector<double> z;
  bool dropped = false;
  for (std::size_t i = 0; i < million; ++i) {
    Stamp<Scalar> stamp{Scalar(0), false, Scalar(0.005), i == 0, Scalar(0)};
    model.apply(stamp, state);
    z.push_back(static_cast<double>(stamp.offset) / 1e-4);
    dropped = dropped || stamp.dropped;
  }
  CHECK(!dropped);
  CHECK(off(mean_product(z, std::vector<double>(million, 1.0))) < 4);
  for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(z, lag)) < 4);
}

TEST_CASE("Jitter adds to what the offset is before") {
  const StampJitter jitter{0.0};
  StateOf<StampJitter<double>> state(StreamKey(1));
  Stamp<double> stamp{0.25, true, 0.005, false, 1};
  jitter.apply(stamp, state);
  CHECK(stamp.offset == 0.25);
  CHECK(stamp.dropped);
}

namespace {

/// The offsets of `count` stamps in units of σ = ratio·h, h the interval.
std::vector<double> offsets(double ratio, std::size_t count, std::uint64_t seed = 5, bool irregular = false) {
  const ErrorModel model{StampJitter{ratio * 0.005}};
  auto state = model.start(StreamKey(seed));
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double interval = irregular && i % 3 == 0 ? 0.001 : 0.005;
    Stamp<double> stamp{0, false, interval, i == 0, 0};
    model.apply(stamp, state);
    if (i > 0) REQUIRE((stamp.offset - result.back() * ratio * 0.005) / interval > -0.99000001);
    result.push_back(stamp.offset / (ratio * 0.005));
  }
  return result;
}

double correlation(double ratio) { return ratio <= 0.25 ? 0 : 1 - 1 / (16 * ratio * ratio); }

}  // namespace

TEST_CASE("Jitter of any size keeps the order and has mean zero, its deviation and its normal law") {
  for (const double ratio : {0.05, 0.1, 0.2, 0.25, 0.3, 0.5, 1.0, 2.0, 3.0, 5.0}) {
    CAPTURE(ratio);
    const std::vector<double> z = offsets(ratio, million);
    const double rho = correlation(ratio);
    const auto C = [rho](std::size_t lag) { return std::pow(rho, static_cast<double>(lag)); };
    const auto reach = static_cast<std::size_t>(rho == 0 ? 1 : 20 / (1 - rho));
    const double mean = std::accumulate(z.begin(), z.end(), 0.0) / million;
    CHECK(std::abs(mean) < 4 * std::sqrt((1 + rho) / (1 - rho) / million));
    CHECK(off(autocovariance(z, C, 0, reach)) < 4);
    const auto beyond = [&](double limit) {
      return static_cast<double>(std::count_if(z.begin(), z.end(), [limit](double x) { return std::abs(x) > limit; })) /
             million;
    };
    for (const double limit : {1.0, 2.0, 3.0}) {
      const double expected = std::erfc(limit / std::sqrt(2.0));
      CHECK(std::abs(beyond(limit) / expected - 1) < 4 * std::sqrt((1 + rho) / (1 - rho) / (million * expected)));
    }
  }
}

TEST_CASE("Neighbours of jitter are correlated no more than their order asks for") {
  for (const double ratio : {0.05, 0.1, 0.15}) CHECK(off(white_autocovariance(offsets(ratio, million), 1)) < 4);
  for (const double ratio : {0.2, 0.25, 0.5, 1.0, 3.0}) {
    CAPTURE(ratio);
    const std::vector<double> z = offsets(ratio, million);
    double squares = 0;
    for (std::size_t i = 1; i < z.size(); ++i) squares += std::pow(z[i] - z[i - 1], 2);
    // Steps in units of h; those that are not made are the largest.
    const double step = ratio * std::sqrt(squares / million);
    CHECK(step < std::sqrt(2.0) * std::min(ratio, 0.25));
    CHECK(step > 0.97 * std::sqrt(2.0) * std::min(ratio, 0.25));
  }
}

TEST_CASE("The law of jitter is the same whatever the intervals") {
  for (const double ratio : {0.1, 0.5, 2.0}) {
    CAPTURE(ratio);
    const std::vector<double> z = offsets(ratio, million, 7, true);
    const double mean = std::accumulate(z.begin(), z.end(), 0.0) / million;
    // Every third step is a fifth as long, and is refused for being too long up to half of the time.
    const double reach = 4 * 16 * ratio * ratio + 4;
    CHECK(std::abs(mean) < 4 * std::sqrt(2 * reach / million));
    const double squares = std::inner_product(z.begin(), z.end(), z.begin(), 0.0) / million;
    CHECK(std::abs(squares - 1) < 4 * std::sqrt(2 * reach / million));
  }
}

TEST_CASE("Small jitter is the normal numbers of its stream") {
  const StampJitter jitter{0.0005};
  StateOf<StampJitter<double>> state(StreamKey(3));
  NormalStreams normals(StreamKey(3));
  for (int i = 0; i < 1000; ++i) {
    Stamp<double> stamp{0, false, 0.005, i == 0, 0};
    jitter.apply(stamp, state);
    REQUIRE(std::abs(stamp.offset - 0.0005 * normals.draw_one()) < 1e-18);
  }
}

TEST_CASE("Jitter is the same for the same seed, another for another") {
  CHECK(offsets(2, 1000, 1) == offsets(2, 1000, 1));
  CHECK(offsets(2, 1000, 1) != offsets(2, 1000, 2));
}

TEST_CASE("A deviation of stamps is a number") {
  STATIC_CHECK(std::is_same_v<decltype(StampJitter{0.1F}), StampJitter<float>>);
  STATIC_CHECK(std::is_same_v<decltype(StampJitter{0.1}), StampJitter<double>>);
  STATIC_CHECK(std::is_same_v<decltype(StampJitter{1}), StampJitter<double>>);
}

TEST_CASE("A deviation of stamps that is none is refused") {
  CHECK_THROWS_WITH(StampJitter{-1e-3}, "StampJitter: standard deviation is -0.001, expected a finite number >= 0");
  CHECK_THROWS_WITH(StampJitter{std::nan("")}, "StampJitter: standard deviation is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(StampJitter{std::numeric_limits<double>::infinity()},
                    "StampJitter: standard deviation is inf, expected a finite number >= 0");
}
