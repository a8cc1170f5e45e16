// SPDX-License-Identifier: MIT
#include "../../tools/support/imu_noise.hpp"

#include <splinertia/errors/noise/correlated_noise.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

namespace test = splinertia::test;

namespace {

ImuNoise some_noise() {
  ImuNoise noise;
  noise.gyro_noise_density = 0.015;
  noise.gyro_random_walk = 5e-5;
  noise.accel_noise_density = 1.0 / 53;
  noise.accel_random_walk = 7.1234567890123e-4;
  noise.update_rate = 400;
  noise.topic = "/alphasense/imu";
  return noise;
}

void check_same_noise(const ImuNoise& a, const ImuNoise& b) {
  const double margin = 1e-15;
  CHECK(a.gyro_noise_density == Approx(b.gyro_noise_density).epsilon(margin));
  CHECK(a.gyro_random_walk == Approx(b.gyro_random_walk).epsilon(margin));
  CHECK(a.accel_noise_density == Approx(b.accel_noise_density).epsilon(margin));
  CHECK(a.accel_random_walk == Approx(b.accel_random_walk).epsilon(margin));
  CHECK(a.update_rate == b.update_rate);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The rest of the line that begins with a key.
std::string value_of(const std::string& text, const std::string& key) {
  for (const std::string& line : lines_of(text)) {
    const auto start = line.find_first_not_of(' ');
    if (start != std::string::npos && line.substr(start).starts_with(key + ": ")) {
      return line.substr(start + key.size() + 2);
    }
  }
  return "no " + key;
}

ImuNoise read(const std::string& text, std::optional<double> rate = std::nullopt) {
  const test::TemporaryDirectory folder;
  return read_imu_noise(folder.write("noise.yaml", text), rate);
}

std::string refusal(const std::string& text, std::optional<double> rate = std::nullopt) {
  const std::string error = test::error_of<std::runtime_error>([&] { return read(text, rate); });
  const auto name = error.find("noise.yaml");
  return name == std::string::npos ? error : error.substr(name);
}

const std::string kalibr_densities =
    "gyroscope_noise_density: 1.0e-3\ngyroscope_random_walk: 2.0e-5\naccelerometer_noise_density: 1.0e-2\n"
    "accelerometer_random_walk: 3.0e-4\n";

}  // namespace

TEST_CASE("What is written for an estimator is read to the same densities") {
  for (const Estimator estimator : estimators) {
    CAPTURE(name(estimator));
    ImuNoise noise = some_noise();
    for (const double rate : {400.0, 199.9873}) {
      noise.update_rate = rate;
      const ImuNoise again = read(imu_noise_text(estimator, noise, {"a comment"}));
      check_same_noise(again, noise);
      CHECK_FALSE(again.gyro_misalignment);
      CHECK_FALSE(again.accel_misalignment);
      CHECK_FALSE(again.g_sensitivity);
      const bool names_topic = estimator != Estimator::orbslam3 && estimator != Estimator::gtsam;
      CHECK(again.topic == (names_topic ? noise.topic : "/imu0"));
    }
  }
}

TEST_CASE("Each estimator gets the unit that it takes") {
  const ImuNoise noise = some_noise();
  const auto value = [&](Estimator estimator, const std::string& key) {
    return value_of(imu_noise_text(estimator, noise), key);
  };
  for (const Estimator estimator : {Estimator::kalibr, Estimator::openvins}) {
    CHECK(value(estimator, "gyroscope_noise_density") == "0.015  # rad/s/sqrt(Hz)");
    CHECK(value(estimator, "gyroscope_random_walk") == "5.0e-05  # rad/s^2/sqrt(Hz)");
    CHECK(value(estimator, "update_rate") == "400.0  # Hz");
    CHECK(value(estimator, "rostopic") == "/alphasense/imu");
  }
  CHECK(value(Estimator::vins, "gyr_n") == "0.3  # rad/s");      // 0.015·√400
  CHECK(value(Estimator::vins, "gyr_w") == "0.001  # rad/s^2");  // 5e-5·√400
  CHECK(value(Estimator::vins, "imu_topic") == "/alphasense/imu");
  CHECK(value(Estimator::orbslam3, "IMU.NoiseGyro") == "0.015  # rad/s/sqrt(Hz)");
  CHECK(value(Estimator::orbslam3, "IMU.GyroWalk") == "5.0e-05  # rad/s^2/sqrt(Hz)");
  CHECK(value(Estimator::orbslam3, "IMU.Frequency") == "400  # Hz");  // older versions take a whole number only
  CHECK(std::stod(value(Estimator::gtsam, "gyroscopeCovariance")) == Approx(0.015 * 0.015).epsilon(1e-15));
  CHECK(std::stod(value(Estimator::gtsam, "biasAccCovariance")) ==
        Approx(noise.accel_random_walk * noise.accel_random_walk).epsilon(1e-15));
}

TEST_CASE("Each file says what its documentation recommends, and that it was not applied") {
  const auto text = [](Estimator estimator) { return imu_noise_text(estimator, some_noise()); };
  for (const Estimator estimator : estimators) CHECK(text(estimator).find("not inflated") != std::string::npos);
  CHECK(text(Estimator::kalibr).find("10 times as much and more") != std::string::npos);
  CHECK(text(Estimator::openvins).find("10 to 20 times") != std::string::npos);
  CHECK(text(Estimator::orbslam3).find("GyroWalk and AccWalk") != std::string::npos);
  CHECK(text(Estimator::vins).find("recommends no factor") != std::string::npos);
  CHECK(text(Estimator::gtsam).find("recommends no factor") != std::string::npos);
}

TEST_CASE("OpenCV's FileStorage knows a file by its first line") {
  for (const Estimator estimator : {Estimator::openvins, Estimator::vins, Estimator::orbslam3}) {
    CHECK(imu_noise_text(estimator, some_noise(), {"a comment"}).starts_with("%YAML:1.0\n---\n# a comment\n"));
  }
  for (const Estimator estimator : {Estimator::kalibr, Estimator::gtsam}) {
    CHECK(imu_noise_text(estimator, some_noise(), {"a comment"}).starts_with("# a comment\n"));
  }
}

TEST_CASE("Nothing in a comment or topic becomes a key") {
  const std::vector<std::string> comments{"Noise of x\nrostopic: /evil\r\nupdate_rate: 1\xe2\x80\xa8model: none.csv"};
  for (const Estimator estimator : estimators) {
    CAPTURE(name(estimator));
    ImuNoise noise = some_noise();
    const auto lines = lines_of(imu_noise_text(estimator, noise)).size();
    CHECK(lines_of(imu_noise_text(estimator, noise, comments)).size() == lines + 1);
    check_same_noise(read(imu_noise_text(estimator, noise, comments)), noise);
    noise.topic = "/imu\nupdate_rate: 1  # \"\\";
    const ImuNoise again = read(imu_noise_text(estimator, noise));
    check_same_noise(again, noise);
    if (again.topic != "/imu0") CHECK(again.topic == noise.topic);
  }
}

TEST_CASE("Configuration files of the estimators are read, whatever else they hold") {
  const ImuNoise vins = read(
      "%YAML:1.0\n\nimu_topic: \"/imu/data\"   # topic\nmodel_type: PINHOLE\nextrinsicRotation: !!opencv-matrix\n"
      "   rows: 3\n   cols: 3\n   dt: d\n   data: [1, 0, 0,\n          0, 1, 0, 0, 0, 1]\n"
      "acc_n: 0.1          # accelerometer\ngyr_n: 0.02\nacc_w: 0.001\ngyr_w: 1e-4\ng_norm: 9.8\n",
      100);
  CHECK(vins.gyro_noise_density == Approx(0.002));
  CHECK(vins.gyro_random_walk == Approx(1e-5));
  CHECK(vins.accel_noise_density == Approx(0.01));
  CHECK(vins.accel_random_walk == Approx(1e-4));
  CHECK(vins.update_rate == 100);
  CHECK(vins.topic == "/imu/data");

  const ImuNoise orbslam3 = read(
      "%YAML:1.0\n\nCamera.type: \"PinHole\"\nCamera1.fx: 458.0\nIMU.T_b_c1: !!opencv-matrix\n   rows: 4\n   cols: 4\n"
      "   dt: f\n   data: [1, 0, 0, 0,\n         0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"
      "IMU.NoiseGyro: 1.7e-4 # rad/s^0.5\nIMU.NoiseAcc: 2.0e-3\nIMU.GyroWalk: 1.9e-05 \nIMU.AccWalk: 3.e-03\n"
      "IMU.Frequency: 200.0\n");
  CHECK(orbslam3.gyro_noise_density == 1.7e-4);
  CHECK(orbslam3.accel_random_walk == 3e-3);
  CHECK(orbslam3.update_rate == 200);

  const ImuNoise gtsam = read(
      "gyroscopeCovariance: 1e-6\naccelerometerCovariance: 1e-4\nbiasOmegaCovariance: 4e-10\nbiasAccCovariance: "
      "9e-8\n");
  CHECK(gtsam.gyro_noise_density == Approx(1e-3));
  CHECK(gtsam.gyro_random_walk == Approx(2e-5));
  CHECK(gtsam.accel_noise_density == Approx(0.01));
  CHECK(gtsam.accel_random_walk == Approx(3e-4));
  CHECK(gtsam.update_rate == 200);
}

TEST_CASE("The rate of a file comes before the one that is given") {
  const std::string vins = "acc_n: 0.1\ngyr_n: 0.02\nacc_w: 0.001\ngyr_w: 1.0e-4\n";
  CHECK(read(vins + "update_rate: 400\n", 100).gyro_noise_density == Approx(0.001));
  CHECK(read(kalibr_densities + "update_rate: 400\n", 100).update_rate == 400);
}

TEST_CASE("The noise of errors is white noise, correlated or not, and random walks, on the noisiest axis") {
  using namespace splinertia;
  AnyImu imu;
  imu.gyro.add(WhiteNoise{PerAxis<double>(3e-3, 1e-3, 1e-3)});
  imu.gyro.add(CorrelatedNoise{PerAxis<double>(4e-3, 1e-3, 4.5e-3), Eigen::Matrix3d(Eigen::Matrix3d::Identity())});
  imu.gyro.add(RandomWalk{1e-170});
  imu.accel.add(CorrelatedNoise{0.5, Eigen::Matrix3d(Eigen::Matrix3d::Ones())});
  imu.accel.add(RandomWalk{0.25});
  const auto noise = imu_noise_of(imu, 100);
  REQUIRE(noise);
  CHECK(noise->gyro_noise_density == Approx(5e-3));
  CHECK(noise->gyro_random_walk == 1e-170);
  CHECK(noise->accel_noise_density == 0.5);
  CHECK(noise->accel_random_walk == 0.25);
  CHECK(noise->update_rate == 100);
  CHECK_FALSE(imu_noise_of(AnyImu{}, 100));
}

TEST_CASE("OpenVINS' intrinsics become terms") {
  const std::string rest =
      "update_rate: 200\nTw: [[2, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
      "R_IMUtoGYRO: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]\nTa: [[1.01, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
      "R_IMUtoACC: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nTg: [[0.001, 0, 0], [0, 0, 0], [0, 0, 0]]\n";
  for (const char* model : {"kalibr", "rpng"}) {
    const ImuNoise noise = read(kalibr_densities + "model: " + model + "\n" + rest);
    REQUIRE(noise.gyro_misalignment);
    REQUIRE(noise.accel_misalignment);
    REQUIRE(noise.g_sensitivity);
    CHECK(*noise.gyro_misalignment == (Eigen::Matrix3d() << 0, 2, 0, -1, 0, 0, 0, 0, 1).finished());
    CHECK(*noise.accel_misalignment == Eigen::Matrix3d(Eigen::Vector3d(1.01, 1, 1).asDiagonal()));
    CHECK(*noise.g_sensitivity == Eigen::Matrix3d(Eigen::Vector3d(0.001, 0, 0).asDiagonal()));
  }
}

TEST_CASE("What it must refuse: file, line and what was expected") {
  CHECK(refusal("a: 1\n") ==
        "noise.yaml:1: no IMU noise, expected the keys of Kalibr or OpenVINS (gyroscope_noise_density, ...), VINS "
        "(gyr_n, ...), ORB-SLAM3 (IMU.NoiseGyro, ...), GTSAM (gyroscopeCovariance, ...)");
  CHECK(refusal("- 1\n").starts_with("noise.yaml:1: no IMU noise"));
  CHECK(refusal(kalibr_densities + "gyr_n: 1\n") ==
        "noise.yaml:1: keys of Kalibr or OpenVINS (gyroscope_noise_density, ...) and of VINS (gyr_n, ...), expected "
        "only those of one");
  CHECK(refusal("acc_n: 0.1\ngyr_n: 0.02\nacc_w: 0.001\ngyr_w: 1.0e-4\n") ==
        "noise.yaml:1: no update_rate, expected one or --rate: VINS' values are per sample and depend on the "
        "rate");
  CHECK(refusal("acc_n: 0.1\ngyr_n: 0.02\nacc_w: 0\ngyr_w: 1.0e-4\n", 200) ==
        "noise.yaml:3: acc_w is 0, expected a number > 0");
  CHECK(refusal("IMU.NoiseGyro: 1\nIMU.NoiseAcc: x\nIMU.GyroWalk: 1\nIMU.AccWalk: 1\n") ==
        "noise.yaml:2: x is not a number");
  CHECK(refusal("IMU.NoiseGyro: 1\nIMU.NoiseAcc: 1\nIMU.GyroWalk: 1\nIMU.AccWalk: 1\n") ==
        "noise.yaml:1: no IMU.Frequency, expected one");
  CHECK(refusal("gyroscopeCovariance: 1\n") == "noise.yaml:1: no biasOmegaCovariance, expected one");
  CHECK(refusal("\n" + kalibr_densities) == "noise.yaml:2: no update_rate, expected one");
  CHECK(refusal(kalibr_densities + "update_rate: 200\nmodel: other\n") ==
        "noise.yaml:6: model other, expected calibrated or scale-misalignment (Kalibr), kalibr or rpng (OpenVINS)");
  CHECK(refusal(kalibr_densities + "update_rate: 200\nTw: [1, 2]\n").starts_with("noise.yaml:6: 2 rows, expected 3"));
}
