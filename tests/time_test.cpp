// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/time.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
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

TEST_CASE("A difference that integers do not hold is the nearest that they hold") {
  constexpr nanoseconds lowest = nanoseconds::min(), highest = nanoseconds::max();
  STATIC_CHECK(time_between(nanoseconds{3}, nanoseconds{5}) == nanoseconds{2});
  STATIC_CHECK(time_between(nanoseconds{-1}, highest) == highest);
  STATIC_CHECK(time_between(lowest, highest) == highest);
  STATIC_CHECK(time_between(highest, lowest) == lowest);
  STATIC_CHECK(time_between(highest, nanoseconds{-1}) == lowest);
  STATIC_CHECK(
      time_between(std::chrono::duration<std::int16_t>(-20'000), std::chrono::duration<std::int16_t>(20'000)) ==
      std::chrono::duration<std::int16_t>(32'767));
  STATIC_CHECK(time_between(0.5, 2.0) == 1.5);
}

TEST_CASE("A span that its type of time does not hold is refused") {
  CHECK_NOTHROW(check_span("fit", "poses", nanoseconds{-1}, nanoseconds::max() - nanoseconds{1}));
  CHECK_NOTHROW(check_span("fit", "poses", nanoseconds{0}, nanoseconds::max()));
  CHECK_THROWS_WITH(check_span("fit", "poses", nanoseconds{-1}, nanoseconds::max()),
                    "fit: poses from -1 to 9223372036854775807 span more ticks than 64 bits can count");
  using Short = std::chrono::duration<std::int32_t, std::milli>;
  CHECK_THROWS_WITH(check_span("x", "stamps", Short{-2'000'000'000}, Short{2'000'000'000}),
                    "x: stamps from -2000000000 to 2000000000 span more ticks than 32 bits can count");
  CHECK_NOTHROW(check_span("x", "stamps", -8e307, 8e307));
  CHECK_THROWS_WITH(check_span("x", "stamps", -1e308, 1e308),
                    "x: stamps from -1e+308 to 1e+308 span more seconds than their time type can represent");
}

TEMPLATE_TEST_CASE("Seconds that do not fit into ticks are refused", "", float, double, long double) {
  using Seconds = TestType;
  constexpr Seconds infinity = std::numeric_limits<Seconds>::infinity();
  CHECK(to_nanoseconds(Seconds(9.22e9L)) > nanoseconds{9'219'000'000'000'000'000});
  CHECK(to_nanoseconds(Seconds(-9.22e9L)) < nanoseconds{-9'219'000'000'000'000'000});
  for (const Seconds t : {Seconds(9.3e9L), Seconds(1e30L), std::numeric_limits<Seconds>::max(), infinity}) {
    CHECK_THROWS_AS(to_nanoseconds(t), std::out_of_range);
    CHECK_THROWS_AS(to_nanoseconds(-t), std::out_of_range);
  }
  CHECK_THROWS_AS(to_nanoseconds(std::numeric_limits<Seconds>::quiet_NaN()), std::out_of_range);
}

TEST_CASE("The refusal of a time names it") {
  CHECK_THROWS_WITH(to_nanoseconds(1e10), "time: 1e+10 s does not fit into 64-bit ticks of 1e-09 s");
  CHECK_THROWS_WITH(to_nanoseconds(std::chrono::hours(3'000'000)),
                    "time: 1.08e+10 s does not fit into 64-bit ticks of 1e-09 s");
  CHECK_THROWS_WITH(after(nanoseconds::max(), 1.0),
                    "time: 1 s after 9223372036854775807 does not fit into 64-bit ticks of 1e-09 s");
  CHECK_THROWS_AS(after(nanoseconds::min(), -1e-9), std::out_of_range);
  CHECK_THROWS_AS(after(nanoseconds{0}, 1e300), std::out_of_range);
  using Short = std::chrono::duration<std::int32_t>;
  CHECK(as_time<Short>(2'147'483'647.4) == Short::max());
  CHECK_THROWS_AS(as_time<Short>(2'147'483'647.5), std::out_of_range);
  CHECK_THROWS_AS(as_time<Short>(std::chrono::hours(1'000'000)), std::out_of_range);
  CHECK(as_time<Short>(nanoseconds{1'999'999'999}) == Short{1});
}

TEST_CASE("Long seconds keep their nanoseconds") {
  CHECK(to_nanoseconds(1'403'715'524.907'143'168L) == nanoseconds{1'403'715'524'907'143'168});
}

TEST_CASE("The last time is its own next") { CHECK(next_time(nanoseconds::max()) == nanoseconds::max()); }
