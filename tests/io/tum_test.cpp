// SPDX-License-Identifier: MIT
// Real data: tum_freiburg1_xyz_gt.txt
#include <filesystem>
#include <limits>
#include <span>
#include <splinertia/io/tum.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "io/trajectories.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;
using test::content;
using test::error_of;
using Line = Stamped<SO3xR3<double>>;

TEST_CASE("a trajectory reads back to the same bits") {
  const test::TemporaryDirectory folder;
  const auto poses = test::awkward_trajectory(500);
  write_tum(folder / "poses.txt", poses);
  CHECK(test::same_all(read_tum(folder / "poses.txt"), poses));
  CHECK(folder.files() == 1);

  write_tum(folder / "se3.txt", test::awkward_trajectory<Sophus::SE3d>(500));
  CHECK(content(folder / "se3.txt") == content(folder / "poses.txt"));

  write_tum(folder / "few.txt", std::span(poses).first(7));
  CHECK(read_tum(folder / "few.txt").size() == 7);
}

TEST_CASE("a trajectory in seconds is written as the same in nanoseconds") {
  const test::TemporaryDirectory folder;
  std::vector<Line> written;
  std::vector<Stamped<SO3xR3<double>, double>> in_seconds;
  for (const Line& pose : test::awkward_trajectory(50)) {
    const double time = static_cast<double>(written.size()) * 0.005 - 0.1;
    written.push_back({to_nanoseconds(time), pose.value});
    in_seconds.push_back({time, pose.value});
  }
  write_tum(folder / "ns.txt", written);
  write_tum(folder / "s.txt", in_seconds);
  CHECK(content(folder / "s.txt") == content(folder / "ns.txt"));
}

TEST_CASE("the columns are t tx ty tz qx qy qz qw") {
  const test::TemporaryDirectory folder;
  const auto poses = read_tum(folder.write("poses.txt",
                                           "# timestamp tx ty tz qx qy qz qw\r\n"
                                           "1305031098.6659 1 2 3 0.5 0.5 -0.5 0.5\r\n"
                                           "1.305031098675900000e+09 4 5 6 -0.5 0.5 0.5 -0.5\r\n"));
  REQUIRE(poses.size() == 2);
  CHECK(poses[0].time == nanoseconds{1305031098665900000});
  CHECK(position(poses[0].value) == Eigen::Vector3d(1, 2, 3));
  CHECK(rotation(poses[0].value).unit_quaternion().coeffs() == Eigen::Vector4d(0.5, 0.5, -0.5, 0.5));
  CHECK(poses[1].time == nanoseconds{1305031098675900000});
  CHECK(rotation(poses[1].value).unit_quaternion().coeffs() ==
        Eigen::Vector4d(0.5, -0.5, -0.5, 0.5));  // sign flip undone

  write_tum(folder / "again.txt", poses);
  CHECK(content(folder / "again.txt") ==
        "1305031098.665900000 1 2 3 0.5 0.5 -0.5 0.5\n1305031098.675900000 4 5 6 0.5 -0.5 -0.5 0.5\n");
}

TEST_CASE("bad TUM files are refused by line") {
  const test::TemporaryDirectory folder;
  const auto error_in = [&](std::string_view text) {
    const auto path = folder.write("bad.txt", text);
    return error_of<std::runtime_error>([&] { (void)read_tum(path); }).substr(path.string().size());
  };
  CHECK(error_in("1.5 1 2 3 0 0 0 1\n1.6 1 2 3 0 0 0\n") ==
        ":2: 7 columns, expected 8 of a TUM trajectory: t tx ty tz qx qy qz qw");
  CHECK(error_in("1.5 1 2 3 0 0 0 1\n1.6 1 2 3 0 0 0 0\n") ==
        ":2: quaternion with w x y z = 0 0 0 0 has norm 0, expected 1 within 0.001");
  CHECK(error_in("1.5 1 2 nan 0 0 0 1\n") == ":1: \"nan\" is not a finite number, expected tz in column 4");
  CHECK(error_in("1.5 1 2 3 0 0 0 1\n1.5 1 2 3 0 0 0 1\n") == ":2: time 1.5 follows 1.5, expected increasing t");
  // EuRoC's order of the quaternion is another one.
  CHECK(error_in("15,1,2,3,1,0,0,0\n") ==
        ":1: \"15,1,2,3,1,0,0,0\" has commas, expected a TUM trajectory separated by blanks: t tx ty tz qx qy qz qw");
}

TEST_CASE("nothing half-written") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("poses.txt", "old");
  auto poses = test::awkward_trajectory(10);
  poses[5].value.get<1>().x() = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(write_tum(path, poses), std::invalid_argument);
  CHECK_THROWS_AS(write_tum(path, std::vector<Line>{}), std::invalid_argument);
  CHECK(content(path) == "old");
  CHECK(folder.files() == 1);
  CHECK_THROWS_AS(write_tum(folder / "missing/poses.txt", test::awkward_trajectory(10)), std::runtime_error);
}

TEST_CASE("the TUM benchmark's own file is read", "[.real_data]") {
  const std::filesystem::path path = std::filesystem::path(SPLINERTIA_TEST_DATA) / "tum_freiburg1_xyz_gt.txt";
  const auto poses = read_tum(path);
  REQUIRE(poses.size() == 3000);
  CHECK(poses.front().time == nanoseconds{1305031098665900000});
  CHECK(poses.back().time == nanoseconds{1305031128755500000});
  for (const Line& line : poses) REQUIRE_THAT(rotation(line.value).unit_quaternion().norm(), WithinAbs(1, 1e-15));
}
