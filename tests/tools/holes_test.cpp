// SPDX-License-Identifier: MIT
#include "../../tools/support/holes.hpp"

#include "../io/temporary_directory.hpp"
#include "support/catch.hpp"

using std::chrono::nanoseconds;

TEST_CASE("the poses on both sides of a hole are not in it") {
  const std::vector<Hole> holes{{nanoseconds(10), nanoseconds(20)}, {nanoseconds(20), nanoseconds(30)}};
  const auto at = [&](int time) { return hole_at(holes, nanoseconds(time)); };
  for (const int time : {0, 10, 20, 30, 31}) CHECK_FALSE(at(time).has_value());
  for (const int time : {11, 19}) CHECK(at(time) == 0u);
  for (const int time : {21, 29}) CHECK(at(time) == 1u);
  CHECK_FALSE(hole_at({}, nanoseconds(5)).has_value());
}

TEST_CASE("holes in words and as a table") {
  const std::vector<Hole> holes{{nanoseconds(1'500'000'000), nanoseconds(1'750'000'000)},
                                {nanoseconds(2'000'000'000), nanoseconds(4'000'000'000)}};
  CHECK(hole_lines(holes, nanoseconds(1'000'000'000), 1) == std::vector<std::string>{"0.500 - 0.750 s", "and 1 more"});
  CHECK(hole_lines(holes, nanoseconds(0), 2, {"a", "b"})[1] == "2.000 - 4.000 s: b");
  const splinertia::test::TemporaryDirectory folder;
  splinertia::AtomicFile file(folder / "gaps.csv");
  write_holes(file, holes);
  file.commit();
  CHECK(splinertia::test::content(folder / "gaps.csv") ==
        "#start [ns],end [ns],length [s]\n1500000000,1750000000,0.25\n2000000000,4000000000,2\n");
}
