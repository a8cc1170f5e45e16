// SPDX-License-Identifier: MIT
/// The same seed means the same samples: everywhere, and whatever else there is in the model.
#include <algorithm>
#include <bit>
#include <random>
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
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <splinertia/errors/scale/temperature_scale.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

// Every term that draws random numbers, and every one that uses more than the four operations.
template <typename Scalar>
auto all_terms() {
  const auto s = [](double x) { return static_cast<Scalar>(x); };
  return ErrorModel{TurnOnBias{s(0.1)},
                    RandomVibration{PerAxis<Scalar>(s(0.1), s(0.2), s(0.3)), PerAxis<Scalar>(s(30), s(3), s(0.01)),
                                    PerAxis<Scalar>(s(0.05), s(1), s(4))},
                    SinusoidalVibration{s(0.2), s(17.3), s(0.1)},
                    FirstOrderBandwidth{s(40)},
                    SecondOrderBandwidth{PerAxis<Scalar>(s(60), s(5), s(90)), PerAxis<Scalar>(s(0.7), s(1), s(3))},
                    TemperatureBias{s(1e-3), WarmUp<Scalar>{s(20), s(45), s(200)}},
                    TemperatureScale{s(1e-4), WarmUp<Scalar>{s(20), s(45), s(200)}},
                    GaussMarkov{PerAxis<Scalar>(s(0.1), s(0.2), s(0.3)), PerAxis<Scalar>(s(0.01), s(3), s(1e4))},
                    BiasInstability{s(0.01)},
                    RandomWalk{s(0.01)},
                    QuantizationNoise{s(1e-4)},
                    WhiteNoise{s(0.015)}};
}

// Of a sensor at rest, with changes of the rate in between.
template <typename Scalar>
std::uint64_t hash_of_all_terms(int n) {
  const auto model = all_terms<Scalar>();
  auto state = model.start(StreamKey(2026) / "accel");
  const Eigen::Vector3<Scalar> truth(Scalar(0.125), Scalar(-0.5), Scalar(9.80665));
  std::uint64_t hash = 0;
  for (int i = 0; i < n; ++i) {
    SensorSample<Scalar> sample{truth, Eigen::Vector3<Scalar>::Zero(), i % 100 == 0 ? Scalar(0.0075) : Scalar(0.005),
                                i == 0, Scalar(i) * Scalar(0.005)};
    model.apply(sample, state);
    for (int axis = 0; axis < 3; ++axis) {
      hash = scramble(hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(sample.value[axis])));
      hash = scramble(hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(sample.bias[axis])));
    }
  }
  return hash;
}

template <typename Generator = Xoshiro256>
std::vector<BasicImuReading<double, double>> samples(const auto& imu, std::uint64_t seed = 1, std::uint64_t which = 0) {
  const auto motion = at_rest(SO3xR3<double>{});
  std::vector<BasicImuReading<double, double>> result;
  for (const auto& r :
       simulate<Generator>(motion, imu, {.rate = 100, .seed = seed, .imu = which, .start = 0.0, .end = 5.0})) {
    result.push_back(r);
  }
  return result;
}

enum class Of { gyro, accel };

bool same(const std::vector<BasicImuReading<double, double>>& one,
          const std::vector<BasicImuReading<double, double>>& other, Of sensor) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [&](const auto& a, const auto& b) {
    return sensor == Of::gyro ? a.gyro == b.gyro && a.gyro_bias == b.gyro_bias
                              : a.accel == b.accel && a.accel_bias == b.accel_bias;
  });
}

}  // namespace

// The random numbers are the same everywhere: normal_test, reproducible_math_test. Where compilers make a·b + c one
// rounding (x86-64-v3, AArch64), what is done with them differs in last bits, unless told -ffp-contract=off.
#if !defined(__FP_FAST_FMA) && !defined(__FMA__) && !defined(__aarch64__)
TEST_CASE("A hundred thousand samples of all terms are the same to the last bit with every compiler") {
  CHECK(hash_of_all_terms<double>(100'000) == 0x9ffac78a8d849d4eU);
  CHECK(hash_of_all_terms<float>(100'000) == 0xce741493fe45c046U);
}

TEST_CASE("Stamps are the same to the last bit with every compiler") {
  const ErrorModel model{ClockOffset{0.003}, ClockDrift{2e-5}, StampJitter{1e-4}, DroppedSamples{0.1}};
  auto state = model.start(StreamKey(2026) / "stamps");
  std::uint64_t hash = 0;
  for (int i = 0; i < 100'000; ++i) {
    Stamp<double> stamp{0, false, 0.0078125, i == 0, i * 0.0078125};
    model.apply(stamp, state);
    hash = scramble(hash ^ std::bit_cast<std::uint64_t>(stamp.offset) ^ (stamp.dropped ? 1 : 0));
  }
  CHECK(hash == 0x857dd10ed00e3db1U);
}
#endif

TEST_CASE("A term more leaves the random numbers of the others as they were") {
  // Each writes what it draws, with nothing added to it: zero densities of the others add zero.
  const ErrorModel walk{RandomWalk{0.1}};
  const ErrorModel more{TurnOnBias{0},      BiasInstability{0}, WhiteNoise{0}, RandomWalk{0.1},
                        GaussMarkov{0, 10}, WhiteNoise{0},      RandomWalk{0}, QuantizationNoise{0}};
  const auto one = samples(Imu{walk, walk}), other = samples(Imu{more, walk});
  CHECK(same(one, other, Of::gyro));
  CHECK(same(one, other, Of::accel));
  // The second of a kind draws others than the first.
  CHECK_FALSE(same(one, samples(Imu{ErrorModel{RandomWalk{0}, RandomWalk{0.1}}, walk}), Of::gyro));
  // A term without random numbers in front changes none.
  CHECK(same(one, samples(Imu{ErrorModel{ConstantBias{0}, ScaleFactor{0}, RateRamp{0}, RandomWalk{0.1}}, walk}),
             Of::gyro));
}

TEST_CASE("What the other sensor, the stamps or another IMU do leaves a sensor as it was") {
  const auto all = all_terms<double>();
  const ErrorModel walk{RandomWalk{0.1}};
  const ErrorModel ideal{};
  const auto one = samples(Imu{all, ideal});
  CHECK(same(one, samples(Imu{all, walk}), Of::gyro));
  CHECK(same(one, samples(Imu{all, all}), Of::gyro));
  CHECK(same(samples(Imu{walk, all}), samples(Imu{all, all}), Of::accel));
  for (const double jitter : {0.0, 1e-3}) {
    const ErrorModel stamps{ClockOffset{0.1}, StampJitter{jitter}};
    CHECK(same(one, samples(Imu{all, ideal, stamps}), Of::gyro));
  }
  // Two sensors of one kind, and two IMUs, have errors of their own.
  const auto both = samples(Imu{walk, walk});
  CHECK(both[10].gyro_bias != both[10].accel_bias);
  CHECK_FALSE(same(one, samples(Imu{all, ideal}, 1, 1), Of::gyro));
  CHECK_FALSE(same(one, samples(Imu{all, ideal}, 2, 0), Of::gyro));
  CHECK_FALSE(same(samples(Imu{all, ideal}, 2, 1), samples(Imu{all, ideal}, 1, 2), Of::gyro));
}

TEST_CASE("Samples that arrive are those that would have, had none been dropped") {
  const auto all = all_terms<double>();
  const auto complete = samples(Imu{all, all}), rest = samples(Imu{all, all, ErrorModel{DroppedSamples{0.3}}});
  CHECK(rest.size() < complete.size());
  std::size_t i = 0;
  bool found = true;
  for (const auto& r : rest) {
    while (i < complete.size() && complete[i].time != r.time) ++i;
    found = found && i < complete.size() && complete[i].gyro == r.gyro && complete[i].accel_bias == r.accel_bias;
  }
  CHECK(found);
}

TEMPLATE_TEST_CASE("The same holds with any generator", "", std::mt19937, std::mt19937_64) {
  const ErrorModel walk{RandomWalk{0.1}};
  const ErrorModel more{WhiteNoise{0}, RandomWalk{0.1}};
  const auto one = samples<TestType>(Imu{walk, walk});
  CHECK(same(one, samples<TestType>(Imu{more, ErrorModel{}}), Of::gyro));
  CHECK_FALSE(same(one, samples<TestType>(Imu{walk, walk}, 2), Of::gyro));
  CHECK_FALSE(same(one, samples(Imu{walk, walk}), Of::gyro));
}
