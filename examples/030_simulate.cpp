// SPDX-License-Identifier: MIT
// simulate() gives what an IMU measures along a motion, with exactly the error terms that are named.

#include <cstdio>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>

using namespace splinertia;

int main() {
  // Terms apply in the order in which they are written. Noise is given as continuous-time density.
  const Imu imu{ErrorModel{ConstantBias{0.01}, RandomWalk{5e-5}, WhiteNoise{0.015}},  // gyroscope, rad/s
                ErrorModel{WhiteNoise{0.019}, Saturation{20.0}}};                     // accelerometer, m/s^2
  std::fputs(describe(imu).c_str(), stdout);

  // A range that computes each sample when it is reached. The same seed gives the same samples on every platform.
  const auto samples = simulate(Ellipse<>{}, imu, {.rate = 200, .seed = 42, .start = 0.0, .end = 60.0});
  std::puts("t [s]  gyro [rad/s]             accel [m/s^2]            bias of the gyro's x axis [rad/s]");
  int i = 0;
  for (const auto& r : samples) {
    if (i++ % 4000 != 0) continue;
    std::printf("%5.1f  %7.4f %7.4f %7.4f  %7.3f %7.3f %7.3f  %7.4f\n", r.time, r.gyro.x(), r.gyro.y(), r.gyro.z(),
                r.accel.x(), r.accel.y(), r.accel.z(), r.gyro_bias.x());
  }
}

// prints
// gyro:
//   constant bias: bias 0.01 rad/s
//   random walk: density 5e-05 rad/s^2/sqrt(Hz)
//   white noise: density 0.015 rad/s/sqrt(Hz)
// accel:
//   white noise: density 0.019 m/s^2/sqrt(Hz)
//   saturation: limit 20 m/s^2
// stamps:
//   ideal
// t [s]  gyro [rad/s]             accel [m/s^2]            bias of the gyro's x axis [rad/s]
//   0.0  -0.0069  0.2052  0.6590   -1.126   0.563   9.879   0.0100
//  20.0  -0.0239  0.3363  0.3191   -3.537   0.591   9.311   0.0102
//  40.0  -0.4802  0.0427  0.5296   -3.227  -0.204   9.316   0.0106
//  60.0  -0.0948 -0.1104  0.4713   -1.299  -0.952   9.517   0.0105
