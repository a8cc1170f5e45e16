// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/time.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::microseconds;
using std::chrono::nanoseconds;

TEST_CASE("Time is a floating-point number of seconds or an integer duration") {
  STATIC_CHECK(TimePoint<double>);
  STATIC_CHECK(TimePoint<nanoseconds>);
  STATIC_CHECK(!TimePoint<int>);
  STATIC_CHECK(!TimePoint<std::chrono::duration<double>>);
}

TEST_CASE("Differences become seconds of the scalar asked for") {
  CHECK(to_seconds<double>(0.25) == 0.25);
  CHECK(to_seconds<double>(nanoseconds{5'000'000}) == 0.005);
  CHECK(to_seconds<float>(microseconds{250}) == 250e-6F);
}

TEST_CASE("A time after another is rounded to the nearest tick") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  CHECK(after(epoch, 0.005) - epoch == nanoseconds{5'000'000});
  CHECK(after(epoch, 1.0 / 3) - epoch == nanoseconds{333'333'333});
  CHECK(after(2.0, 0.5) == 2.5);
}

TEMPLATE_TEST_CASE("The next time is the next number", "", float, double, long double) {
  using Time = TestType;
  const Time smallest = std::numeric_limits<Time>::denorm_min();
  for (const Time& t : {Time(-1e9L), Time(-1), -smallest, Time(0), smallest, Time(1), Time(1.4e9L)}) {
    const Time next = next_time(t);
    CHECK(next > t);
    const Time between = t + (next - t) / 2;
    CHECK((between == t || between == next));
  }
}

TEST_CASE("The next time is the next tick") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  CHECK(next_time(epoch) - epoch == nanoseconds{1});
  CHECK(next_time(microseconds{-1}) == microseconds{0});
}

TEST_CASE("Files of the field keep nanoseconds") {
  CHECK(to_nanoseconds(0.1) == nanoseconds{100'000'000});
  CHECK(to_nanoseconds(-0.1) == nanoseconds{-100'000'000});
  CHECK(to_nanoseconds(microseconds{7}) == nanoseconds{7000});
}
