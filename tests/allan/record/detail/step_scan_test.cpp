// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <splinertia/allan/record/detail/step_scan.hpp>
#include <splinertia/random/normal.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::allan;
using namespace splinertia::allan::detail;

namespace {

std::vector<double> white(std::size_t n, std::uint64_t seed = 0) {
  NormalStream<> normal(StreamKey(seed) / 1);
  std::vector<double> values(n);
  for (double& value : values) value = normal();
  return values;
}

}  // namespace

TEST_CASE("the threshold is exceeded with the probability it is for") {
  // 2 T z φ(z) = P for 1000 trials and 1e-3: z = 5.37; and Student's t for few degrees of freedom.
  const double z = step_threshold(1000, 1e-3, 1e12);
  CHECK_THAT(2 * 1000 * z * std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi), WithinRel(1e-3, 1e-6));
  const double t = step_threshold(1000, 1e-3, 20);
  CHECK_THAT(20 * std::log1p(t * t / 20), WithinRel(z * z, 1e-4));
  CHECK(t > z);
}

TEST_CASE("the usual size is the standard deviation, whatever a tenth of the values are") {
  auto sizes = white(20000);
  for (double& size : sizes) size = std::abs(size);
  CHECK_THAT(usual_size(sizes), WithinRel(1, 0.03));
  for (std::size_t i = 0; i < sizes.size(); i += 10) sizes[i] = 1e6;
  CHECK_THAT(usual_size(sizes), WithinRel(1.2, 0.1));
  sizes.assign(100, 1e-17);
  CHECK(usual_size(sizes) == 0);
  std::vector<double> none;
  CHECK(usual_size(none) == 0);
}

TEST_CASE("knocks are clipped, steps are not") {
  auto means = white(2000);
  for (std::size_t i = 500; i < 2000; ++i) means[i] += 50;
  const auto before = means;
  clip_knocks(means);
  CHECK(means == before);
  means[1000] = 1e9;
  means[1500] = means[1501] = -1e9;
  clip_knocks(means);
  CHECK(std::abs(means[1000] - 50) < 12);
  CHECK(std::abs(means[1500] - 50) < 12);
  CHECK(std::abs(means[1501] - 50) < 12);
}

TEST_CASE("a parabola has no candidates, a step has") {
  auto means = white(4000);
  for (std::size_t i = 0; i < means.size(); ++i) means[i] += 1e-5 * static_cast<double>(i * i);
  CHECK(StepScan(means, 1e-4, 0).candidates().empty());
  for (std::size_t i = 1234; i < means.size(); ++i) means[i] += 4;
  const auto found = StepScan(means, 1e-4, 0).candidates();
  REQUIRE_FALSE(found.empty());
  for (const StepCandidate& candidate : found) {
    CHECK(std::abs(candidate.center - 1234) < 2 * candidate.width);
    CHECK(candidate.excess >= 1);
    CHECK(candidate.center >= candidate.before);
    CHECK(candidate.center + candidate.after <= 4000);
  }
}

TEST_CASE("where a signal is usually constant, only the smallest height of interest counts") {
  std::vector<double> means(1000, 3.0);
  for (std::size_t i = 600; i < means.size(); ++i) means[i] = 5;
  CHECK(StepScan(means, 1e-4, 0).candidates().empty());
  CHECK_FALSE(StepScan(means, 1e-4, 1).candidates().empty());
  CHECK(StepScan(means, 1e-4, 3).candidates().empty());
}

TEST_CASE("a scan of next to nothing finds nothing") {
  for (const std::size_t n : {0U, 1U, 12U, 63U}) {
    auto means = white(n);
    if (n > 0) means.back() = 1e6;
    clip_knocks(means);
    CHECK(StepScan(means, 1e-4, 0).candidates().empty());
  }
}
