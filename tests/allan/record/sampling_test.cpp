// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <splinertia/allan/record/sampling.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::allan;
using std::chrono::nanoseconds;
using test::error_of;

namespace {

constexpr nanoseconds epoch{1403636579763555584}, interval{5000000};

/// `count` stamps at 200 Hz.
std::vector<nanoseconds> regular(int count) {
  std::vector<nanoseconds> stamps;
  for (int i = 0; i < count; ++i) stamps.push_back(epoch + i * interval);
  return stamps;
}

template <typename Time>
std::string refusal(const std::vector<Time>& stamps, const SamplingLimits& limits = {}) {
  return error_of<std::invalid_argument>([&] { require_regular(measure_sampling(stamps), limits); });
}

}  // namespace

TEST_CASE("a regular log") {
  const auto sampling = measure_sampling(regular(1001));
  CHECK(sampling.samples == 1001);
  CHECK(sampling.rate == 200);
  CHECK(sampling.nominal_interval == 0.005);
  CHECK(sampling.jitter == 0);
  CHECK(sampling.largest_jitter == 0);
  CHECK(sampling.gaps == 0);
  CHECK(sampling.missing == 0);
  CHECK(sampling.missing_share() == 0);
  CHECK(refusal(regular(1001)).empty());
}

TEST_CASE("seconds will do, and any range") {
  const double stamps[] = {0, 0.5, 1.0, 1.5};
  CHECK(measure_sampling(stamps).rate == 2);
  CHECK(measure_sampling(std::vector<float>{0, 1, 2}).rate == 1);
}

TEST_CASE("missing samples do not change the rate") {
  auto stamps = regular(10001);
  stamps.erase(stamps.begin() + 5000, stamps.begin() + 5003);
  stamps.erase(stamps.begin() + 100);
  const auto sampling = measure_sampling(stamps);
  CHECK(sampling.samples == 9997);
  CHECK(sampling.rate == 200);
  CHECK(sampling.nominal_interval == 0.005);
  CHECK(sampling.gaps == 2);
  CHECK(sampling.missing == 4);
  CHECK(sampling.missing_share() == 4 / 10001.0);
  CHECK(sampling.longest.index == 4998);  // the sample before the gap, of those that are there
  CHECK(sampling.longest.time == epoch + 4999 * interval);
  CHECK(sampling.longest.duration == 0.02);
  CHECK(sampling.jitter == 0);
  CHECK(refusal(stamps).empty());
  CHECK(refusal(stamps, {.missing = 1e-4}) ==
        "sampling: 4 samples are missing in 2 gaps, the longest of 0.02 s after sample 4998 at time "
        "1403636604758555584, expected at most 0.01 % of 10001");
}

TEST_CASE("a rate that is not quite the nominal one, jitter, and the median") {
  // 200.02 Hz, and every second stamp 0.5 ms late.
  std::vector<double> stamps;
  for (int i = 0; i < 1001; ++i) stamps.push_back(i / 200.02 + (i % 2 == 1 ? 5e-4 : 0));
  const auto sampling = measure_sampling(stamps);
  CHECK_THAT(sampling.rate, WithinRel(200.02, 1e-12));
  CHECK_THAT(sampling.nominal_interval, WithinAbs(0.005, 6e-4));
  CHECK_THAT(sampling.largest_jitter, WithinAbs(1e-3, 1e-9));
  CHECK(sampling.gaps == 0);
  CHECK(refusal(stamps).empty());
}

TEST_CASE("one late stamp is no harm, intervals that vary are") {
  auto stamps = regular(5001);
  stamps[700] += interval * 4 / 10;
  CHECK_THAT(measure_sampling(stamps).largest_jitter, WithinAbs(0.002, 1e-12));
  CHECK(refusal(stamps).empty());
  for (std::size_t i = 0; i < stamps.size(); i += 2) stamps[i] += interval * 4 / 10;
  CHECK(refusal(stamps).find("sampling: the intervals vary by ") == 0);
  CHECK(refusal(stamps).find(", expected at most 20 % of it") != std::string::npos);
  CHECK(refusal(stamps, {.jitter = 1}).empty());
}

TEST_CASE("stamps that are none are refused by place and value") {
  CHECK(refusal(std::vector<double>{}) == "sampling: 0 stamps, expected at least 3");
  CHECK(refusal(std::vector<double>{1}) == "sampling: 1 stamps, expected at least 3");
  CHECK(refusal(std::vector<double>{1, 2}) == "sampling: 2 stamps, expected at least 3");
  CHECK(refusal(std::vector<double>{0, 1, 1, 2}) ==
        "sampling: stamp 2 is 1, the one before it 1, expected increasing stamps");
  CHECK(refusal(std::vector<double>{0, 2, 1}) ==
        "sampling: stamp 2 is 1, the one before it 2, expected increasing stamps");
  CHECK(refusal(std::vector<double>{0, NAN, 1}) == "sampling: stamp 1 is nan, expected a finite number");
  CHECK(refusal(std::vector<double>{0, 1, INFINITY}) == "sampling: stamp 2 is inf, expected a finite number");
  CHECK(refusal(std::vector{epoch, epoch}) ==
        "sampling: stamp 1 is 1403636579763555584, the one before it 1403636579763555584, expected increasing stamps");
  CHECK(refusal(std::vector{-nanoseconds::max(), nanoseconds{0}, nanoseconds{1}}) ==
        "sampling: stamp 2 is 1, the first one -9223372036854775807, expected a difference that fits their type");
  CHECK(refusal(regular(10), {.missing = -1}) == "SamplingLimits: missing is -1, expected a finite number >= 0");
}

TEST_CASE("jitter invents no missing samples and leaves the rate") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double jitter : {0.1, 0.2, 0.3}) {
    for (const std::size_t missing : {0U, 3U}) {
      CAPTURE(jitter, missing);
      std::vector<double> stamps;
      for (int i = 0; i < 10000; ++i) {
        if (missing > 0 && i % 3000 == 1500) continue;
        const double stamp = 1e5 + 0.005 * (i + jitter * normal(random));
        stamps.push_back(stamps.empty() ? stamp : std::max(stamp, stamps.back() + 1e-9));
      }
      const auto sampling = measure_sampling(stamps);
      CHECK(sampling.missing == static_cast<std::int64_t>(missing));
      CHECK_THAT(sampling.rate, WithinRel(200.0, 2e-4));
      CHECK_THAT(sampling.nominal_interval, WithinRel(0.005, 0.02));
      CHECK_THAT(sampling.jitter / 0.005, WithinRel(std::sqrt(2.0) * jitter, 0.1));
      CHECK(refusal(stamps, {.missing = 1e-3, .jitter = 0.5}).empty());
    }
  }
}

TEST_CASE("stamps of a coarse clock") {
  std::vector<double> stamps;
  for (int i = 0; i < 10000; ++i) stamps.push_back(std::round(i / 0.416) / 1000);  // 416 Hz in whole ms
  const auto sampling = measure_sampling(stamps);
  CHECK_THAT(sampling.rate, WithinRel(416.0, 1e-4));
  CHECK(sampling.missing == 0);
}

TEST_CASE("a stretch that was left out lacks no samples") {
  auto stamps = regular(3000);
  stamps.erase(stamps.begin() + 2000, stamps.begin() + 2500);
  stamps.erase(stamps.begin() + 1000, stamps.begin() + 1003);
  const std::vector<std::int64_t> breaks{1000, 1997};
  const auto sampling = measure_sampling(stamps, breaks);
  CHECK(sampling.samples == 2497);
  CHECK(sampling.rate == 200);
  CHECK(sampling.missing == 0);
  CHECK(sampling.longest.duration == 0.005);
  stamps.erase(stamps.begin() + 300);
  const auto with_gap = measure_sampling(stamps, std::vector<std::int64_t>{999, 1996});
  CHECK(with_gap.rate == 200);
  CHECK(with_gap.missing == 1);
  CHECK(with_gap.longest.index == 299);
}

TEST_CASE("bursts are arrival times, and accepted as such only") {
  std::vector<nanoseconds> stamps;
  for (int i = 0; i < 2000; ++i) stamps.push_back(epoch + i / 4 * 4 * interval + i % 4 * nanoseconds(60000));
  const auto sampling = measure_sampling(stamps);
  REQUIRE(sampling.bursts);
  CHECK_THAT(sampling.rate, WithinRel(200.0, 1e-9));
  CHECK(sampling.missing == 0);
  CHECK(refusal(stamps) ==
        "sampling: the stamps come in bursts of 4 samples 6e-05 s apart, one every 0.02 s: they are arrival times of "
        "packets and no sample is missing, expected the times of the samples");
  CHECK(refusal(stamps, {.arrival_times = true}).empty());
  for (std::size_t i = 1000; i < stamps.size(); ++i) stamps[i] += std::chrono::seconds(1);
  CHECK(refusal(stamps, {.arrival_times = true}).find("sampling: 200 samples are missing in 1 gap") == 0);
}

TEST_CASE("arrival times may jitter as they like") {
  std::vector<double> stamps;
  for (int i = 0; i < 1000; ++i) stamps.push_back(i + (i % 2 == 0 ? 0.4 : 0));
  CHECK(refusal(stamps).find("sampling: the intervals vary by ") == 0);
  CHECK(refusal(stamps, {.arrival_times = true}).empty());
}
