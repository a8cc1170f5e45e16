// SPDX-License-Identifier: MIT
// The whole library with libstdc++'s debug mode and the sanitizer of undefined behaviour: it compiles, and runs through
// splines, samples and a simulation. The sanitizer ends the program where it finds fault.
#include <chrono>
#include <cstdio>
#include <splinertia/io/detail/npy.hpp>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/io/tum.hpp>
#include <splinertia/splinertia.hpp>
#include <vector>

using namespace splinertia;

namespace {

template <typename K>
double length(const K& knots) {
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 9; ++i) points.push_back({Sophus::SO3d::rotZ(0.1 * i), {0.1 * i, 0, 0}});
  const Spline<SO3xR3<double>, 4, K> curve(knots, points);
  const auto interval = (curve.end() - curve.start()) / 100;
  double sum = curve.template at<2>(curve.start()).value.template get<1>().x();
  for (const auto& motion : sample<1>(curve, curve.start(), interval, 101)) sum += motion.velocity.norm();
  return sum + curve.template linearize<2>(curve.end()).velocity.norm();
}

}  // namespace

int main() {
  using std::chrono::nanoseconds;
  double sum = length(UniformKnots{0.0, 0.1}) + length(UniformKnots{nanoseconds{0}, nanoseconds{100}});
  NonUniformKnots<double> knots;
  for (int i = 0; i < 13; ++i) knots.knots.push_back(0.1 * i);
  sum += length(knots);

  const Ellipse<> ellipse;
  const Imu imu{ErrorModel{WhiteNoise{1e-3}}, ErrorModel{WhiteNoise{1e-2}}};
  for (const auto& reading : simulate(ellipse, imu, {.rate = 100, .seed = 1, .start = 0, .end = 1})) {
    sum += reading.accel.norm();
  }
  std::printf("%g\n", sum);
  return sum > 0 ? 0 : 1;
}
