// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/strapdown/detail/sample_window.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// What a window makes of stamps, as (from, to) of each step, found in the samples that `take` is given.
template <typename Scheme>
class Recorder {
 public:
  explicit Recorder(const GapOptions<double>& gaps = {}) : window(0, gaps) {}

  void push(double time) {
    const Eigen::Vector3d value(time, 0, 0);
    if constexpr (Scheme::takes_increments) {
      window.push(ImuIncrement<>{time, value, value}, take());
    } else {
      window.push(ImuSample<>{time, value, value}, take());
    }
  }
  void finish() { window.finish(take()); }

  SampleWindow<Scheme, double, double> window;
  std::vector<std::pair<double, double>> steps;

 private:
  auto take() {
    return [this](const auto& samples, std::size_t from, double end) {
      if constexpr (Scheme::takes_increments) {
        steps.emplace_back(samples[from].time - samples[from].interval, end);
      } else {
        steps.emplace_back(samples[from].time, end);
      }
    };
  }
};

using Steps = std::vector<std::pair<double, double>>;

/// The steps of samples at 1, 2, … n (increments), or 0, 1, … n − 1 (points), before and after finish().
template <typename Scheme>
std::pair<Steps, Steps> steps_of(int n) {
  Recorder<Scheme> recorder;
  for (int i = 0; i < n; ++i) recorder.push(Scheme::takes_increments ? i + 1 : i);
  const Steps before = recorder.steps;
  recorder.finish();
  recorder.finish();  // the second time nothing is left
  return {before, recorder.steps};
}

/// Steps of `stride` from 0 up to `end`, the last one shorter where it must be.
Steps expected_steps(int end, int stride) {
  Steps steps;
  for (int i = 0; i < end; i += stride) steps.emplace_back(i, std::min(i + stride, end));
  return steps;
}

}  // namespace

TEST_CASE("Steps follow each other and end at the last sample, for 0 to 10 samples") {
  for (int n = 0; n <= 10; ++n) {
    CAPTURE(n);
    const int last = std::max(n - 1, 0);
    CHECK(steps_of<Midpoint>(n).first == expected_steps(last, 1));
    CHECK(steps_of<Midpoint>(n).second == expected_steps(last, 1));
    CHECK(steps_of<RotationCorrectedIncrements>(n).first == expected_steps(n, 1));
    CHECK(steps_of<TwoSampleIncrements>(n).second == expected_steps(n, 2));
    CHECK(steps_of<ThreeSampleIncrements>(n).second == expected_steps(n, 3));
    CHECK(steps_of<Magnus4>(n).second == expected_steps(last, 1));
    CHECK(steps_of<RungeKutta4DoubleStep>(n).second == expected_steps(last, 2));
  }
}

TEST_CASE("A scheme is behind by what it looks ahead, until the end") {
  for (int n = 4; n <= 10; ++n) {
    CAPTURE(n);
    CHECK(steps_of<Magnus4>(n).first == expected_steps(n - 2, 1));
    CHECK(steps_of<RungeKutta4DoubleStep>(n).first == expected_steps((n - 1) / 2 * 2, 2));
    CHECK(steps_of<TwoSampleIncrements>(n).first == expected_steps(n / 2 * 2, 2));
    CHECK(steps_of<ThreeSampleIncrements>(n).first == expected_steps(n / 3 * 3, 3));
  }
  CHECK(steps_of<Magnus4>(3 + 1).first.size() == 2);
}

TEMPLATE_TEST_CASE("Of fewer samples than a scheme looks at, the first stands in for what is missing", "", Magnus4,
                   RungeKutta4DoubleStep) {
  for (int n = 2; n <= 3; ++n) {
    SampleWindow<TestType, double, double> window(0);
    const auto take = [&](const auto& samples, std::size_t from, double end) {
      CHECK(samples[3].time == n - 1);
      for (int i = 0; i < 4; ++i) CHECK(samples[static_cast<std::size_t>(i)].time == std::max(0, n - 4 + i));
      CHECK(samples[from].time < end);
    };
    for (int i = 0; i < n; ++i) window.push(ImuSample<>{double(i), {1, 2, 3}, {4, 5, 6}}, take);
    window.finish(take);
  }
}

TEST_CASE("What is refused changes nothing") {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  Recorder<Midpoint> recorder({.longest = 2});
  CHECK_THROWS_WITH(recorder.push(0.5),
                    "integrate: the first sample is at 0.5, the initial state at 0, expected the same time");
  CHECK_THROWS_AS(recorder.push(nan), std::invalid_argument);
  recorder.push(0);
  recorder.push(1);
  CHECK_THROWS_WITH(recorder.push(1), "integrate: sample 2 is at 1, expected a time after 1");
  CHECK_THROWS_WITH(recorder.push(0.5), "integrate: sample 2 is at 0.5, expected a time after 1");
  CHECK_THROWS_AS(recorder.push(nan), std::invalid_argument);
  CHECK_THROWS_WITH(recorder.push(infinity), "integrate: sample 2 is at inf, expected a time after 1");
  CHECK_THROWS_WITH(recorder.push(3.5),
                    "integrate: sample 2 at 3.5 comes 2.5 s after the one before, expected at most 2 s");
  CHECK(recorder.window.last() == 1);
  CHECK(recorder.window.gaps() == 0);
  recorder.push(3);  // exactly as long as allowed
  CHECK(recorder.steps == Steps{{0, 1}, {1, 3}});
}

TEST_CASE("The first increment begins at the start") {
  Recorder<RotationCorrectedIncrements> recorder;
  CHECK_THROWS_WITH(recorder.push(0), "integrate: sample 0 is at 0, expected a time after 0");
  recorder.push(0.25);
  CHECK(recorder.steps == Steps{{0, 0.25}});
}

TEST_CASE("Gaps are bridged where that is asked for, and counted") {
  Recorder<Magnus4> recorder({.longest = 1.5, .policy = GapPolicy::bridge});
  for (const double t : {0, 1, 3, 4, 5, 9, 10}) recorder.push(t);
  CHECK_THROWS_AS(recorder.push(10), std::invalid_argument);
  recorder.finish();
  CHECK(recorder.window.gaps() == 2);
  CHECK(recorder.steps == Steps{{0, 1}, {1, 3}, {3, 4}, {4, 5}, {5, 9}, {9, 10}});
}

TEST_CASE("A gap that is bridged counts only if the sample is taken") {
  Recorder<ThreeSampleIncrements> recorder({.longest = 1.5, .policy = GapPolicy::bridge});
  recorder.push(1);
  CHECK_THROWS_AS(recorder.push(4), std::invalid_argument);  // not an equal interval
  CHECK(recorder.window.gaps() == 0);
  recorder.push(2);
  recorder.push(3);
  CHECK(recorder.steps == Steps{{0, 3}});
}

TEST_CASE("An exception of the caller's own does not repeat a step") {
  SampleWindow<Midpoint, double, double> window(0);
  const auto at = [](double t) { return ImuSample<>{t, {0, 0, 0}, {0, 0, 0}}; };
  int steps = 0;
  const auto fail = [&](const auto&, std::size_t, double) {
    ++steps;
    throw std::runtime_error("enough");
  };
  window.push(at(0), fail);
  CHECK_THROWS_AS(window.push(at(1), fail), std::runtime_error);
  window.finish(fail);
  CHECK(steps == 1);
}

TEST_CASE("A copy is an independent continuation") {
  Recorder<TwoSampleIncrements> recorder;
  for (const double t : {1, 2, 3}) recorder.push(t);
  auto copy = recorder.window;
  Steps steps;
  const auto take = [&](const auto& samples, std::size_t from, double end) {
    steps.emplace_back(samples[from].time - samples[from].interval, end);
  };
  copy.finish(take);
  CHECK(steps == Steps{{2, 3}});
  recorder.push(4);
  CHECK(recorder.steps == Steps{{0, 2}, {2, 4}});
}

TEST_CASE("A limit for gaps that is none is refused") {
  using Window = SampleWindow<Midpoint, double, double>;
  CHECK_THROWS_WITH(Window(0.0, {.longest = 0}), "integrate: the longest interval is 0 s, expected one > 0");
  CHECK_THROWS_AS(Window(0.0, {.longest = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  CHECK_NOTHROW(Window(0.0, {.longest = std::numeric_limits<double>::infinity()}));
}

TEMPLATE_TEST_CASE("Readings that are not finite or too large are refused, by index, stamp and value", "", Midpoint,
                   Magnus4, RotationCorrectedIncrements, ThreeSampleIncrements) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto at = [](double time, double rate, double force) {
    if constexpr (TestType::takes_increments) {
      return ImuIncrement<>{time, {0, rate, 0}, {0, 0, force}};
    } else {
      return ImuSample<>{time, {0, rate, 0}, {0, 0, force}};
    }
  };
  SampleWindow<TestType, double, double> window(0);
  int steps = 0;
  const auto take = [&](const auto& samples, std::size_t, double) {
    for (const auto& sample : samples) {
      if constexpr (!TestType::takes_increments) CHECK(sample.accel.allFinite());
    }
    ++steps;
  };
  const std::string names[2] = {TestType::takes_increments ? "delta_angle" : "gyro",
                                TestType::takes_increments ? "delta_velocity" : "accel"};
  for (int i = 0; i < 9; ++i) {
    const double t = TestType::takes_increments ? i + 1 : i;
    const std::string sample = "integrate: sample " + std::to_string(i) + " at " + std::to_string(int(t)) + " has ";
    CHECK_THROWS_WITH(window.push(at(t, nan, 0), take), sample + names[0] + "[1] = nan, expected a finite number");
    CHECK_THROWS_WITH(window.push(at(t, 0, -infinity), take),
                      sample + names[1] + "[2] = -inf, expected a finite number");
    CHECK_THROWS_AS(window.push(at(t, infinity, -infinity), take), std::invalid_argument);
    CHECK_THROWS_AS(window.push(at(t, 1.7e308, -1.7e308), take), std::invalid_argument);
    const double most = std::ldexp(1.0, 341);
    window.push(at(t, most, most), take);  // their sum is larger, they are not
    CHECK(window.last() == t);
  }
  window.finish(take);
  CHECK(steps == 9 / static_cast<int>(TestType::stride) - (TestType::takes_increments ? 0 : 1));
}

TEMPLATE_TEST_CASE("Integer stamps as far apart as they can be are refused without overflow", "", Midpoint, Magnus4,
                   RotationCorrectedIncrements) {
  using std::chrono::nanoseconds;
  const auto at = [](nanoseconds time) {
    if constexpr (TestType::takes_increments) {
      return ImuIncrement<double, nanoseconds>{time, {0, 0, 0}, {0, 0, 0}};
    } else {
      return ImuSample<double, nanoseconds>{time, {0, 0, 0}, {0, 0, 0}};
    }
  };
  const auto ignore = [](const auto&, std::size_t, nanoseconds) {};
  const double infinity = std::numeric_limits<double>::infinity();
  SampleWindow<TestType, double, nanoseconds> window(nanoseconds::min(), {.longest = infinity});
  if (!TestType::takes_increments) window.push(at(nanoseconds::min()), ignore);
  CHECK_THROWS_WITH(window.push(at(nanoseconds::max()), ignore),
                    Catch::Contains("their difference does not fit the type of time"));
  CHECK_THROWS_AS(window.push(at(nanoseconds(1)), ignore), std::invalid_argument);
  window.push(at(nanoseconds::min() + nanoseconds::max() / 4), ignore);  // 73 years later
  CHECK_THROWS_WITH(window.push(at(nanoseconds::min()), ignore), Catch::Contains("expected a time after"));
  window.push(at(nanoseconds::min() + nanoseconds::max() / 2), ignore);
  window.finish(ignore);

  SampleWindow<TestType, double, nanoseconds> backwards(nanoseconds::max());
  if (!TestType::takes_increments) backwards.push(at(nanoseconds::max()), ignore);
  CHECK_THROWS_WITH(backwards.push(at(nanoseconds::min() + nanoseconds(2)), ignore),
                    Catch::Contains("expected a time after"));
}
