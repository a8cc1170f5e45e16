// SPDX-License-Identifier: MIT
// Which intervals between samples are gaps.
#include <chrono>
#include <limits>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

struct InSeconds {
  using Time = double;
  static Time time(double t) { return t; }
};
struct InNanoseconds {
  using Time = nanoseconds;
  static Time time(double t) { return nanoseconds(1'400'000'000'000'000'000) + to_nanoseconds(t); }
};

/// `count` intervals of `interval`, after what is there.
void add(std::vector<double>& stamps, int count, double interval) {
  for (int i = 0; i < count; ++i) stamps.push_back(stamps.back() + interval);
}

/// How many gaps are bridged with these options; −1 where one is refused.
template <typename Clock, typename Scalar = double, typename Scheme = Midpoint>
int gaps(const std::vector<double>& stamps, GapOptions<Scalar> options = {}) {
  using Time = typename Clock::Time;
  using Vector = Eigen::Vector3<Scalar>;
  Integrator<Scheme, Scalar, Time> integrator(
      NavState<Scalar, Time>{{}, Vector::Zero(), Vector::Zero(), Clock::time(stamps.front())},
      standard_gravity<Scalar>(), options);
  try {
    for (std::size_t i = Scheme::takes_increments ? 1 : 0; i < stamps.size(); ++i) {
      if constexpr (Scheme::takes_increments) {
        integrator.push(ImuIncrement<Scalar, Time>{Clock::time(stamps[i]), Vector::Zero(), Vector::Zero()});
      } else {
        integrator.push(ImuSample<Scalar, Time>{Clock::time(stamps[i]), Vector::Zero(), Vector::Zero()});
      }
    }
    integrator.finish();
  } catch (const std::invalid_argument&) {
    return -1;
  }
  return static_cast<int>(integrator.gaps());
}

const std::vector<double> hole_of_a_second = [] {
  std::vector<double> stamps{0};
  add(stamps, 100, 0.005);
  add(stamps, 1, 1);
  add(stamps, 100, 0.005);
  return stamps;
}();

}  // namespace

TEMPLATE_TEST_CASE("A hole of a second between samples of 200 Hz is refused unless bridging is asked for", "",
                   InSeconds, InNanoseconds) {
  CHECK(gaps<TestType>(hole_of_a_second) == -1);
  CHECK(gaps<TestType, float>(hole_of_a_second) == -1);
  CHECK(gaps<TestType, long double>(hole_of_a_second) == -1);
  CHECK(gaps<TestType, double, RotationCorrectedIncrements>(hole_of_a_second) == -1);
  CHECK(gaps<TestType>(hole_of_a_second, {.policy = GapPolicy::bridge}) == 1);
  CHECK(gaps<TestType>(hole_of_a_second, {.longest = 2}) == 0);
  CHECK(gaps<TestType>(hole_of_a_second, {.longest = std::numeric_limits<double>::infinity()}) == 0);
  CHECK(gaps<TestType>(hole_of_a_second, {.longest = 0.006, .policy = GapPolicy::bridge}) == 1);
}

TEMPLATE_TEST_CASE("Slow samples have no gaps, ten of their intervals are one", "", InSeconds, InNanoseconds) {
  for (const double interval : {0.001, 0.02, 0.11, 1.0, 3600.0}) {
    CAPTURE(interval);
    std::vector<double> stamps{0};
    add(stamps, 20, interval);
    CHECK(gaps<TestType>(stamps) == 0);
    CHECK(gaps<TestType, float>(stamps) == 0);
    CHECK(gaps<TestType, double, RotationCorrectedIncrements>(stamps) == 0);
    add(stamps, 1, std::max(0.09, 9 * interval));
    CHECK(gaps<TestType>(stamps) == 0);
    add(stamps, 20, interval);
    add(stamps, 1, std::max(0.11, 18 * interval));
    CHECK(gaps<TestType>(stamps) == -1);
    CHECK(gaps<TestType>(stamps, {.policy = GapPolicy::bridge}) == 1);
  }
}

TEMPLATE_TEST_CASE("A hole after the first sample is found with the second interval", "", InSeconds, InNanoseconds) {
  std::vector<double> stamps{0, 0.5};
  CHECK(gaps<TestType>(stamps) == 0);  // two samples tell nothing
  add(stamps, 1, 0.005);
  CHECK(gaps<TestType>(stamps) == -1);
  CHECK(gaps<TestType>(stamps, {.policy = GapPolicy::bridge}) == 1);
  add(stamps, 10, 0.005);
  add(stamps, 1, 0.2);  // the first hole is no measure of what is usual
  CHECK(gaps<TestType>(stamps, {.policy = GapPolicy::bridge}) == 2);
}

TEST_CASE("What rounding of the stamps adds to an interval is no gap") {
  const double epoch = 1.4e9;
  Preintegrator<Midpoint, double> imu(epoch);
  const auto at = [&](int i) { return ImuSample<>{epoch + i / 3.0, {0, 0, 0}, {0, 0, 0}}; };
  for (int i = 0; i < 100; ++i) imu.push(at(i));
  imu.push(at(109));  // nine are missing
  CHECK_THROWS_AS(imu.push(at(120)), std::invalid_argument);
}

TEST_CASE("A gap's message says where it is and the way out, and leaves all as it was") {
  Preintegrator<Midpoint, double> imu(0.0);
  const auto at = [](double t) { return ImuSample<>{t, {0, 0, 0}, {0, 0, 0}}; };
  for (int i = 0; i <= 2; ++i) imu.push(at(0.25 * i));
  CHECK_THROWS_WITH(imu.push(at(4)),
                    "preintegrate: sample 3 at 4 comes 3.5 s after the one before, expected at most 2.5 s (GapOptions "
                    "sets another limit, or bridges gaps)");
  CHECK(imu.result().delta().interval == 0.5);
  imu.push(at(0.75));
  CHECK(imu.result().delta().interval == 0.75);

  Preintegrator<Midpoint, double> late(0.0);
  late.push(at(0));
  late.push(at(2));
  CHECK_THROWS_WITH(late.push(at(2.125)),
                    "preintegrate: sample 1 at 2 comes 2 s after the one before, sample 2 only 0.125 s after it "
                    "(GapOptions sets another limit, or bridges gaps)");
}
