// SPDX-License-Identifier: MIT
#include <filesystem>
#include <splinertia/io/trajectory.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "io/trajectories.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using test::error_of;
using Line = Stamped<SO3xR3<double>>;

TEST_CASE("formats are told by content") {
  const test::TemporaryDirectory folder;
  const auto format_of = [&](std::string_view text) { return recognize_trajectory(folder.write("poses", text)); };
  for (const char* text : {"1305031098.6659 1 2 3 0 0 0 1\n", "# head\n\n 1.305e+09\t1 2 3 0 0 0 1\r\n",
                           "0.0 1 2 3 0 0 0 1\n", "0 1 2 3 0 0 0 1\n0.01 1 2 3 0 0 0 1\n"}) {
    CAPTURE(text);
    CHECK(format_of(text) == TrajectoryFormat::tum);
  }
  for (const char* text :
       {"1403715524907143168,1,2,3,1,0,0,0\n", "1403715524907143168 1 2 3 1 0 0 0\n", "0,1,2,3,1,0,0,0\n",
        "0 1 2 3 1 0 0 0 1 2 3 4 5 6 7 8 9\n", "0 1 2 3 1 0 0 0\n1000000000000 1 2 3 1 0 0 0\n"}) {
    CAPTURE(text);
    CHECK(format_of(text) == TrajectoryFormat::euroc);
  }
}

TEST_CASE("either format gives the same poses") {
  const test::TemporaryDirectory folder;
  const auto poses = test::awkward_trajectory(100);
  write_tum(folder / "a.csv", poses);
  EurocGroundtruthWriter euroc(folder / "b.txt");
  for (const Line& line : poses) euroc.append(EurocState{line.time, line.value, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  euroc.commit();
  CHECK(test::same_all(read_trajectory(folder / "a.csv"), poses));
  CHECK(test::same_all(read_trajectory(folder / "b.txt"), poses));
}

TEST_CASE("what is neither is refused with both formats spelled out") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "bad";
  const std::string expected =
      ", expected TUM (t tx ty tz qx qy qz qw, blanks between, t in seconds with decimals) or EuRoC (8 or 17 columns "
      "ns,px,py,pz,qw,qx,qy,qz[,vx,vy,vz,bwx,bwy,bwz,bax,bay,baz], t in whole nanoseconds)";
  const auto error_in = [&](std::string_view text) {
    folder.write("bad", text);
    return error_of<std::runtime_error>([&] { (void)read_trajectory(path); }).substr(path.string().size());
  };
  CHECK(error_in("# nothing\n") == ":1: no rows" + expected);
  CHECK(error_in("\n1.5,1,2,3,1,0,0,0\n") == ":2: \"1.5,1,2,3,1,0,0,0\" is no row of a trajectory" + expected);
  CHECK(error_in("t x y z\n") == ":1: \"t x y z\" is no row of a trajectory" + expected);
  CHECK(error_in("5,1,2,3\n") == ":1: \"5,1,2,3\" is no row of a trajectory" + expected);
  CHECK(error_in("1 1 2 3 0 0 0 1\n2 1 2 3 0 0 0 1\n") ==
        ":2: whole stamps below 1e12 may be seconds or nanoseconds" + expected);
  CHECK(error_in("1.5 1 2 3 0 0 0 1\n1.6 1 2 3 0 0 x 1\n") == ":2: \"x\" is not a number, expected qz in column 7");
  std::filesystem::remove(path);
  CHECK(error_in("1.5,1,2,3,1,0,0,0").starts_with(":1: "));
  CHECK_THROWS_AS(read_trajectory(folder / "missing"), std::runtime_error);
}

TEST_CASE("recorded trajectories of either format are read") {
  const std::filesystem::path folder = SPLINERTIA_SHARED_DATA_DIR;
  if (!std::filesystem::exists(folder)) {
    WARN("skipped, not there: " << folder.string());
    return;
  }
  CHECK(read_trajectory(folder / "tum_freiburg1_xyz_gt.txt").size() == 3000);
  CHECK(read_trajectory(folder / "euroc_V1_02_medium_gt.csv").size() == 16702);
  CHECK(read_trajectory(folder / "euroc_MH_05_pair/gt.csv").size() == 22212);
}
