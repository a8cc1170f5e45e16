// SPDX-License-Identifier: MIT
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEMPLATE_TEST_CASE("Every stamp is later by the offset", "", float, double) {
  const ErrorModel stamps{ClockOffset<TestType>{TestType(0.25)}, ClockOffset<TestType>{-1}};
  auto state = stamps.start(StreamKey(1));
  for (const TestType& elapsed : {TestType(0), TestType(100)}) {
    Stamp<TestType> stamp{TestType(2), false, TestType(0.01), elapsed == 0, elapsed};
    stamps.apply(stamp, state);
    CHECK(stamp.offset == TestType(1.25));
    CHECK_FALSE(stamp.dropped);
  }
}

TEST_CASE("An offset is a number, known while compiling too") {
  STATIC_CHECK(std::is_same_v<decltype(ClockOffset{0.003F}), ClockOffset<float>>);
  STATIC_CHECK(std::is_same_v<decltype(ClockOffset{1}), ClockOffset<double>>);
  static constexpr ErrorModel stamps{ClockOffset{-0.25}};
  STATIC_CHECK(std::get<0>(stamps.terms()).offset == -0.25);
  CHECK_THROWS_WITH(ClockOffset{testing::nan<double>}, "ClockOffset: offset is nan, expected a finite number");
  CHECK_THROWS_WITH(ClockOffset{-testing::infinity<float>}, "ClockOffset: offset is -inf, expected a finite number");
}

TEST_CASE("An offset in words") {
  CHECK(describe(ClockOffset{0.003}, SensorKind::clock) == "clock offset: offset 0.003 s");
}
