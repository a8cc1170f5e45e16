// SPDX-License-Identifier: MIT
// An error term of your own: a struct with parameters, a state and one function. This one is popcorn noise (random
// telegraph noise): a bias that jumps between two levels at random times, in each axis by itself. It composes with the
// library's terms, works for sensors of any number of axes, costs nothing in models that do not use it, and draws from its
// own random streams.

#include <cmath>
#include <cstdio>
#include <splinertia/splinertia.hpp>

#include "support/exit_code.hpp"

using namespace splinertia;

struct PopcornNoise {
  static constexpr std::string_view name = "popcorn noise";
  template <typename Normals>
  struct State : Normals {
    using Normals::Normals;
    Eigen::Array<bool, Normals::axes, 1> high = Eigen::Array<bool, Normals::axes, 1>::Constant(false);
  };

  double height;      // of a jump, in the sensor's unit
  double mean_dwell;  // mean time between jumps, s

  template <int Axes>
  void apply(SensorSample<double, Axes>& sample, auto& state) const {
    // The probability of an odd number of jumps in the interval.
    const double jumps = sample.first ? 0 : -std::expm1(-2 * sample.interval / mean_dwell) / 2;
    const auto u = state.draw_uniform();
    for (int i = 0; i < Axes; ++i) {
      if (u[i] < jumps) state.high[i] = !state.high[i];
      if (!state.high[i]) continue;
      sample.value[i] += height;
      sample.bias[i] += height;
    }
  }
  void describe(auto&& parameter) const {
    parameter("height", height, SensorUnit{});
    parameter("mean dwell time", mean_dwell, "s");
  }
};

int main() {
  return run_program("own_error_term", [] {
    const ErrorModel gyro{PopcornNoise{0.01, 5.0}, WhiteNoise{0.015}};
    const Imu imu{gyro, ErrorModel{WhiteNoise{0.019}}};
    std::fputs(describe(imu).c_str(), stdout);

    int jumps = 0, samples = 0;
    double last = 0;
    for (const ImuReading& r : simulate(Ellipse<>{}, imu, {.rate = 200, .seed = 42, .start = 0.0, .end = 600.0})) {
      jumps += r.gyro_bias.x() != last ? 1 : 0;
      last = r.gyro_bias.x();
      ++samples;
    }
    std::printf("%d jumps in %d samples\n", jumps, samples);

    SensorErrors thermometer(ErrorModel{PopcornNoise{0.5, 60.0}, WhiteNoise{0.1}}, StreamKey(42) / "thermometer");
    double largest = 0;
    for (int second = 0; second < 600; ++second) largest = std::fmax(largest, thermometer.apply(second, 20, 1)->bias);
    std::printf("a thermometer is up to %.1f degC off\n", largest);
  });
}
