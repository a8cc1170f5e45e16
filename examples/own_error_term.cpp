// SPDX-License-Identifier: MIT
// An error term of your own: a struct with parameters, a state and one function. This one makes a sensor stick now and
// then: a sample repeats the previous reading, as on a busy bus. It composes with the library's terms, costs nothing in
// models that do not use it, and draws from its own random streams.

#include <cstdio>
#include <splinertia/splinertia.hpp>

#include "support/exit_code.hpp"

using namespace splinertia;

struct Sticking {
  static constexpr std::string_view name = "sticking";
  template <typename Normals>
  struct State : Normals {
    using Normals::Normals;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
  };

  double probability;  // that a sample repeats the previous one

  void apply(SensorSample<double>& sample, auto& state) const {
    if (state.uniform() < probability && !sample.first) sample.value = state.last;
    state.last = sample.value;
  }
  void describe(auto&& parameter) const { parameter("probability", probability, "1"); }
};

int main() {
  return run_program("own_error_term", [] {
    const Imu imu{ErrorModel{RandomWalk{5e-5}, WhiteNoise{0.015}, Sticking{0.01}}, ErrorModel{WhiteNoise{0.019}}};
    std::fputs(describe(imu).c_str(), stdout);

    int repeated = 0;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    for (const ImuReading& r : simulate(Ellipse<>{}, imu, {.rate = 200, .seed = 42, .start = 0.0, .end = 60.0})) {
      repeated += r.gyro == last ? 1 : 0;
      last = r.gyro;
    }
    std::printf("%d of 12001 gyroscope readings repeat the one before\n", repeated);
  });
}
