// SPDX-License-Identifier: MIT
#include <splinertia/io/stamp_unit.hpp>
#include <string_view>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

StampSample sample(const std::vector<std::string_view>& texts) { return StampSample(texts); }

}  // namespace

TEST_CASE("steps: the median, and the mean that bursts do not mislead") {
  const StampSample bursts = sample({"0", "1", "2", "100", "101", "102", "200"});
  CHECK(bursts.step == 1);
  CHECK_THAT(bursts.mean_step, WithinRel(200.0 / 6, 1e-12));
  CHECK(sample({"5"}).mean_step == 0);
  CHECK(sample({"time", "1", "x", "3"}).step == 2);  // what is no number is passed over
}

TEST_CASE("digits from 1970 tell the unit") {
  CHECK(sample({"1403636579"}).since_1970() == TimeUnit::seconds);
  CHECK(sample({"1403636579763"}).since_1970() == TimeUnit::milliseconds);
  CHECK(sample({"1403636579763555"}).since_1970() == TimeUnit::microseconds);
  CHECK(sample({"1403636579763555584"}).since_1970() == TimeUnit::nanoseconds);
  CHECK_FALSE(sample({"14036365"}).since_1970());
}

TEST_CASE("decimals are written, fractions are no whole numbers") {
  CHECK_FALSE(sample({"1", "2"}).decimals);
  CHECK(sample({"1.0", "2.0"}).decimals);
  CHECK_FALSE(sample({"1.0", "2.0"}).fractions);
  CHECK(sample({"1", "2.5"}).fractions);
  CHECK(sample({"25e-1"}).fractions);
}

TEST_CASE("rates in each unit") {
  const RateRange rates{1, 1000};
  CHECK(is_plausible(5, TimeUnit::milliseconds, rates));
  CHECK_FALSE(is_plausible(5, TimeUnit::seconds, rates));
  CHECK_FALSE(is_plausible(5, TimeUnit::microseconds, rates));
  CHECK(is_plausible(0, TimeUnit::seconds, rates));
  CHECK(rates_text(5) == "0.2 Hz in s, 200 Hz in ms, 2e+05 Hz in us, 2e+08 Hz in ns");
}
