// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/errors/clock/dropped_samples.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

namespace {

template <typename Scalar>
std::vector<bool> drops(double probability, std::size_t n = million) {
  const ErrorModel model{DroppedSamples{static_cast<Scalar>(probability)}};
  auto state = model.start(StreamKey(23) / "stamps");
  std::vector<bool> result;
  for (std::size_t i = 0; i < n; ++i) {
    Stamp<Scalar> stamp{Scalar(0), false, Scalar(0.005), i == 0, Scalar(0)};
    model.apply(stamp, state);
    result.push_back(stamp.dropped);
  }
  return result;
}

}  // namespace

TEMPLATE_TEST_CASE("Of a million samples the given part is dropped, each whatever became of the others", "", float,
                   double) {
  for (const double p : {0.001, 0.1, 0.5, 0.97}) {
    // Scaled to mean 0 and variance 1: not Gaussian, but means and products of different ones have the same errors.
    std::vector<double> z;
    for (const bool dropped : drops<TestType>(p)) z.push_back(((dropped ? 1 : 0) - p) / std::sqrt(p * (1 - p)));
    CHECK(off(mean_product(z, std::vector<double>(million, 1.0))) < 4);
    for (const std::size_t lag : {1U, 2U, 3U}) CHECK(off(white_autocovariance(z, lag)) < 4);
  }
}

TEMPLATE_TEST_CASE("With probability zero none is dropped, and short of one a few are not", "", float, double) {
  const auto count = [](const std::vector<bool>& x) { return std::count(x.begin(), x.end(), true); };
  CHECK(count(drops<TestType>(0)) == 0);
  CHECK(count(drops<TestType>(0x1p-24)) < 3);
  CHECK(count(drops<TestType>(1 - 0x1p-10)) < 999'500);
}

TEST_CASE("What was dropped before stays dropped, and the stamp as it is") {
  const DroppedSamples term{0.0};
  NormalStreams random(StreamKey(1));
  Stamp<double> stamp{0.25, true, 0.005, false, 1};
  term.apply(stamp, random);
  CHECK(stamp.dropped);
  CHECK(stamp.offset == 0.25);
}

TEST_CASE("A probability is a number") {
  STATIC_CHECK(std::is_same_v<decltype(DroppedSamples{0.1F}), DroppedSamples<float>>);
  STATIC_CHECK(std::is_same_v<decltype(DroppedSamples{0}), DroppedSamples<double>>);
}

TEST_CASE("A probability that is none is refused") {
  CHECK_THROWS_WITH(DroppedSamples{-0.1}, "DroppedSamples: probability is -0.1, expected a number >= 0 and < 1");
  CHECK_THROWS_WITH(DroppedSamples{1}, "DroppedSamples: probability is 1, expected a number >= 0 and < 1");
  CHECK_THROWS_WITH(DroppedSamples{std::nan("")}, "DroppedSamples: probability is nan, expected a number >= 0 and < 1");
  CHECK_THROWS_WITH(DroppedSamples{std::numeric_limits<float>::infinity()},
                    "DroppedSamples: probability is inf, expected a number >= 0 and < 1");
}
