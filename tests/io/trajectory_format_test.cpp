// SPDX-License-Identifier: MIT
#include <cstdint>
#include <filesystem>
#include <splinertia/io/trajectory_format.hpp>

#include <splinertia/io/trajectory.hpp>
#include <stdexcept>
#include <string>

#include "io/temporary_directory.hpp"
#include "io/trajectory_text.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using test::Dress;
using test::error_of;
using Kind = TrajectoryFormat::Kind;

namespace {

constexpr QuaternionOrder w_first = QuaternionOrder::wxyz;
constexpr TimeUnit ns = TimeUnit::nanoseconds;

/// The poses without stamps, as KITTI writes them.
std::string kitti_text() {
  std::string text;
  for (const auto& line : test::dressed_poses()) {
    const Eigen::Matrix3d R = rotation(line.value).matrix();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) text += test::number(R(i, j)) + ' ';
      text += test::number(position(line.value)[i]) + (i < 2 ? ' ' : '\n');
    }
  }
  return text;
}

/// What stands behind the stamps.
std::string without_stamps(std::string text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    result += text.substr(text.find(' ', begin) + 1, end - text.find(' ', begin));
    begin = end + 1;
  }
  return result;
}

bool same_poses(const TrajectoryFile& file, std::int64_t start) {
  return test::near_all(file.poses, test::dressed_poses({.start = start}));
}

}  // namespace

TEST_CASE("units have names") {
  CHECK(time_unit_name(TimeUnit::seconds) == "s");
  CHECK(time_unit_name(TimeUnit::milliseconds) == "ms");
  CHECK(time_unit_name(TimeUnit::microseconds) == "us");
  CHECK(time_unit_name(TimeUnit::nanoseconds) == "ns");
}

TEST_CASE("known formats describe themselves") {
  for (const KnownTrajectoryFormat& known : known_trajectory_formats) {
    CAPTURE(known.name);
    detail::ColumnPlan plan = detail::parse_columns(known.columns);
    CHECK(plan.has(detail::column::time) == known.unit.has_value());
    plan.places.resize(known.fewest_columns);
    CHECK(plan.has_pose());
  }
}

TEST_CASE("a format that is named needs no guess") {
  const test::TemporaryDirectory folder;
  const auto read = [&](const Dress& dress, Kind kind) {
    return read_trajectory(folder.write("poses", test::text_of(dress)), {.kind = kind});
  };
  const std::int64_t start = Dress{}.start;
  CHECK(same_poses(read({}, Kind::tum), start));
  CHECK(same_poses(read({.separator = ",", .unit = ns}, Kind::tum), start));
  CHECK(same_poses(read({.separator = ",", .order = w_first, .unit = ns}, Kind::euroc), start));
  CHECK(same_poses(read({.separator = " ", .order = w_first, .unit = ns}, Kind::euroc), start));
  CHECK(same_poses(read({.separator = ",", .unit = ns}, Kind::rpg), start));
  CHECK(same_poses(read({.separator = ",", .order = w_first, .unit = ns, .tail = ","}, Kind::vins), start));
  const TrajectoryFile vins = read({.separator = ",", .order = w_first, .unit = ns, .tail = ",1,2,3,"}, Kind::vins);
  CHECK(same_poses(vins, start));
  CHECK(vins.velocities.size() == 50);
  const std::string error = error_of<std::runtime_error>([&] { (void)read({.tail = " 1"}, Kind::tum); });
  CHECK(error == (folder / "poses").string() + ":1: 9 columns, expected 8 of a TUM trajectory: t,x,y,z,qx,qy,qz,qw");
}

TEST_CASE("OpenVINS states: q_GtoI of JPL has the numbers of Hamilton's q_ItoG") {
  const test::TemporaryDirectory folder;
  const Dress states{
      .header = "# timestamp(s) q p v bg ba cam_imu_dt num_cam cam0_k cam0_d cam0_rot cam0_trans .... etc",
      .tail = " 1 2 3 .1 .2 .3 .4 .5 .6 0 1 458 457",
      .edit = [](const std::string& row, int i) {
        const auto pose = test::dressed_pose(0, i).value;
        const Eigen::Quaterniond& q = rotation(pose).unit_quaternion();
        // JPL: R_GtoI = (2 w² - 1) 1 - 2 w [v]x + 2 v vT.
        const Eigen::Matrix3d skew = Sophus::SO3d::hat(q.vec());
        const Eigen::Matrix3d R_GtoI = (2 * q.w() * q.w() - 1) * Eigen::Matrix3d::Identity() - 2 * q.w() * skew +
                                       2 * q.vec() * q.vec().transpose();
        CHECK((R_GtoI.transpose() - rotation(pose).matrix()).norm() < 1e-12);
        const std::string stamp = row.substr(0, row.find(' '));
        std::string moved = stamp;
        for (const double value : {q.x(), q.y(), q.z(), q.w()}) moved += ' ' + test::number(value);
        for (int axis = 0; axis < 3; ++axis) moved += ' ' + test::number(position(pose)[axis]);
        return moved + row.substr(row.find(" 1 2 3 .1"));
      }};
  const std::string text = test::text_of(states);
  for (const std::string& content : {text, text.substr(text.find('\n') + 1)}) {
    const TrajectoryFile file = read_trajectory(folder.write("poses", content));
    CHECK(same_poses(file, Dress{}.start));
    CHECK(file.velocities.front() == Eigen::Vector3d(1, 2, 3));
    CHECK(file.gyro_biases.front() == Eigen::Vector3d(0.1, 0.2, 0.3));
    CHECK(file.accel_biases.front() == Eigen::Vector3d(0.4, 0.5, 0.6));
  }
  CHECK(same_poses(read_trajectory(folder / "poses", {.kind = Kind::openvins}), Dress{}.start));
}

TEST_CASE("files without stamps take a rate or a file of times") {
  const test::TemporaryDirectory folder;
  const auto kitti = folder.write("kitti", kitti_text());
  std::string times;
  for (int i = 0; i < 50; ++i) times += test::number(0.005 * i) + '\n';
  const auto times_file = folder.write("times.txt", times);
  CHECK(same_poses(read_trajectory(kitti, {.rate = 200}), 0));
  const TrajectoryFile timed = read_trajectory(kitti, {.times = times_file});
  CHECK(same_poses(timed, 0));
  CHECK(test::notes(timed, "KITTI poses assumed"));
  CHECK(test::notes(timed, "y points down"));
  const auto tartan = folder.write("tartan", without_stamps(test::text_of({})));
  CHECK(same_poses(read_trajectory(tartan, {.kind = Kind::tartanair, .rate = 200}), 0));

  const auto error = [&](const auto& file, const TrajectoryFormat& format) {
    return error_of<std::runtime_error>([&] { (void)read_trajectory(file, format); });
  };
  CHECK(error(kitti, {}) == kitti.string() +
                                ":1: the rows have no stamps (r11,r12,r13,x,r21,r22,r23,y,r31,r32,r33,z); give "
                                "--pose-rate or --times");
  CHECK(error(tartan, {}).find("7 columns without names") != std::string::npos);
  folder.write("times.txt", times + "1\n");
  CHECK(error(kitti, {.times = times_file}) ==
        times_file.string() + ": 51 times for the 50 rows of " + kitti.string() + ", expected one for each row");
  folder.write("times.txt", "0\n1.5\nx\n");
  CHECK(error(kitti, {.times = times_file}) ==
        times_file.string() + ":3: \"x\" is not a number of seconds, expected a time [s]");
  CHECK(error(kitti, {.times = folder / "none"}).find("No such file") != std::string::npos);
  std::string bent = kitti_text();
  bent[0] = '9';
  CHECK(error(folder.write("bent", bent), {.rate = 200}).find(":1: r11 … r33 are not a rotation") != std::string::npos);
}

TEST_CASE("formats that contradict themselves or the file are refused by the option's name") {
  const test::TemporaryDirectory folder;
  const auto file = folder.write("poses", test::text_of({}));
  const auto kitti = folder.write("kitti", kitti_text());
  const auto error = [&](const TrajectoryFormat& format, const std::filesystem::path& path) {
    return error_of<std::invalid_argument>([&] { (void)read_trajectory(path, format); });
  };
  CHECK(error({.columns = "t,x,y,z,qx,qy,qz,qa"}, file) ==
        "--columns: \"qa\" is not a column, expected names such as t,x,y,z,qx,qy,qz,qw, and - for columns to ignore");
  CHECK(error({.columns = "t,x,y,z,qx,qy,qz,t"}, file) == "--columns: t appears twice, expected once");
  CHECK(error({.columns = "t,x,y,z"}, file) ==
        "--columns: \"t,x,y,z\" is not a pose, expected x, y, z and qx, qy, qz, qw (or r11 to r33)");
  CHECK(error({.columns = "t,x,y,z,qx,qy,qz,qw,vx"}, file) ==
        "--columns: \"t,x,y,z,qx,qy,qz,qw,vx\" has only part of vx vy vz, expected all or none");
  CHECK(error({.kind = Kind::tum, .columns = "t,x,y,z,qx,qy,qz,qw"}, file) ==
        "--columns: the format fixes the columns, expected --columns or --format, not both");
  CHECK(error({.columns = "t,x,y,z,qx,qy,qz,qw", .quaternion_order = w_first}, file) ==
        "--quaternion-order: --columns gives another order, expected only one of them");
  CHECK(error({.quaternion_order = w_first, .rate = 10}, kitti) ==
        "--quaternion-order: " + kitti.string() + " has no quaternions, expected some");
  CHECK(error({.rate = 10}, file) ==
        "--pose-rate: " + file.string() + " has stamps of its own, expected a file without");
  CHECK(error({.times = file}, file) ==
        "--times: " + file.string() + " has stamps of its own, expected a file without");
  CHECK(error({.rate = 10, .times = file}, kitti) == "--pose-rate and --times: expected only one of them");
  CHECK(error({.rate = 0}, kitti) == "--pose-rate: 0, expected a positive number of Hz, up to 1e9");
  CHECK(error({.rate = 1e-9}, kitti) ==
        "--pose-rate: at 1e-09 Hz the time of row 10 is 1e+10 s, expected at most 9e+09");
  CHECK(error({.time_unit = ns, .rate = 10}, kitti) ==
        "--time-unit and --pose-rate: the file has no stamps, expected --pose-rate only");
  CHECK(error_of<std::runtime_error>([&] { (void)read_trajectory(file, {.columns = "t,x,y,z,qx,qy,qz,qw,-"}); }) ==
        file.string() + ":1: 8 columns, expected 9 of --columns t,x,y,z,qx,qy,qz,qw,-");
  CHECK(read_trajectory(file, {.columns = "t,x,y,z,qx,qy,qz,qw,..."}).poses.size() == 50);
}
