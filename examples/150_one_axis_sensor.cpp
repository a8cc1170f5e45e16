// SPDX-License-Identifier: MIT
// The error terms serve any sensor, not only an IMU. This is a barometer: one axis, numbers in and out.

#include <cstdio>
#include <splinertia/errors/bias/turn_on_bias.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/sensor_errors.hpp>
#include <splinertia/motion/ellipse.hpp>

using namespace splinertia;

int main() {
  constexpr double interval = 0.04;  // s

  // Units are those of the sensor: m, m/s/sqrt(Hz), m/sqrt(Hz), m. The key names the random numbers.
  const ErrorModel model{TurnOnBias{3.0}, RandomWalk{0.02}, WhiteNoise{0.05}, Quantization{0.1}};
  SensorErrors barometer(model, StreamKey(42) / "barometer");

  std::puts("t [s]  altitude [m]  reading [m]  bias in it [m]");
  for (int i = 0; i <= 1500; ++i) {
    const double t = interval * i, altitude = 500 + position(Ellipse<>{}.evaluate<0>(t).value).z();
    const auto reading = barometer.apply(t, altitude, interval);  // empty if a clock term drops the sample
    if (i % 410 == 0) std::printf("%5.1f  %12.3f  %11.1f  %14.3f\n", t, altitude, reading->value, reading->bias);
  }
}

// prints
// t [s]  altitude [m]  reading [m]  bias in it [m]
//   0.0       505.000        505.7           0.653
//  16.4       505.951        506.2           0.469
//  32.8       505.588        506.0           0.411
//  49.2       504.412        504.6           0.423
