// SPDX-License-Identifier: MIT
#include <splinertia/errors/clock/clock_drift.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEMPLATE_TEST_CASE("Stamps gain on the true time from the first sample on", "", float, double) {
  const ClockDrift<TestType> term{TestType(0.125)};
  typename ClockDrift<TestType>::State state;
  for (const TestType& elapsed : {TestType(0), TestType(8), TestType(1024)}) {
    Stamp<TestType> stamp{TestType(2), false, TestType(0.01), elapsed == 0, elapsed};
    term.apply(stamp, state);
    CHECK(stamp.offset == 2 + elapsed / 8);
    CHECK_FALSE(stamp.dropped);
  }
}

TEST_CASE("A rate is a number, known while compiling too") {
  STATIC_CHECK(std::is_same_v<decltype(ClockDrift{2e-5F}), ClockDrift<float>>);
  STATIC_CHECK(std::is_same_v<decltype(ClockDrift{1}), ClockDrift<double>>);
  static constexpr ErrorModel stamps{ClockDrift{-2e-5}};
  STATIC_CHECK(std::get<0>(stamps.terms()).rate == -2e-5);
}

TEST_CASE("A clock that stands still or runs backwards is refused") {
  CHECK_THROWS_WITH(ClockDrift{-1}, "ClockDrift: rate is -1, expected a finite number > -1");
  CHECK_THROWS_WITH(ClockDrift{-1.5F}, "ClockDrift: rate is -1.5, expected a finite number > -1");
  CHECK_THROWS_WITH(ClockDrift{testing::nan<double>}, "ClockDrift: rate is nan, expected a finite number > -1");
  CHECK_THROWS_WITH(ClockDrift{testing::infinity<double>}, "ClockDrift: rate is inf, expected a finite number > -1");
  CHECK_NOTHROW(ClockDrift{-0.999});
}

TEST_CASE("A drift in words") { CHECK(describe(ClockDrift{2e-5}, SensorKind::clock) == "clock drift: rate 2e-05 s/s"); }
