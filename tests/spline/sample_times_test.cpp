// SPDX-License-Identifier: MIT
#include <splinertia/spline/sample_times.hpp>

#include <chrono>
#include <cmath>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

TEST_CASE("times are counted from the start") {
  const SampleTimes<double> times{2.0, 0.25};
  CHECK(times(0) == 2.0);
  CHECK(times(9) == 4.25);
  CHECK(times.intervals(1.0) == 4.0);
  const SampleTimes epoch{nanoseconds(1'700'000'000'000'000'001), nanoseconds(5'000'000)};
  CHECK(epoch(200) == nanoseconds(1'700'000'001'000'000'001));
  CHECK(epoch.intervals(nanoseconds(10'000'000)) == 2.0);
}

TEST_CASE("times in lanes are the same") {
  using L = NativeSimdPack<double>;
  const SampleTimes<double> times{1.0 / 3, 1.0 / 7};
  double lanes[L::size];
  times.lanes<L>(5).store(lanes);
  // Both are one product and one sum, or one rounding of both.
  for (std::size_t i = 0; i < L::size; ++i) CHECK(std::abs(lanes[i] - times(5 + i)) <= 1e-15);
#if !defined(__FMA__) && !defined(__ARM_FEATURE_FMA)
  for (std::size_t i = 0; i < L::size; ++i) CHECK(lanes[i] == times(5 + i));
#endif
}

TEST_CASE("what is wrong with times is said") {
  const auto checked = [](double start, double interval, std::size_t count) {
    check_sample_times(SampleTimes<double>{start, interval}, count, 0.0, 1.0);
  };
  CHECK_NOTHROW(checked(0, 0.001, 1001));
  CHECK_NOTHROW(checked(0, 0.1, 0));
  CHECK_NOTHROW(checked(0.5, 10, 1));
  CHECK_NOTHROW(checked(0.7, 0.1, 4));  // 1.0000000000000002 by rounding alone
  CHECK_THROWS_WITH(checked(0, 0, 2), "sample: interval is 0, expected a positive finite number");
  CHECK_THROWS_AS(checked(0, -1, 2), std::invalid_argument);
  CHECK_THROWS_AS(checked(0, NAN, 2), std::invalid_argument);
  CHECK_THROWS_AS(checked(0, INFINITY, 2), std::invalid_argument);
  CHECK_THROWS_WITH(checked(0, 0.5, 4), "sample: 4 samples from 0 to 1.5, the curve is defined from 0 to 1");
  CHECK_THROWS_AS(checked(-0.1, 0.1, 2), std::out_of_range);
  CHECK_THROWS_AS(checked(NAN, 0.1, 2), std::out_of_range);
  CHECK_THROWS_AS(
      check_sample_times(SampleTimes{nanoseconds(0), nanoseconds(10)}, 12, nanoseconds(0), nanoseconds(109)),
      std::out_of_range);
}
