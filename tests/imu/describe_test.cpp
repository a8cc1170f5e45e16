// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/clock/clock_drift.hpp>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/noise/quantization_noise.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/describe.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

struct Nameless {
  struct State {};
  void apply(SensorSample<double>&, State&) const {}
};

struct Named {
  static constexpr std::string_view name = "my term";
  struct State {};
  double mass = 2, age = 3;
  void apply(SensorSample<double>&, State&) const {}
  void describe(auto&& parameter) const {
    parameter("mass", mass, "kg");
    parameter("age", age, "");
  }
};

}  // namespace

TEST_CASE("Units follow the sensor") {
  const auto text = [](const SensorUnit& unit, SensorKind kind) { return unit_text(unit, kind); };
  CHECK(text({}, SensorKind::gyro) == "rad/s");
  CHECK(text({}, SensorKind::accel) == "m/s^2");
  CHECK(text({1}, SensorKind::gyro) == "rad/s^2");
  CHECK(text({1}, SensorKind::accel) == "m/s^3");
  CHECK(text({-1}, SensorKind::gyro) == "rad");
  CHECK(text({-1}, SensorKind::accel) == "m/s");
  CHECK(text({0, true}, SensorKind::gyro) == "rad/s/sqrt(Hz)");
  CHECK(text({1, true}, SensorKind::accel) == "m/s^3/sqrt(Hz)");
  CHECK(text({.per_kelvin = true}, SensorKind::accel) == "m/s^2/K");
}

TEST_CASE("Numbers are as short as tells them apart, and one where all axes have the same") {
  CHECK(value_text(0.1) == "0.1");
  CHECK(value_text(0.1F) == "0.1");
  CHECK(value_text(1.0 / 3) == "0.3333333333333333");
  CHECK(value_text(PerAxis<double>(0.1)) == "0.1");
  CHECK(value_text(PerAxis<double>(0.1, 0.1, 0.2)) == "(0.1 0.1 0.2)");
  CHECK(value_text(PerAxis<double>(0.1, 0.2, 0.2)) == "(0.1 0.2 0.2)");
}

TEST_CASE("A term in a line") {
  CHECK(describe(QuantizationNoise{0.5}, SensorKind::gyro) == "quantization noise: coefficient Q 0.5 rad");
  CHECK(describe(QuantizationNoise{0.5}, SensorKind::accel) == "quantization noise: coefficient Q 0.5 m/s");
  CHECK(describe(RandomWalk{5e-5}, SensorKind::accel) == "random walk: density 5e-05 m/s^3/sqrt(Hz)");
}

TEST_CASE("A user's terms are described by what they tell") {
  CHECK(describe(Nameless{}, SensorKind::gyro) == "unnamed term");
  CHECK(describe(Named{}, SensorKind::gyro) == "my term: mass 2 kg, age 3");
}

TEST_CASE("A model in lines, in its order") {
  CHECK(describe(ErrorModel{}, SensorKind::gyro) == "ideal\n");
  CHECK(describe(ErrorModel{WhiteNoise{0.015}, ConstantBias{1}, Nameless{}}, SensorKind::gyro) ==
        "white noise: density 0.015 rad/s/sqrt(Hz)\n"
        "constant bias: bias 1 rad/s\n"
        "unnamed term\n");
}

TEST_CASE("A whole IMU") {
  const Imu imu{ErrorModel{WhiteNoise{0.015}, RandomWalk{5e-5}}, ErrorModel{},
                ErrorModel{ClockDrift{2e-5}, DroppedSamples{0.01}}};
  CHECK(describe(imu) ==
        "gyro:\n"
        "  white noise: density 0.015 rad/s/sqrt(Hz)\n"
        "  random walk: density 5e-05 rad/s^2/sqrt(Hz)\n"
        "accel:\n"
        "  ideal\n"
        "stamps:\n"
        "  clock drift: rate 2e-05 s/s\n"
        "  dropped samples: probability 0.01\n");
  CHECK(describe(Imu{}) == "gyro:\n  ideal\naccel:\n  ideal\nstamps:\n  ideal\n");
}
