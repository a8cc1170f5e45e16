// SPDX-License-Identifier: MIT
// The numbers of the README's picture: a curve, what a gyroscope with much noise measures along it, and how far schemes
// drift when they integrate the samples of an ideal IMU and of one with the noise of the EuRoC data set.
// overview_plot.py draws them.

#include <cmath>
#include <cstdio>
#include <splinertia/splinertia.hpp>
#include <vector>

using namespace splinertia;

namespace {

using Curve = Spline<SO3xR3<double>, 4>;

/// The distance from the true position at each sample, m.
template <typename Scheme>
std::vector<double> drift(const Curve& curve, const auto& samples) {
  std::vector<double> error;
  for (const auto& state : integrate<Scheme>(nav_state(curve.evaluate<1>(0), 0.0), samples)) {
    error.push_back((state.p_WB - position(curve.evaluate<0>(state.time).value)).norm());
  }
  return error;
}

}  // namespace

int main() {
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 100; ++i) {
    points.push_back(
        {Sophus::SO3d::exp({0.1 * i, std::sin(0.3 * i), 0}), {2 * std::sin(0.15 * i), std::sin(0.3 * i), 1}});
  }
  const Curve curve({.start = 0, .interval = 0.1}, points);
  const auto ideal = simulate(curve, Imu{}, {.rate = 200});
  const auto noisy = simulate(curve, presets::course, {.rate = 200, .seed = 42});
  const auto quiet = simulate(curve, presets::euroc, {.rate = 200, .seed = 42});

  const std::vector<std::vector<double>> drifts{drift<Euler>(curve, ideal), drift<Midpoint>(curve, ideal),
                                                drift<Magnus4>(curve, ideal), drift<Midpoint>(curve, quiet)};
  std::puts(
      "time_s,x_m,y_m,gyro_x,gyro_y,gyro_z,ideal_gyro_x,ideal_gyro_y,ideal_gyro_z,"
      "euler_m,midpoint_m,magnus4_m,noisy_m");
  auto reading = noisy.begin();
  std::size_t i = 0;
  for (const auto& exact : ideal) {
    const Eigen::Vector3d p = position(curve.evaluate<0>(exact.time).value);
    std::printf("%.3f,%.5f,%.5f", exact.time, p.x(), p.y());
    for (const Eigen::Vector3d& v : {reading->gyro, exact.gyro}) {
      std::printf(",%.5f,%.5f,%.5f", v.x(), v.y(), v.z());
    }
    for (const auto& error : drifts) std::printf(",%.4g", error[i]);
    std::putchar('\n');
    ++reading;
    ++i;
  }
}
