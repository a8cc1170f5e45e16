// SPDX-License-Identifier: MIT
// An error term of your own is a struct with parameters, a state and one function. This one is popcorn noise: a bias that
// jumps between two levels. It composes with the library's terms and draws from random streams of its own.

#include <cstdio>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>

using namespace splinertia;

struct PopcornNoise {
  static constexpr std::string_view name = "popcorn noise";  // names the random streams
  template <typename Normals>
  struct State : Normals {
    using Normals::Normals;
    Eigen::Array<bool, Normals::axes, 1> high = Eigen::Array<bool, Normals::axes, 1>::Constant(false);
  };

  double height;  // in the sensor's unit
  double jumps_per_second;

  template <int Axes>  // works for sensors of any number of axes
  void apply(SensorSample<double, Axes>& sample, auto& state) const {
    const auto u = state.draw_uniform();
    for (int i = 0; i < Axes; ++i) {
      if (u[i] < jumps_per_second * sample.interval) state.high[i] = !state.high[i];
      if (state.high[i]) sample.value[i] += height, sample.bias[i] += height;
    }
  }
  void describe(auto&& parameter) const {  // optional
    parameter("height", height, SensorUnit{});
    parameter("rate", jumps_per_second, "1/s");
  }
};

int main() {
  const Imu imu{ErrorModel{PopcornNoise{0.002, 0.5}, WhiteNoise{1e-4}}, ErrorModel{}};
  std::fputs(describe(imu).c_str(), stdout);

  int jumps = 0;
  double last = 0;
  const auto rest = at_rest(SO3xR3<double>{});
  for (const auto& r : simulate(rest, imu, {.rate = 200, .seed = 42, .start = 0.0, .end = 60.0})) {
    jumps += r.gyro_bias.x() != last ? 1 : 0;
    last = r.gyro_bias.x();
  }
  std::printf("%d jumps in 60 s\n", jumps);
}

// prints
// gyro:
//   popcorn noise: height 0.002 rad/s, rate 0.5 1/s
//   white noise: density 0.0001 rad/s/sqrt(Hz)
// accel:
//   ideal
// stamps:
//   ideal
// 26 jumps in 60 s
