// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <functional>
#include <splinertia/io/trajectory.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "io/trajectory_text.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using test::Dress;
using test::error_of;

namespace {

using Stamp = std::function<std::string(int)>;

/// Epoch seconds, but for one row.
Stamp except(int row, const std::string& stamp) {
  return [=](int i) { return i == row ? stamp : "1600000000." + std::to_string(1000 + 5 * i).substr(1); };
}

struct Folder : test::TemporaryDirectory {
  std::string strict(const Dress& dress) const {
    const auto path = write("poses", test::text_of(dress));
    const std::string message = error_of<std::runtime_error>([&] { (void)read_trajectory(path); });
    return message.substr(std::min(message.size(), path.string().size()));
  }
  TrajectoryFile skipping(const Dress& dress) const {
    return read_trajectory(write("poses", test::text_of(dress)), {.skip_bad_rows = true});
  }
};

const std::string hint = " (--skip-bad-rows leaves such rows out)";

}  // namespace

TEST_CASE("bad rows are all counted, and the first ones named") {
  const Folder folder;
  const Dress dirty{.edit = [](const std::string& row, int i) {
    const std::size_t last = row.rfind(' ');
    if (i == 5) return row.substr(0, last);
    if (i == 9 || i == 10) return row.substr(0, last) + " nan";
    if (i == 20) return row.substr(0, last) + " 7";
    if (i == 30) return row + " 1";
    if (i == 40) return row.substr(0, last) + " 1x";
    return row;
  }};
  const std::string error = folder.strict(dirty);
  CHECK(error.starts_with(
      ":6: 7 columns, expected 8: t,x,y,z,qx,qy,qz,qw; 6 of 50 rows are bad: line 10: \"nan\" is not a "
      "finite number, expected qw in column 8, line 11: "));
  CHECK(error.find("line 21: quaternion with w x y z = 7") != std::string::npos);
  CHECK(error.ends_with("line 31: 9 columns, expected 8: t,x,y,z,qx,qy,qz,qw, …" + hint));
  const TrajectoryFile file = folder.skipping(dirty);
  CHECK(file.poses.size() == 44);
  CHECK(test::notes(file,
                    "6 rows left out: 3 malformed, 2 with NaN or infinity, 1 with no unit quaternion or rotation "
                    "matrix; the first is line 6: 7 columns"));
}

TEST_CASE("a file without good rows is not helped by leaving them out") {
  const Folder folder;
  const Dress bad{.rows = 3, .edit = [](const std::string& row, int) { return row.substr(0, row.rfind(' ')) + " 9"; }};
  const std::string error = folder.strict(bad);
  CHECK(error.find("3 of 3 rows are bad") != std::string::npos);
  CHECK(error.find("--skip-bad-rows") == std::string::npos);
  CHECK_THROWS_AS(folder.skipping(bad), std::runtime_error);
}

TEST_CASE("stamps that are there twice or out of order") {
  const Folder folder;
  const Dress twice{.stamp = except(30, "1600000000.145")};
  CHECK(folder.strict(twice) ==
        ":31: time 1600000000.145 s follows 1600000000.145 s in line 30, expected increasing times" + hint);
  TrajectoryFile file = folder.skipping(twice);
  CHECK(file.poses.size() == 49);
  CHECK(test::notes(file, "1 row left out: 1 with the stamp of another row"));
  CHECK(file.poses[29].time == std::chrono::nanoseconds{1600000000145000000});
  CHECK(position(file.poses[29].value) == position(test::dressed_pose(0, 29).value));

  const Dress back{.stamp = except(30, "1600000000.1")};
  CHECK(folder.strict(back) ==
        ":31: time 1600000000.1 s follows 1600000000.145 s in line 30, expected increasing times" + hint);
  CHECK(test::notes(folder.skipping(back), "1 with a stamp out of order"));

  // One stamp from the future is one bad row, not all that follow.
  const Dress future{.stamp = except(30, "1700000000.0")};
  CHECK(folder.strict(future) ==
        ":31: time 1700000000 s comes before 1600000000.155 s in line 32, expected increasing times" + hint);
  CHECK(folder.skipping(future).poses.size() == 49);
  const Dress first{.stamp = except(0, "1600000001.5")};
  CHECK(folder.strict(first) ==
        ":1: time 1600000001.5 s comes before 1600000000.005 s in line 2, expected increasing times" + hint);
  CHECK(folder.skipping(first).poses.size() == 49);
}

TEST_CASE("one absurd stamp is named as that") {
  const Folder folder;
  const Dress first{.stamp = except(0, "0.5")};
  CHECK(folder.strict(first) ==
        ":1: stamps step from 0.5 s to 1600000000.005 s in line 2, the rest span 0.24 s" + hint);
  TrajectoryFile file = folder.skipping(first);
  CHECK(file.poses.size() == 49);
  CHECK(test::notes(file, "1 row left out: 1 with a stamp far from all others; the first is line 1"));
  const Dress last{.stamp = except(49, "1700000000.5")};
  CHECK(folder.strict(last) ==
        ":50: stamps step from 1600000000.24 s to 1700000000.5 s in line 50, the rest span 0.24 s" + hint);
  CHECK(folder.skipping(last).poses.size() == 49);
  const Dress both{.stamp = [](int i) { return i == 0 ? "0.0" : except(49, "2600000000.5")(i); }};
  CHECK(folder.skipping(both).poses.size() == 48);
  // A hole is none of these, however long beside a short recording.
  const Dress hole{
      .stamp = [](int i) { return std::to_string(i < 20 ? 0 : 3000) + "." + std::to_string(1000 + 5 * i).substr(1); }};
  CHECK(folder.skipping(hole).poses.size() == 50);
  // Half of the stamps since 1970, half since the start of the machine: not one wrong stamp, and no recording.
  const Dress half{.stamp = [](int i) {
    return std::to_string(i < 20 ? 0 : 1600000000) + "." + std::to_string(1000 + 5 * i).substr(1);
  }};
  CHECK(folder.strict(half) ==
        ":20: stamps step from 0.095 s to 1600000000.1 s in line 21: more than ten years, expected the "
        "poses of one recording");
}

TEST_CASE("spans that integers cannot count are refused") {
  const Folder folder;
  const Dress wide{.rows = 5, .stamp = [](int i) {
                     return std::vector<std::string>{"-9000000000.0", "-8999999999.0", "0.5", "8999999999.0",
                                                     "9000000000.0"}[static_cast<std::size_t>(i)];
                   }};
  CHECK(folder.strict(wide) ==
        ": the poses span more than 292 years, from -9000000000 s in line 1 to 9000000000 s in line 5");
  CHECK_THROWS_AS(folder.skipping(wide), std::runtime_error);
  const Dress beyond{.stamp = except(7, "1e11")};
  CHECK(folder.strict(beyond) == ":8: \"1e11\" does not fit in 64-bit nanoseconds, expected t [s] in column 1" + hint);
  const Dress us{.rows = 3, .stamp = [](int i) { return "9999999999999999" + std::to_string(i); }};
  const auto path = folder.write("poses", test::text_of(us));
  CHECK(error_of<std::runtime_error>([&] {
          (void)read_trajectory(path, {.time_unit = TimeUnit::microseconds});
        }).find("does not fit in 64-bit nanoseconds, expected t [us] in column 1") != std::string::npos);
}

TEST_CASE("numbers as people write them are read") {
  const Folder folder;
  const auto path = folder.write("poses", "0.0\t1 2  3   0 0 0 1\n0.005 +1 2. 3 -0 0 0 +1\n  0.01 1e0 2 3 0 0 0 1  \n");
  const TrajectoryFile file = read_trajectory(path);
  REQUIRE(file.poses.size() == 3);
  for (const auto& line : file.poses) CHECK(position(line.value) == Eigen::Vector3d(1, 2, 3));
  CHECK_THROWS_AS(read_trajectory(folder.write("poses", "0.0 1 2 3 0 0 0 1\n0.5 1 2 0x3 0 0 0 1\n")),
                  std::runtime_error);
}
