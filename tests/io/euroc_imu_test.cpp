// SPDX-License-Identifier: MIT
// Real data: euroc_MH_05_pair/imu0.txt
#include <chrono>
#include <filesystem>
#include <limits>
#include <random>
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/spline.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;
using test::content;
using test::error_of;

namespace {

std::vector<ImuSample<double, nanoseconds>> samples(int size) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Eigen::Vector3d::NullaryExpr([&] { return normal(random); }).eval(); };
  std::vector<ImuSample<double, nanoseconds>> result;
  for (int i = 0; i < size; ++i)
    result.push_back({nanoseconds{1403636579758555392 + 5'000'000LL * i}, vector(), vector()});
  return result;
}

}  // namespace

TEST_CASE("samples read back to the same bits, written at once or one by one") {
  const test::TemporaryDirectory folder;
  const auto written = samples(1000);
  write_euroc_imu(folder / "imu.csv", written);
  const auto read = read_euroc_imu(folder / "imu.csv");
  REQUIRE(read.size() == written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    REQUIRE(read[i].time == written[i].time);
    REQUIRE(read[i].gyro == written[i].gyro);
    REQUIRE(read[i].accel == written[i].accel);
  }
  EurocImuWriter writer(folder / "stream.csv");
  for (const ImuSample<double, nanoseconds>& sample : written) writer.append(sample);
  CHECK_FALSE(std::filesystem::exists(folder / "stream.csv"));
  writer.commit();
  CHECK(content(folder / "stream.csv") == content(folder / "imu.csv"));
}

TEST_CASE("a simulation along a curve in seconds is written as it is") {
  const test::TemporaryDirectory folder;
  const Imu imu{ErrorModel{WhiteNoise{0.01}}, ErrorModel{}, ErrorModel{StampJitter{1e-3}}};
  const auto run = simulate(Ellipse<>{}, imu, {.rate = 200, .seed = 1, .start = 1.4e9, .end = 1.4e9 + 1});
  write_euroc_imu(folder / "imu.csv", run);
  const auto read = read_euroc_imu(folder / "imu.csv");
  REQUIRE(read.size() == 201);
  auto sample = run.begin();
  for (std::size_t i = 0; i < read.size(); ++i, ++sample) {
    REQUIRE(read[i].time == to_nanoseconds(sample->time));
    REQUIRE(read[i].gyro == sample->gyro);
    REQUIRE(read[i].accel == sample->accel);
  }
}

TEMPLATE_TEST_CASE("times of any kind are written in nanoseconds", "", float, double, long double,
                   std::chrono::duration<int>, std::chrono::milliseconds) {
  struct Sample {
    const TestType time;
    Eigen::Vector3f gyro, accel;
  };
  const test::TemporaryDirectory folder;
  write_euroc_imu(folder / "imu.csv",
                  std::vector<Sample>{{TestType(-3), {1, 2, 3}, {4, 5, 6}}, {TestType(2), {1, 2, 3}, {4, 5, 7}}});
  const auto read = read_euroc_imu(folder / "imu.csv");
  REQUIRE(read.size() == 2);
  CHECK(read[0].time == to_nanoseconds(TestType(-3)));
  CHECK(read[1].time == to_nanoseconds(TestType(2)));
  CHECK(read[1].accel == Eigen::Vector3d(4, 5, 7));
}

TEST_CASE("what simulate() yields is written as it comes, whatever its time") {
  const test::TemporaryDirectory folder;
  const Ellipse<> motion;  // in seconds
  const auto readings = simulate(motion, Imu{}, {.rate = 100, .start = 0.0, .end = 1.0});
  write_euroc_imu(folder / "imu.csv", readings);
  const std::vector<ImuSample<double, nanoseconds>> read = read_euroc_imu(folder / "imu.csv");
  REQUIRE(read.size() == 101);
  auto reading = readings.begin();
  for (const auto& sample : read) {
    CHECK(sample.time == to_nanoseconds(reading->time));
    CHECK(sample.gyro == reading->gyro);
    CHECK(sample.accel == reading->accel);
    ++reading;
  }
  const std::vector<SO3xR3<double>> points(8);
  const Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>> curve(
      {.start = nanoseconds(1'400'000'000'000'000'001), .interval = nanoseconds(100'000'000)}, points);
  write_euroc_imu(folder / "ns.csv", simulate(curve, Imu{}, {.rate = 100}));
  CHECK(read_euroc_imu(folder / "ns.csv").front().time.count() == 1'400'000'000'000'000'001);
}

TEST_CASE("times that are no numbers, or the same nanosecond, are refused") {
  const test::TemporaryDirectory folder;
  const auto error = [&](double first, double second) {
    return error_of<std::invalid_argument>([&] {
      EurocImuWriter writer(folder / "imu.csv");
      for (const double time : {first, second})
        writer.append(ImuReading{{time, {1, 2, 3}, {4, 5, 6}}, {0, 0, 0}, {0, 0, 0}});
    });
  };
  CHECK(error(0, std::numeric_limits<double>::quiet_NaN()).find("nan") != std::string::npos);
  CHECK(error(0, std::numeric_limits<double>::infinity()).find("inf") != std::string::npos);
  CHECK(error(1, 1 + 1e-10).find("time 1000000000 ns follows 1000000000 ns") != std::string::npos);
}

TEST_CASE("comments between samples are passed over when they are read") {
  const test::TemporaryDirectory folder;
  const auto written = samples(3);
  EurocImuWriter writer(folder / "imu.csv");
  writer.append(written[0]);
  writer.comment("no poses, the readings are invented");
  for (const std::size_t i : {1u, 2u}) writer.append(written[i]);
  writer.commit();
  CHECK(content(folder / "imu.csv").find("\n# no poses, the readings are invented\n1403636579763555392,") !=
        std::string::npos);
  const auto read = read_euroc_imu(folder / "imu.csv");
  REQUIRE(read.size() == 3);
  CHECK(read[1].gyro == written[1].gyro);
}

TEST_CASE("the file looks like EuRoC's") {
  const test::TemporaryDirectory folder;
  write_euroc_imu(folder / "imu.csv", std::vector<ImuSample<double, nanoseconds>>{
                                          {nanoseconds{1403636579758555392}, {-0.5, 0.25, 3}, {8.5, -0.125, 0}}});
  CHECK(content(folder / "imu.csv") ==
        "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
        "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n"
        "1403636579758555392,-0.5,0.25,3,8.5,-0.125,0\n");
}

TEST_CASE("bad IMU files are refused by line") {
  const test::TemporaryDirectory folder;
  const auto error_in = [&](std::string_view text) {
    const auto path = folder.write("bad.csv", text);
    return error_of<std::runtime_error>([&] { (void)read_euroc_imu(path); }).substr(path.string().size());
  };
  CHECK(error_in("5 1 2 3 4 5\n") ==
        ":1: 6 columns, expected 7 of EuRoC IMU samples: timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],"
        "w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]");
  CHECK(error_in("5 1 2 3 4 5 6\n4 1 2 3 4 5 6\n") == ":2: time 4 follows 5, expected increasing timestamp [ns]");
  CHECK(error_in("5,1,2,3,4,5,inf\n") == ":1: \"inf\" is not a finite number, expected a_RS_S_z [m s^-2] in column 7");
  CHECK(error_in("1.5,1,2,3,4,5,6\n") == ":1: \"1.5\" is not an integer, expected timestamp [ns] in column 1");
}

TEST_CASE("nothing half-written") {
  const test::TemporaryDirectory folder;
  auto bad = samples(1000);
  bad[900].gyro.y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(write_euroc_imu(folder / "imu.csv", bad), std::invalid_argument);
  CHECK(folder.files() == 0);
}

TEST_CASE("a recorded IMU file is read", "[.real_data]") {
  const auto path = std::filesystem::path(SPLINERTIA_TEST_DATA) / "euroc_MH_05_pair/imu0.txt";
  const auto imu = read_euroc_imu(path);
  REQUIRE(imu.size() == 22721);
  CHECK(imu.front().time == nanoseconds{1403638518097829376});
  CHECK(imu.front().gyro == Eigen::Vector3d(0.00069813170079773186, 0.018849555921538759, 0.07819075048934597));
  CHECK(imu.back().accel == Eigen::Vector3d(8.6216797916666668, 0.75184316666666662, -3.702010375));
}
