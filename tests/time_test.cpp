// SPDX-License-Identifier: MIT
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
  CHECK(seconds<double>(0.25) == 0.25);
  CHECK(seconds<double>(nanoseconds{5'000'000}) == 0.005);
  CHECK(seconds<float>(microseconds{250}) == 250e-6F);
}

TEST_CASE("A time after another is rounded to the nearest tick") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  CHECK(after(epoch, 0.005) - epoch == nanoseconds{5'000'000});
  CHECK(after(epoch, 1.0 / 3) - epoch == nanoseconds{333'333'333});
  CHECK(after(2.0, 0.5) == 2.5);
}

TEST_CASE("Files of the field keep nanoseconds") {
  CHECK(to_nanoseconds(0.1) == nanoseconds{100'000'000});
  CHECK(to_nanoseconds(-0.1) == nanoseconds{-100'000'000});
  CHECK(to_nanoseconds(microseconds{7}) == nanoseconds{7000});
}
