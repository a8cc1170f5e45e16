// SPDX-License-Identifier: MIT
// allan::analyse() finds the noise of a sensor in a log at rest: white noise N, random walk K and more, each with an
// interval, or an upper limit if the log does not show it.

#include <cstdio>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <vector>

using namespace splinertia;

int main() {
  // An hour at rest at 100 Hz, one axis. Any range of numbers will do.
  const Imu imu{ErrorModel{RandomWalk{2e-4}, WhiteNoise{0.015}}, ErrorModel{}};
  std::vector<double> gyro_x;  // rad/s
  const auto rest = at_rest(SO3xR3<double>{});
  for (const auto& r : simulate(rest, imu, {.rate = 100, .seed = 1, .start = 0.0, .end = 3600.0})) {
    gyro_x.push_back(r.gyro.x());
  }

  const auto analysis = allan::analyse(gyro_x, 100.0);
  const auto& noise = analysis.noise;
  std::printf("the model describes the log: %s\n",
              analysis.adequacy() == allan::Adequacy::adequate ? "yes" : "no, or not all of it");
  std::printf("N = %.5f rad/s/sqrt(Hz), 95 %%: %.5f to %.5f\n", noise.N.value, noise.N.interval.lower,
              noise.N.interval.upper);
  std::printf("K = %.1e rad/s^2/sqrt(Hz), 95 %%: %.1e to %.1e\n", noise.K.value, noise.K.interval.lower,
              noise.K.interval.upper);
  std::printf("B is %s, at most %.1e rad/s\n", noise.B.detected ? "detected" : "not detected", noise.B.interval.upper);

  const auto& point = analysis.curve.points.front();  // the curve of the overlapping Allan deviation, for a plot
  std::printf("deviation at %.2f s: %.3f rad/s\n", point.tau, point.deviation);
}

// prints
// the model describes the log: yes
// N = 0.01498 rad/s/sqrt(Hz), 95 %: 0.01495 to 0.01502
// K = 2.3e-04 rad/s^2/sqrt(Hz), 95 %: 1.6e-04 to 3.3e-04
// B is not detected, at most 1.7e-03 rad/s
// deviation at 0.01 s: 0.150 rad/s
