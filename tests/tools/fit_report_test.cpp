// SPDX-License-Identifier: MIT
#include "../../tools/support/fit_report.hpp"

#include <limits>
#include <splinertia/splinertia.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// A body at rest for 2 s and its fit.
struct Fixture {
  FitInput input{"poses.tum", {}};
  FittedTrajectory fitted{};
  FitChoices choices{};

  Fixture() {
    fitted.curve = AnyTrajectory(at_rest(SO3xR3<double>{}), nanoseconds(0), nanoseconds(2'000'000'000));
    fitted.interval = nanoseconds(50'000'000);
    for (int i = 0; i <= 100; ++i) input.poses.push_back({nanoseconds(20'000'000LL * i), SO3xR3<double>{}});
    fitted.smoothed = input.poses;
    fitted.distances = distances(input.poses, input.poses);
    fitted.control_points.resize(43);
  }
  std::string report() const {
    return fit_report(input, fitted, choices, nullptr, extremes(input.poses, fitted, Eigen::Vector3d(0, 0, -9.8), 200));
  }
};

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a condition is a number of digits, or a sentence where it is infinite") {
  Fixture f;
  CHECK_FALSE(contains(f.report(), "warning"));
  f.fitted.condition = 1e12;
  CHECK(contains(f.report(), "about 12 of the curve's 16 digits are lost"));
  f.fitted.condition = std::numeric_limits<double>::infinity();
  CHECK(contains(f.report(), "warning: some control points are not determined at all, neither by poses nor by"));
  CHECK_FALSE(contains(f.report(), "inf"));
}

TEST_CASE("one is singular, two are plural") {
  Fixture f;
  f.fitted.outliers = {3};
  f.fitted.holes = {{nanoseconds(1'000'000'000), nanoseconds(1'200'000'000)}};
  CHECK(contains(f.report(), "outliers: 1 pose deviates by more than 6 standard deviations"));
  CHECK(contains(f.report(), "holes: 1 span without poses"));
  f.fitted.outliers = {3, 5};
  f.fitted.holes.push_back({nanoseconds(1'500'000'000), nanoseconds(1'600'000'000)});
  CHECK(contains(f.report(), "outliers: 2 poses deviate"));
  CHECK(contains(f.report(), "holes: 2 spans without poses"));
}

TEST_CASE("what has not converged is said with its reason") {
  Fixture f;
  CHECK(not_converged(f.fitted, f.choices).empty());
  f.fitted.converged = false;
  f.fitted.iterations = 12;
  CHECK(not_converged(f.fitted, f.choices) ==
        "the fit has not converged: after 12 linear systems no step lowered the cost any more");
  f.choices.most_iterations = 12;
  CHECK(contains(f.report(),
                 "warning: the fit has not converged: 12 linear systems were not enough (--most-iterations)"));
  f.fitted.converged = true;
  f.fitted.imu.emplace();
  f.fitted.imu->calibrated.converged = false;
  CHECK(not_converged(f.fitted, f.choices) == "the calibration of the IMU has not converged");
}
