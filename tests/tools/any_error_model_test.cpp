// SPDX-License-Identifier: MIT
#include "../../tools/support/any_error_model.hpp"

#include <splinertia/splinertia.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

// All that a run gives, number by number.
std::vector<double> numbers(const auto& imu) {
  std::vector<double> all;
  for (const auto& r : simulate(Ellipse<>{}, imu, {.rate = 100, .seed = 7, .start = 0.0, .end = 2.0})) {
    all.insert(all.end(), {r.time, r.true_time});
    for (const auto& v : {r.gyro, r.accel, r.gyro_bias, r.accel_bias}) all.insert(all.end(), v.begin(), v.end());
  }
  return all;
}

}  // namespace

TEST_CASE("A model whose terms are known at run time gives the samples of the compiled one, bit for bit") {
  const Imu imu{ErrorModel{WhiteNoise{0.1}, RandomWalk{0.01}, WhiteNoise{0.2}, BiasInstability{0.1}, Quantization{0.01},
                           Saturation{2}},
                ErrorModel{TurnOnBias{0.1}, GaussMarkov{0.1, 10.0}, RandomVibration{0.1, 20.0, 0.1}},
                ErrorModel{ClockOffset{0.001}, StampJitter{0.02}, DroppedSamples{0.1}}};
  CHECK(numbers(any_imu(imu)) == numbers(imu));
  CHECK(describe(any_imu(imu)) == describe(imu));
}

TEST_CASE("Terms are found, replaced and refused") {
  AnySensorModel model(ErrorModel{WhiteNoise{0.1}, RandomWalk{0.01}, WhiteNoise{0.2}});
  CHECK(model.all<WhiteNoise<double>>().size() == 2);
  model.replace(WhiteNoise{0.5});
  REQUIRE(model.all<WhiteNoise<double>>().size() == 1);
  CHECK(model.all<WhiteNoise<double>>()[0].density[0] == 0.5);
  model.replace(Quantization{1.0});
  CHECK(model.describe(SensorKind::accel) ==
        "white noise: density 0.5 m/s^2/sqrt(Hz)\nrandom walk: density 0.01 m/s^3/sqrt(Hz)\n"
        "quantization: least significant bit 1 m/s^2\n");
  CHECK_THROWS_AS(model.add(Saturation{0.5}), std::invalid_argument);
  CHECK(AnyStampModel().describe(SensorKind::clock) == "ideal\n");
}
