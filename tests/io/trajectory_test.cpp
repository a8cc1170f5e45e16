// SPDX-License-Identifier: MIT
// Real data: tum_freiburg1_xyz_gt.txt euroc_V1_02_medium_gt.csv euroc_MH_05_pair/gt.csv
#include <algorithm>
#include <cstddef>
#include <splinertia/io/trajectory.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/tum.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/temporary_directory.hpp"
#include "io/trajectories.hpp"
#include "io/trajectory_text.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using test::Dress;
using test::error_of;
using Line = Stamped<SO3xR3<double>>;

namespace {

constexpr QuaternionOrder w_first = QuaternionOrder::wxyz, w_last = QuaternionOrder::xyzw;
constexpr TimeUnit ns = TimeUnit::nanoseconds;

struct Folder : test::TemporaryDirectory {
  TrajectoryFile read(std::string_view text, const TrajectoryFormat& format = {}) const {
    return read_trajectory(write("poses", text), format);
  }
  TrajectoryFile read(const Dress& dress, const TrajectoryFormat& format = {}) const {
    return read(test::text_of(dress), format);
  }
  /// The message behind the path.
  std::string error_in(std::string_view text, const TrajectoryFormat& format = {}) const {
    const std::string message = error_of<std::runtime_error>([&] { (void)read(text, format); });
    return message.substr(std::min(message.size(), (*this / "poses").string().size()));
  }
  std::string error_in(const Dress& dress, const TrajectoryFormat& format = {}) const {
    return error_in(test::text_of(dress), format);
  }
};

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace

TEST_CASE("what the writers wrote reads back to the same bits") {
  const Folder folder;
  const auto poses = test::awkward_trajectory(300);
  write_tum(folder / "a.csv", poses);
  EurocGroundtruthWriter euroc(folder / "b.txt");
  for (const Line& line : poses) euroc.append(EurocState{{line.time, line.value}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  euroc.commit();
  CHECK(test::same_all(read_trajectory(folder / "a.csv").poses, poses));
  const TrajectoryFile states = read_trajectory(folder / "b.txt");
  CHECK(test::same_all(states.poses, poses));
  CHECK(states.velocities == std::vector<Eigen::Vector3d>(300, {1, 2, 3}));
  CHECK(states.gyro_biases == std::vector<Eigen::Vector3d>(300, {4, 5, 6}));
  CHECK(states.accel_biases == std::vector<Eigen::Vector3d>(300, {7, 8, 9}));
}

TEST_CASE("a header is honoured, however it spells the names") {
  const Folder folder;
  for (const char* names :
       {"# timestamp, x, y, z, qx, qy, qz, qw", "#timestamp [ns],tx [m],ty [m],tz [m],qx,qy,qz,qw",
        "timestamp,p_x,p_y,p_z,q_x,q_y,q_z,q_w", "#timestamp [ns], x [m], y [m], z [m], q.x, q.y, q.z, q.w",
        "# time(ns) px py pz qx qy qz qw",
        "Time,Position.X,Position.Y,Position.Z,orientation.x,orientation.y,"
        "orientation.z,orientation.w",
        "t,pos_x,pos_y,pos_z,quat_x,quat_y,quat_z,quat_w", "# t [ns] tx [m] ty [m] tz [m] qx qy qz qw",
        "\"stamp\",\"x\",\"y\",\"z\",\"qx\",\"qy\",\"qz\",\"w\"",
        "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_x [], q_RS_y [], q_RS_z [], q_RS_w []",
        "timestamp_ns,p_WS_W_x,p_WS_W_y,p_WS_W_z,q_WS_x,q_WS_y,q_WS_z,q_WS_w",
        "# a comment\n# timestamp tx ty tz qx qy qz qw\n# another", "\xEF\xBB\xBFtimestamp,x,y,z,qx,qy,qz,qw,\r"}) {
    CAPTURE(names);
    const Dress dress{.header = names, .separator = ",", .unit = ns};
    const TrajectoryFile file = folder.read(dress);
    CHECK(test::near_all(file.poses, test::dressed_poses()));
    CHECK(test::notes(file, "columns are t,x,y,z,qx,qy,qz,qw according to the names in line "));
  }
  const Dress w{.header = "timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z", .separator = ",", .order = w_first, .unit = ns};
  CHECK(test::near_all(folder.read(w).poses, test::dressed_poses()));
}

TEST_CASE("columns that a header names otherwise are passed over, texts as well") {
  const Folder folder;
  const Dress ros{.header =
                      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.pose.pose.position.x,"
                      "field.pose.pose.position.y,field.pose.pose.position.z,field.pose.pose.orientation.x,"
                      "field.pose.pose.orientation.y,field.pose.pose.orientation.z,field.pose.pose.orientation.w,"
                      "field.twist.twist.linear.x,field.pose.covariance0",
                  .separator = ",",
                  .unit = ns,
                  .tail = ",7,nan",
                  .edit = [](const std::string& row, int i) {
                    return std::to_string(i) + "," + std::to_string(i) + "," + row.substr(0, 19) + ",odom frame" +
                           row.substr(19);
                  }};
  CHECK(test::near_all(folder.read(ros).poses, test::dressed_poses()));
  const Dress index{.header = ",timestamp,x,y,z,qx,qy,qz,qw",
                    .separator = ",",
                    .unit = ns,
                    .edit = [](const std::string& row, int i) { return std::to_string(i) + "," + row; }};
  CHECK(test::near_all(folder.read(index).poses, test::dressed_poses()));
  const Dress covariance{.header = "# timestamp(s) tx ty tz qx qy qz qw Pr11 Pr12 Pr13 Pr22 Pr23 Pr33"};
  CHECK(test::near_all(folder.read(covariance).poses, test::dressed_poses()));
}

TEST_CASE("a header that names no poses is refused, in a comment it is none") {
  const Folder folder;
  const Dress dress{.header = "t,x,y,z,roll,pitch,yaw,w2", .separator = ",", .unit = ns};
  CHECK(folder.error_in(dress) ==
        ":1: \"t,x,y,z,roll,pitch,yaw,w2\" does not name the columns of poses such as t,x,y,z,qx,qy,qz,qw; give "
        "--columns");
  CHECK(test::near_all(folder.read(dress, {.columns = "t,x,y,z,qx,qy,qz,qw"}).poses, test::dressed_poses()));
  CHECK(test::near_all(folder.read(Dress{.header = "# x y z of the body"}).poses, test::dressed_poses()));
  CHECK(has(folder.error_in(Dress{.header = "t,x,y,z,qx,qy,qz,qw,x", .separator = ",", .tail = ",1"}), "--columns"));
  CHECK(has(folder.error_in(Dress{.header = "t,x,y,z,qx,qy,qz,qw", .separator = ",", .tail = ",1"}),
            ":2: 9 columns, expected 8 of the names in line 1 (--columns)"));
}

TEST_CASE("an empty last field is taken") {
  const Folder folder;
  const Dress dress{
      .header = "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z", .separator = ",", .order = w_first, .unit = ns, .tail = ","};
  CHECK(test::near_all(folder.read(dress).poses, test::dressed_poses()));
}

TEST_CASE("an order that nothing tells is refused, and can be stated") {
  const Folder folder;
  for (const char* separator : {",", " "}) {
    const Dress dress{.separator = separator, .unit = ns};
    const std::string error = folder.error_in(dress);
    CAPTURE(error);
    CHECK(has(error, ":1: the order of the quaternion is unknown"));
    CHECK(has(error, "with w first"));
    CHECK(has(error, "17.19 deg about (0 1 0) with w last; give --quaternion-order wxyz or xyzw"));
    for (const QuaternionOrder order : {w_first, w_last}) {
      const TrajectoryFile file =
          folder.read(Dress{.separator = separator, .order = order, .unit = ns}, {.quaternion_order = order});
      CHECK(test::near_all(file.poses, test::dressed_poses()));
      CHECK(test::notes(file, order == w_last ? "t,x,y,z,qx,qy,qz,qw assumed" : "t,x,y,z,qw,qx,qy,qz assumed"));
    }
    CHECK(test::near_all(folder.read(dress, {.kind = TrajectoryFormat::Kind::rpg}).poses, test::dressed_poses()));
    CHECK(test::near_all(folder.read(dress, {.columns = "t,x,y,z,qx,qy,qz,qw"}).poses, test::dressed_poses()));
  }
  CHECK(has(folder.error_in(Dress{.separator = ","}), "--quaternion-order"));  // seconds with commas
  const Dress named{.header = "# timestamp, x, y, z, qx, qy, qz, qw", .separator = ",", .order = w_first, .unit = ns};
  const TrajectoryFile stated = folder.read(named, {.quaternion_order = w_first});  // the user knows better
  CHECK(test::near_all(stated.poses, test::dressed_poses()));
  CHECK(test::notes(stated, "--quaternion-order is used, although t,x,y,z,qx,qy,qz,qw was expected"));
}

TEST_CASE("the other order gives a motion as smooth: the attitude cannot tell") {
  // R' = A R⁻¹ B: the steps of one are the negative steps of the other, turned alike at each pose.
  const auto poses = test::dressed_poses({.rows = 200});
  std::vector<Sophus::SO3d> right, wrong;
  for (const Line& line : poses) {
    const Eigen::Quaterniond& q = rotation(line.value).unit_quaternion();
    right.push_back(rotation(line.value));
    wrong.push_back(rotation_from_unit_quaternion<double>(Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())));
  }
  for (std::size_t i = 2; i < right.size(); ++i) {
    const Eigen::Vector3d a = increment(right[i - 2], right[i - 1]), b = increment(right[i - 1], right[i]);
    const Eigen::Vector3d c = increment(wrong[i - 2], wrong[i - 1]), d = increment(wrong[i - 1], wrong[i]);
    CHECK_THAT(a.norm() - c.norm(), WithinAbs(0, 1e-13));
    CHECK_THAT((b - a).norm() - (d - c).norm(), WithinAbs(0, 1e-13));
  }
}

TEST_CASE("TUM is assumed for 8 columns between blanks, and said") {
  const Folder folder;
  for (const TimeUnit unit : {TimeUnit::seconds, TimeUnit::milliseconds, TimeUnit::microseconds}) {
    const TrajectoryFile file = folder.read(Dress{.unit = unit});
    CHECK(test::near_all(file.poses, test::dressed_poses()));
    CHECK(test::notes(file, "a TUM trajectory assumed, t,x,y,z,qx,qy,qz,qw (--quaternion-order)"));
    CHECK(test::notes(file, "digits are taken as") == (unit != TimeUnit::seconds));
  }
  CHECK(
      test::near_all(folder.read(Dress{.order = w_first}, {.quaternion_order = w_first}).poses, test::dressed_poses()));
}

TEST_CASE("units of time are told by digits and rate, or refused") {
  const Folder folder;
  const Dress whole{.rows = 120, .step = 1'000'000'000, .stamp = [](int i) { return std::to_string(1600000000 + i); }};
  CHECK(test::near_all(folder.read(whole).poses, test::dressed_poses(whole)));
  const Dress small{.stamp = [](int i) { return std::to_string(i); }};
  CHECK(folder.error_in(small) ==
        ":1: the unit of the stamps is unknown: the poses would have 1 Hz in s, 1000 Hz in ms, 1e+06 Hz in us, "
        "1e+09 Hz in "
        "ns; give --time-unit s, ms, us or ns");
  CHECK(folder.read(small, {.time_unit = TimeUnit::milliseconds}).poses[7].time == std::chrono::milliseconds(7));
  // Ten digits that are nanoseconds: as seconds, the poses would be months apart.
  const Dress relative{.separator = ",", .start = 1'000'000'000, .stamp = [](int i) {
                         return std::to_string(1'000'000'000 + 5'000'000LL * i);
                       }};
  CHECK(has(folder.error_in(relative, {.quaternion_order = w_last}), "--time-unit"));
  CHECK(test::near_all(folder.read(relative, {.kind = TrajectoryFormat::Kind::rpg}).poses,
                       test::dressed_poses(relative)));
  // A unit in the header is believed, but for what no poses are.
  const Dress named{.header = "t [ns],x,y,z,qx,qy,qz,qw", .separator = ",", .start = 0, .stamp = [](int i) {
                      return std::to_string(5'000'000LL * i);
                    }};
  CHECK(test::near_all(folder.read(named).poses, test::dressed_poses(named)));
  const Dress wrong{
      .header = "t [ns],x,y,z,qx,qy,qz,qw", .separator = ",", .stamp = [](int i) { return std::to_string(i); }};
  CHECK(has(folder.error_in(wrong), ":2: stamps in ns give an implausible rate: the poses would have 1 Hz in s"));
  CHECK(folder.read(wrong, {.time_unit = TimeUnit::seconds}).poses.size() == 50);
  const Dress slow{.stamp = [](int i) { return std::to_string(200 * i) + ".5"; }};
  CHECK(has(folder.error_in(slow), "--time-unit"));
  const Dress scientific{.separator = ",",
                         .stamp = [](int i) { return "1.600000000" + std::to_string(100 + 5 * i) + "e+18"; }};
  CHECK(folder.read(scientific, {.quaternion_order = w_last}).poses[1].time.count() == 1600000000105000000);
}

TEST_CASE("formats are told by their shape") {
  const Folder folder;
  const Dress euroc{.separator = ",", .order = w_first, .unit = ns, .tail = ",1,2,3,4,5,6,7,8,9"};
  TrajectoryFile file = folder.read(euroc);
  CHECK(test::near_all(file.poses, test::dressed_poses()));
  CHECK(file.velocities.size() == 50);
  CHECK(test::notes(file, "EuRoC ground truth assumed"));
  const Dress vins{.separator = ",", .order = w_first, .unit = ns, .tail = ",1,2,3,"};
  file = folder.read(vins);
  CHECK(test::near_all(file.poses, test::dressed_poses()));
  CHECK(file.velocities.front() == Eigen::Vector3d(1, 2, 3));
  CHECK(file.gyro_biases.empty());
  CHECK(test::notes(file, "VINS odometry assumed"));
  CHECK(folder.error_in("1,2,3\n4,5,6\n") ==
        ":1: 3 columns without names: not a known trajectory format; give --columns, or --format (tum, "
        "euroc, kitti, vins, openvins, rpg, tartanair)");
  CHECK(has(folder.error_in(Dress{.tail = " 1"}), ":1: 9 columns without names"));
  CHECK(folder.error_in("") == ": no rows, expected the poses of a trajectory");
  CHECK(folder.error_in("# t x y z qx qy qz qw\n") == ":1: no rows, expected the poses of a trajectory");
  CHECK_THROWS_AS(read_trajectory(folder / "missing"), std::runtime_error);
}

TEST_CASE("velocities that are all zero count as none") {
  const Folder folder;
  const Dress zeros{.separator = ",", .order = w_first, .unit = ns, .tail = ",0,0,0,0,0,0,0.0,0,0"};
  TrajectoryFile file = folder.read(zeros);
  CHECK(file.velocities.empty());
  CHECK(file.gyro_biases.empty());
  CHECK(test::notes(file, "velocities and biases are all zero: the file is read as if it had none"));
  const Dress biases{.separator = ",", .order = w_first, .unit = ns, .tail = ",0,0,0,0,0,0,1,0,0"};
  file = folder.read(biases);
  CHECK(file.velocities.empty());
  CHECK(file.accel_biases.size() == 50);
}

TEST_CASE("a pipe is read once, from its first byte") {
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    std::string row = std::to_string(100 + i / 100) + '.' + std::to_string(100 + i % 100).substr(1) + " 0 0 0 0 0 0 1";
    text += row + std::string(63 - row.size(), ' ') + '\n';
  }
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t writer = ::fork();
  if (writer == 0) {
    ::close(ends[0]);
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t written = ::write(ends[1], text.data() + at, std::min<std::size_t>(1000, text.size() - at));
      if (written <= 0) ::_exit(1);
      at += static_cast<std::size_t>(written);
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  const TrajectoryFile file = read_trajectory("/dev/fd/" + std::to_string(ends[0]));
  ::close(ends[0]);
  int status = 1;
  ::waitpid(writer, &status, 0);
  CHECK(status == 0);
  CHECK(file.poses.size() == 3000);
  CHECK(file.poses.back().time - file.poses.front().time == std::chrono::milliseconds(29990));
}

TEST_CASE("recorded trajectories of either format are read", "[.real_data]") {
  const std::filesystem::path folder = SPLINERTIA_TEST_DATA;
  CHECK(read_trajectory(folder / "tum_freiburg1_xyz_gt.txt").poses.size() == 3000);
  CHECK(read_trajectory(folder / "euroc_V1_02_medium_gt.csv").velocities.size() == 16702);
  CHECK(read_trajectory(folder / "euroc_MH_05_pair/gt.csv").poses.size() == 22212);
}
