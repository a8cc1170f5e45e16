// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/imu/stamp_jitter.hpp>

#include "imu/statistics.hpp"
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
  NormalStreams normals(StreamKey(1));
  Stamp<double> stamp{0.25, true, 0.005, false, 1};
  jitter.apply(stamp, normals);
  CHECK(stamp.offset == 0.25);
  CHECK(stamp.dropped);
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
