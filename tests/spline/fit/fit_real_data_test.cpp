// SPDX-License-Identifier: MIT
// Real data: euroc_MH_05_pair/imu0.txt euroc_MH_05_pair/gt.csv euroc_V1_02_medium_gt.csv tum_freiburg1_xyz_gt.txt
// fit() on trajectories that were measured, and its derivatives against an IMU that was measured beside one of them.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/spline.hpp>
#include <sstream>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Split = SO3xR3<double>;
using Curve = Spline<Split, 4, UniformKnots<nanoseconds>>;

const std::filesystem::path shared = SPLINERTIA_TEST_DATA;

struct ImuRow {
  nanoseconds time;
  Eigen::Vector3d gyroscope, accelerometer;
};

/// `ns gx gy gz ax ay az` with blanks.
std::vector<ImuRow> read_imu(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<ImuRow> rows;
  std::int64_t ns = 0;
  ImuRow row;
  auto& [time, g, a] = row;
  while (file >> ns >> g[0] >> g[1] >> g[2] >> a[0] >> a[1] >> a[2]) {
    time = nanoseconds{ns};
    rows.push_back(row);
  }
  return rows;
}

/// Root mean square of what is below `cutoff` Hz of samples at `rate` Hz, without their mean: a brick wall.
double rms_below(const std::vector<double>& samples, double rate, double cutoff) {
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> fft;
  fft.fwd(spectrum, samples);
  const auto n = static_cast<double>(samples.size());
  double power = 0;
  for (std::size_t i = 1; static_cast<double>(i) * rate / n < cutoff; ++i) power += 2 * std::norm(spectrum[i]);
  return std::sqrt(power) / n;
}

/// Ground truth and IMU of EuRoC's MH_05, and the fit with Cauchy's loss, which takes two seconds.
struct Pair {
  std::vector<EurocState> states;
  std::vector<Stamped<Split>> poses;

  static constexpr double interval = 0.02;

  explicit Pair(const std::filesystem::path& path) : states(read_euroc_groundtruth(path)) {
    for (const auto& state : states) poses.push_back({state.time, state.value});
  }

  /// Indices i where the position steps further than that from pose i to the next, beyond what its velocity makes of
  /// it.
  [[nodiscard]] std::vector<std::size_t> jumps(double further) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
      const double dt = to_seconds<double>(states[i + 1].time - states[i].time);
      const Eigen::Vector3d step = position(poses[i + 1].value) - position(poses[i].value);
      if ((step - dt * states[i].velocity).norm() > further) found.push_back(i);
    }
    return found;
  }

  [[nodiscard]] Fit<Curve> fitted(const RobustLoss& loss) const {
    return fit<Curve>(poses, {.knot_interval = interval, .loss = loss});
  }

  /// Every jump of more than 5 mm has an outlier at most two knots away, and no pose is off by more than 1 mm that is
  /// further than two knots from any step of more than 1 mm.
  void check_jumps(const char* loss, const Fit<Curve>& fitted) const {
    CHECK(fitted.converged);
    const auto near = [&](std::size_t i, std::size_t j) {
      return std::abs(to_seconds<double>(poses[i].time - poses[j].time)) <= 2 * interval;
    };
    const auto large = jumps(5e-3);
    CHECK(large.size() == 13);
    for (const std::size_t i : large) {
      INFO("jump behind pose " << i);
      CHECK(std::any_of(fitted.outliers.begin(), fitted.outliers.end(),
                        [&](std::size_t j) { return near(i, j) || near(i + 1, j); }));
    }
    const auto all = jumps(1e-3);
    double beyond = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto off = fitted.residuals.poses[i].tail<3>().norm();
      if (off <= beyond) continue;
      if (std::none_of(all.begin(), all.end(), [&](std::size_t j) { return near(i, j) || near(i, j + 1); })) {
        beyond = off;
      }
    }
    std::printf("%s: %d iterations, %zu jumps, %zu outliers; positions off by %.2f mm at jumps, %.2f mm beyond\n", loss,
                fitted.iterations, large.size(), fitted.outliers.size(),
                1e3 * fitted.residuals.component_max.tail<3>().norm(), 1e3 * beyond);
    CHECK(beyond <= 1e-3);
    CHECK(fitted.residuals.component_max.tail<3>().norm() > 1e-2);  // they are there, and were not gone after
  }
};

}  // namespace

TEST_CASE("EuRoC MH_05: Huber's loss tells the jumps of the ground truth", "[.real_data]") {
  const auto path = shared / "euroc_MH_05_pair/gt.csv";
  const Pair pair(path);
  pair.check_jumps("Huber", pair.fitted(RobustLoss::huber()));
}

TEST_CASE("EuRoC MH_05: Cauchy's tells them too, and the fit turns and accelerates as the IMU says", "[.real_data]") {
  const auto path = shared / "euroc_MH_05_pair/gt.csv", imu_path = shared / "euroc_MH_05_pair/imu0.txt";
  const Pair pair(path);
  const Fit<Curve> fitted = pair.fitted(RobustLoss::cauchy());
  pair.check_jumps("Cauchy", fitted);

  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  for (const auto& state : pair.states) bias += state.gyro_bias / static_cast<double>(pair.states.size());
  std::array<std::vector<double>, 3> gyroscope, accelerometer;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImuRow& row : read_imu(imu_path)) {
    if (row.time < fitted.spline.start() || row.time > fitted.spline.end()) continue;
    const auto m = fitted.spline.evaluate<2>(row.time);
    const Eigen::Vector3d g = row.gyroscope - angular_velocity(m);
    const Eigen::Vector3d a = row.accelerometer - specific_force<Split, 2>(m, Eigen::Vector3d(0, 0, -9.81));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gyroscope[axis].push_back(g[static_cast<int>(axis)]);
      accelerometer[axis].push_back(a[static_cast<int>(axis)]);
    }
    mean += g;
  }
  REQUIRE(gyroscope[0].size() > 22000);
  mean /= static_cast<double>(gyroscope[0].size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double g = rms_below(gyroscope[axis], 200, 10), a = rms_below(accelerometer[axis], 200, 2);
    const double off = mean[static_cast<int>(axis)] - bias[static_cast<int>(axis)];
    std::printf(
        "axis %zu: gyroscope below 10 Hz %.2e rad/s, its mean %.1e from the bias; accelerometer below 2 Hz %.3f "
        "m/s2\n",
        axis, g, off, a);
    // Measured: 6.6e-4, 4e-6, 0.094.
    CHECK(g <= 1e-3);
    CHECK(std::abs(off) <= 2e-4);
    CHECK(a <= 0.1);
  }
}

/// The RMS of the noise of each component, if it is white: sixth differences, over the root of the 924 that their
/// squares sum up to. Motion slower than a sixth of the rate leaves next to nothing in them.
Tangent<Split> pose_noise(const std::vector<Stamped<Split>>& poses) {
  constexpr std::array<double, 7> binomials{1, -6, 15, -20, 15, -6, 1};
  Tangent<Split> squares = Tangent<Split>::Zero();
  for (std::size_t i = 3; i + 3 < poses.size(); ++i) {
    Tangent<Split> difference = Tangent<Split>::Zero();
    for (std::size_t j = 0; j < binomials.size(); ++j) {
      difference += binomials[j] * increment(poses[i].value, poses[i + j - 3].value);
    }
    squares += difference.cwiseAbs2();
  }
  return (squares / (924 * static_cast<double>(poses.size() - 6))).cwiseSqrt();
}

TEST_CASE("Ground truth of motion capture is met to its noise", "[.real_data]") {
  const auto check = [](const char* file, double knot_interval, std::size_t gaps) {
    const auto path = shared / file;
    const auto poses = read_trajectory(path).poses;
    const auto fitted = fit<Curve>(poses, {.knot_interval = knot_interval});
    CHECK(fitted.converged);
    CHECK(fitted.gaps.size() == gaps);
    const Tangent<Split> noise = pose_noise(poses), rms = fitted.residuals.component_rms;
    for (int i = 0; i < rms.size(); ++i) {
      std::printf("%s, %g s: %s %d: residuals %.3g, noise %.3g RMS\n", file, knot_interval,
                  i < 3 ? "rotation [rad]" : "position [m]", i % 3, rms[i], noise[i]);
      // Residuals are noise, less what the control points take of it: no motion that the knots could not follow is
      // left, and the curve does not run after every pose.
      CHECK(rms[i] < 1.3 * noise[i]);
      CHECK(rms[i] > 0.5 * noise[i]);
    }
  };
  // Knots for every 2.5 (V1_02, which was smoothed before it was published) and 4 poses. freiburg1 lacks ten poses in a
  // row, nearly three of these intervals.
  check("euroc_V1_02_medium_gt.csv", 0.0125, 0);
  check("tum_freiburg1_xyz_gt.txt", 0.04, 1);
}
