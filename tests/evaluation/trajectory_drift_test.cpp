// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/evaluation/trajectory_drift.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;

namespace {

// Straight on, 1 m from one to the next; the estimate has a scale that is 1 % too large and turns by 1 mrad/m.
template <typename G>
std::vector<PosePair<G, double>> drifting(int count) {
  using Scalar = ScalarOf<G>;
  std::vector<PosePair<G, double>> pairs;
  for (int i = 0; i < count; ++i) {
    const auto s = static_cast<Scalar>(i);
    pairs.push_back({0.1 * i, make_pose<G>({}, {s, 0, 0}),
                     make_pose<G>(GroupTraits<Sophus::SO3<Scalar>>::exp({s / 1000, 0, 0}), {Scalar(1.01) * s, 0, 0})});
  }
  return pairs;
}

std::string error_of(const auto& f) { return test::error_of<std::invalid_argument>(f); }

}  // namespace

TEMPLATE_TEST_CASE("Drift over a length is that of segments from every tenth pose", "", SO3xR3<double>, Sophus::SE3d,
                   SO3xR3<float>) {
  using G = TestType;
  const auto tolerance = 1000 * static_cast<double>(std::numeric_limits<ScalarOf<G>>::epsilon());
  const auto pairs = drifting<G>(152);
  // A segment ends with the first pose to which the path is longer than 100 m: after 101 m. Those from 0 to 50 do.
  const auto errors = drift_errors(pairs, 100);
  CHECK(errors.size() == 6);
  for (const auto& [translation, rotation] : errors) {
    CHECK_THAT(static_cast<double>(translation), WithinAbs(0.01 * 101 / 100, tolerance));
    CHECK_THAT(static_cast<double>(rotation), WithinAbs(1e-3 * 101 / 100, tolerance));
  }
  CHECK(drift_errors(pairs, 100, 1).size() == 51);
  CHECK(drift_errors(pairs, 100, 1000).size() == 1);
  CHECK(drift_errors(pairs, 150).size() == 1);
  CHECK(drift_errors(pairs, 151).empty());
  CHECK(drift_errors(std::vector<PosePair<G, double>>{}, 1).empty());
}

TEST_CASE("The path is that of the reference") {
  auto pairs = drifting<SO3xR3<double>>(101);
  for (auto& pair : pairs) pair.estimate = make_pose<SO3xR3<double>>({}, {0, 0, 0});
  CHECK(reference_path(pairs).back() == 100);
  const auto errors = drift_errors(pairs, 50);
  REQUIRE(errors.size() == 5);
  CHECK(errors[0].translation == 51.0 / 50);
}

TEST_CASE("Lengths and steps that make no sense are refused") {
  const auto pairs = drifting<SO3xR3<double>>(10);
  CHECK(error_of([&] { (void)drift_errors(pairs, 0); }) == "drift_errors: length 0 m, expected a length > 0");
  CHECK(error_of([&] { (void)drift_errors(pairs, std::numeric_limits<double>::quiet_NaN()); }) != "");
  CHECK(error_of([&] { (void)drift_errors(pairs, std::numeric_limits<double>::infinity()); }) != "");
  CHECK(error_of([&] { (void)drift_errors(pairs, 1, 0); }) == "drift_errors: step 0, expected 1 or more");
}
