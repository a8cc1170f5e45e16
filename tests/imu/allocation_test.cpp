// SPDX-License-Identifier: MIT
// A run of any length with every error term allocates nothing: counted in operator new, and refused by Eigen.
#define EIGEN_RUNTIME_NO_MALLOC
#include <cstddef>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/bias/temperature_bias.hpp>
#include <splinertia/errors/bias/turn_on_bias.hpp>
#include <splinertia/errors/clock/clock_drift.hpp>
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <splinertia/errors/noise/bias_instability.hpp>
#include <splinertia/errors/noise/gauss_markov.hpp>
#include <splinertia/errors/noise/quantization_noise.hpp>
#include <splinertia/errors/noise/random_vibration.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/output/first_order_bandwidth.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <splinertia/errors/scale/temperature_scale.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/errors/size_effect.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>

#include "support/allocations.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::allocations, testing::allocations_of;

namespace {

/// Every term there is, with one that is for a kind of sensor.
const auto every_term = [](const auto& of_sensor) {
  return ErrorModel{ConstantBias{0.1},
                    TurnOnBias{0.1},
                    RandomWalk{1e-3},
                    GaussMarkov{0.01, 100},
                    BiasInstability{1e-3},
                    RateRamp{1e-5},
                    TemperatureBias{1e-4, WarmUp{20, 60, 300}},
                    TemperatureScale{1e-4, [](double elapsed) { return 20 + elapsed / 1000; }},
                    ScaleFactor{0.01},
                    Misalignment{Eigen::Matrix3d{{1, 0.01, 0}, {0, 1, 0.01}, {0, 0, 1}}},
                    of_sensor,
                    SinusoidalVibration{0.1, 120},
                    RandomVibration{0.1, 70, 0.05},
                    FirstOrderBandwidth{80},
                    SecondOrderBandwidth{150, 0.7},
                    WhiteNoise{0.01},
                    QuantizationNoise{1e-5},
                    Quantization{1e-3},
                    Saturation{35}};
};
const Eigen::Matrix3d small{{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1e-3}};
const auto gyro = every_term(GSensitivity{small});
const auto accel = every_term(SizeEffect{small}).with(ConstantBias{1});
const ErrorModel stamps{ClockOffset{0.003}, ClockDrift{2e-5}, StampJitter{1e-4}, DroppedSamples{0.01}};
const Imu everything{gyro, accel, stamps};

/// What a run from 0 to `duration` allocates, from its beginning to its end, with `count` of samples that arrived.
std::size_t allocations_of_run(const auto& motion, const auto& imu, double duration, std::size_t& count) {
  double sum = 0;
  const std::size_t allocated = allocations_of([&] {
    for (const auto& r : simulate(motion, imu, {.rate = 1000, .seed = 1, .start = 0.0, .end = duration})) {
      sum += r.gyro.norm() + r.accel.norm() + r.gyro_bias.norm() + r.accel_bias.norm() + r.time;
      ++count;
    }
  });
  CHECK(sum > 0);
  return allocated;
}

}  // namespace

TEST_CASE("A run with every error term allocates nothing") {
  CHECK(allocations > 0);  // the counter counts
  std::size_t count = 0;
  CHECK(allocations_of_run(Ellipse<>{}, everything, 20, count) == 0);
  CHECK(count > 19'600);
  CHECK(count < 20'000);
}

TEST_CASE("A million samples allocate nothing either") {
  std::size_t count = 0;
  const ErrorModel noise{RandomWalk{1e-3}, WhiteNoise{0.01}};
  CHECK(allocations_of_run(at_rest(SO3xR3<double>{}), Imu{noise, noise}, 1000, count) == 0);
  CHECK(count == 1'000'001);
}

TEST_CASE("What a run holds does not depend on its length, and is little") {
  const auto rest = at_rest(SO3xR3<double>{});
  using Ideal = decltype(simulate(rest, Imu{}));
  STATIC_CHECK(sizeof(Ideal::Iterator) < 256);
  STATIC_CHECK(sizeof(decltype(simulate(rest, everything))::Iterator) < 16384);
}
