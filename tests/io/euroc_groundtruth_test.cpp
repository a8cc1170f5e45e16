// SPDX-License-Identifier: MIT
// Real data: euroc_V1_02_medium_gt.csv
#include <algorithm>
#include <filesystem>
#include <random>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/tum.hpp>
#include <stdexcept>
#include <vector>

#include "io/temporary_directory.hpp"
#include "io/trajectories.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;
using test::content;
using test::error_of;
using Line = Stamped<SO3xR3<double>>;

namespace {

std::vector<EurocState> states(int size) {
  std::mt19937_64 random(5);
  std::vector<EurocState> result;
  for (const Line& line : test::awkward_trajectory(size)) {
    result.push_back({{line.time, line.value},
                      test::awkward_vector(random),
                      test::awkward_vector(random),
                      test::awkward_vector(random)});
  }
  return result;
}

bool same_state(const EurocState& a, const EurocState& b) {
  return test::same(Line{a.time, a.value}, Line{b.time, b.value}) && a.velocity == b.velocity &&
         a.gyro_bias == b.gyro_bias && a.accel_bias == b.accel_bias;
}

// States that keep their pose in SE(3).
struct RigidState {
  nanoseconds time;
  Sophus::SE3d value;
  Eigen::Vector3d velocity, gyro_bias, accel_bias;
};

}  // namespace

TEST_CASE("states read back to the same bits, written at once or one by one") {
  const test::TemporaryDirectory folder;
  const auto written = states(500);
  write_euroc_groundtruth(folder / "gt.csv", written);
  const auto read = read_euroc_groundtruth(folder / "gt.csv");
  CHECK(std::equal(read.begin(), read.end(), written.begin(), written.end(), same_state));

  EurocGroundtruthWriter writer(folder / "stream.csv");
  for (const EurocState& s : written) {
    const auto pose = make_pose<Sophus::SE3d>(rotation(s.value), position(s.value));
    writer.append(RigidState{s.time, pose, s.velocity, s.gyro_bias, s.accel_bias});
  }
  struct InSeconds {
    double time;
    SO3xR3<double> value;
    Eigen::Vector3d velocity, gyro_bias, accel_bias;
  };
  write_euroc_groundtruth(folder / "s.csv",
                          std::vector<InSeconds>{{2.5, written[0].value, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}}});
  CHECK(read_euroc_groundtruth(folder / "s.csv")[0].time == nanoseconds{2'500'000'000});
  CHECK_FALSE(std::filesystem::exists(folder / "stream.csv"));
  writer.commit();
  CHECK(content(folder / "stream.csv") == content(folder / "gt.csv"));
}

TEST_CASE("states are poses for other functions") {
  const test::TemporaryDirectory folder;
  const auto written = states(20);
  STATIC_CHECK(StampedPoses<std::vector<EurocState>>);
  write_tum(folder / "gt.tum", written);
  const auto poses = read_tum(folder / "gt.tum");
  REQUIRE(poses.size() == written.size());
  CHECK(poses[7].time == written[7].time);
  CHECK(position(poses[7].value) == position(written[7].value));
  CHECK(associate(written, written).size() == written.size());
}

TEST_CASE("the file looks like EuRoC's") {
  const test::TemporaryDirectory folder;
  const EurocState state{{nanoseconds{1403715524907143168}, {Sophus::SO3d{}, Eigen::Vector3d{1, 2, 3}}},
                         {4, 5, 6},
                         {7, 8, 9},
                         {10, 11, 12}};
  write_euroc_groundtruth(folder / "gt.csv", std::vector{state});
  CHECK(content(folder / "gt.csv") ==
        "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z [],"
        "v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1],"
        "b_w_RS_S_x [rad s^-1],b_w_RS_S_y [rad s^-1],b_w_RS_S_z [rad s^-1],"
        "b_a_RS_S_x [m s^-2],b_a_RS_S_y [m s^-2],b_a_RS_S_z [m s^-2]\n"
        "1403715524907143168,1,2,3,1,0,0,0,4,5,6,7,8,9,10,11,12\n");
}

TEST_CASE("poses are read from 8 or 17 columns, by commas or blanks") {
  const test::TemporaryDirectory folder;
  for (const char* text :
       {"5,1,2,3,0.8,0.6,0,0\n6,1,2,3,-0.8,-0.6,0,0", "5 1 2 3 0.8 0.6 0 0\r\n6 1 2 3 -0.8 -0.6 0 0\r\n",
        "5,1,2,3,0.8,0.6,0,0,1,2,3,4,5,6,7,8,9\n6,1,2,3,-0.8,-0.6,0,0,1,2,3,4,5,6,7,8,9"}) {
    const auto poses = read_euroc_poses(folder.write("poses", text));
    REQUIRE(poses.size() == 2);
    CHECK(poses[0].time == nanoseconds{5});
    CHECK(position(poses[0].value) == Eigen::Vector3d(1, 2, 3));
    CHECK(rotation(poses[0].value).unit_quaternion().coeffs() == Eigen::Vector4d(0.6, 0, 0, 0.8));
    CHECK(rotation(poses[1].value).unit_quaternion().coeffs() == Eigen::Vector4d(0.6, 0, 0, 0.8));
  }
}

TEST_CASE("bad ground truth is refused by line") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "bad.csv";
  const std::string wide = "5,1,2,3,1,0,0,0,1,2,3,4,5,6,7,8,9\n", names = euroc_groundtruth_layout.names();
  const auto poses_error = [&](std::string_view text) {
    folder.write("bad.csv", text);
    return error_of<std::runtime_error>([&] { (void)read_euroc_poses(path); }).substr(path.string().size());
  };
  const auto states_error = [&](std::string_view text) {
    folder.write("bad.csv", text);
    return error_of<std::runtime_error>([&] { (void)read_euroc_groundtruth(path); }).substr(path.string().size());
  };
  CHECK(states_error("5,1,2,3,1,0,0,0\n") == ":1: 8 columns, expected 17 of EuRoC ground truth: " + names);
  CHECK(poses_error("5,1,2,3,1,0,0\n") == ":1: 7 columns, expected 8 or 17 of EuRoC ground truth: " + names);
  CHECK(poses_error(wide + "6,1,2,3,1,0,0,0\n") == ":2: 8 columns, expected 17 as in the rows before");
  CHECK(states_error(wide + "6,1,2,3,1.5,0,2,0,1,2,3,4,5,6,7,8,9\n") ==
        ":2: quaternion with w x y z = 1.5 0 2 0 has norm 2.5, expected 1 within 0.001");
  CHECK(states_error(wide + wide) == ":2: time 5 follows 5, expected increasing timestamp [ns]");
  CHECK(poses_error("5,1,2,3,1,0,0,0,1,2,3,4,5,6,7,8,NaN\n") ==
        ":1: \"NaN\" is not a finite number, expected b_a_RS_S_z [m s^-2] in column 17");
}

TEST_CASE("EuRoC's own file is read", "[.real_data]") {
  const auto path = std::filesystem::path(SPLINERTIA_TEST_DATA) / "euroc_V1_02_medium_gt.csv";
  const auto read = read_euroc_groundtruth(path);
  REQUIRE(read.size() == 16702);
  CHECK(read.front().time == nanoseconds{1403715524907143168});
  CHECK(read.front().velocity == Eigen::Vector3d(-0.002276, -0.009616, -0.005214));
  CHECK(read.back().accel_bias == Eigen::Vector3d(-0.014726, 0.105050, 0.092967));
  CHECK(read_euroc_poses(path).size() == 16702);
  // The file has eight sign flips; none is left.
  for (std::size_t i = 1; i < read.size(); ++i) {
    const auto& q = rotation(read[i].value).unit_quaternion();
    REQUIRE(q.dot(rotation(read[i - 1].value).unit_quaternion()) > 0.9);
  }
}
