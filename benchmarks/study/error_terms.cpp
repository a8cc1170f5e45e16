// SPDX-License-Identifier: MIT
// What the terms of an error model cost: each alone on all axes, and models that are used.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
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
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <splinertia/errors/scale/temperature_scale.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <splinertia/imu/presets.hpp>
#include <string>
#include <vector>

#include "study.hpp"

namespace study {
namespace {

using namespace splinertia;
using Vector = Eigen::Vector3<double>;

/// 200 Hz, unknown while compiling.
double sampling_interval() {
  static volatile double rate = 200;
  return 1 / rate;
}

/// Random, so that no branch on them is foreseen, and few enough for the fastest cache. Normal, of deviation 1 in rad/s
/// and m/s².
const std::vector<ImuMeasurement<double>>& measurements() {
  static const std::vector<ImuMeasurement<double>> the = [] {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal;
    std::vector<ImuMeasurement<double>> all(512);
    for (auto& measurement : all) {
      for (double& x : measurement.gyro) x = normal(bits);
      for (double& x : measurement.accel) x = normal(bits);
    }
    return all;
  }();
  return the;
}

// g++ 12 takes the last stamp, an optional, for read before it is written where samples may be dropped.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

/// The errors of one run, put into so many samples of both sensors. The readings are wanted, their true biases not.
template <typename Sensors>
[[gnu::noinline]] void apply(const Sensors& sensors, std::size_t calls) {
  const double interval = sampling_interval();
  const auto* ideal = measurements().data();
  const std::size_t count = measurements().size();
  ImuErrors errors(sensors, StreamKey(0) / std::uint64_t{0});
  typename decltype(errors)::Reading reading;
  for (std::size_t i = 0; i < calls; ++i) {
    if (!errors.apply(static_cast<double>(i) * interval, ideal[i % count], interval, reading)) continue;
    // Copies: an address of the reading itself would make somebody read the biases, too.
    const Vector gyro = reading.gyro, accel = reading.accel;
    keep(gyro);
    keep(accel);
    if constexpr (requires { reading.true_time; }) {
      const double stamp = reading.time;
      keep(stamp);
    }
  }
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

struct Model {
  std::string name;
  int axes;  // that have errors
  Kernel kernel;
};

template <typename Sensors>
Model model(const std::string& name, int axes, const Sensors& sensors) {
  return {name, axes, [sensors](std::size_t calls) { apply(sensors, calls); }};
}

/// The same model for both sensors.
template <typename... Terms>
Model both(const std::string& name, const Terms&... terms) {
  const ErrorModel<Terms...> sensor(terms...);
  return model(name, 6, Imu{sensor, sensor});
}

template <typename Term>
Model clock(const std::string& name, const Term& term) {
  return model(name, 0, Imu{ErrorModel{}, ErrorModel{}, ErrorModel{term}});
}

/// A matrix near the identity, unknown while compiling.
Eigen::Matrix3<double> matrix() {
  const double one = sampling_interval() * 200;
  return Eigen::Matrix3<double>{{1.01, 0.02, 0.03}, {0.01, 0.99, 0.01}, {0.04, 0.02, 1.02}} * one;
}

/// Parameters are of the size that sensors have, but for limits that clip and steps that round.
std::vector<Model> models() {
  const WhiteNoise white{0.015};
  const RandomWalk walk{5e-5};
  const ConstantBias bias{PerAxis<double>(0.1, 0.2, 0.3)};
  const Misalignment misalignment{matrix()};
  const Quantization quantization{0.001};
  const Saturation saturation{2.0};
  const WarmUp warm_up{25.0, 45.0, 600.0};
  const BiasInstability flicker{1e-3};
  std::vector<Model> all{
      both("ConstantBias", bias),
      both("TurnOnBias", TurnOnBias{0.1}),
      both("WhiteNoise", white),
      both("RandomWalk", walk),
      both("GaussMarkov", GaussMarkov{0.01, 100.0}),
      both("BiasInstability", flicker),
      both("RateRamp", RateRamp{1e-6}),
      both("QuantizationNoise", QuantizationNoise{1e-5}),
      both("Quantization", quantization),
      both("Saturation", saturation),
      both("ScaleFactor", ScaleFactor{0.01}),
      both("Misalignment", misalignment),
      model("GSensitivity", 3, Imu{ErrorModel{GSensitivity{Eigen::Matrix3<double>(matrix() * 1e-3)}}, ErrorModel{}}),
      both("TemperatureBias", TemperatureBias{1e-3, warm_up}),
      both("TemperatureScale", TemperatureScale{1e-4, warm_up}),
      both("SinusoidalVibration", SinusoidalVibration{0.1, 30.0}),
      both("RandomVibration", RandomVibration{0.1, 30.0, 0.1}),
      both("FirstOrderBandwidth", FirstOrderBandwidth{50.0}),
      both("SecondOrderBandwidth", SecondOrderBandwidth{50.0, 0.7}),
      clock("ClockOffset", ClockOffset{0.003}),
      clock("ClockDrift", ClockDrift{2e-5}),
      clock("StampJitter", StampJitter{1e-4}),
      clock("DroppedSamples", DroppedSamples{0.01}),
      both("WhiteNoise + RandomWalk", white, walk),
      both("WhiteNoise + RandomWalk + ConstantBias", white, walk, bias),
      both("WhiteNoise + RandomWalk + BiasInstability", white, walk, flicker),
      // That of the design: six terms of the gyroscope, two of the accelerometer.
      model("design's example", 6,
            Imu{ErrorModel{misalignment, bias, walk, white, quantization, saturation}, ErrorModel{white, walk}}),
      // One of each kind in the order of a physical sensor (docs/error_models.md).
      both("full sensor", SecondOrderBandwidth{50.0, 0.7}, misalignment, bias, walk, flicker, white, quantization,
           saturation),
      model("presets::course", 6, presets::course),
      model("presets::euroc", 6, presets::euroc),
      model("presets::mpu6050", 6, presets::mpu6050),
      model("presets::adis16448", 6, presets::adis16448),
      model("presets::stim300", 6, presets::stim300),
  };
  return all;
}

Times summary(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

}  // namespace

/// error_terms.csv: ns a sample of an IMU, and what of it is more than of a loop without errors that ran right before.
void error_terms(const Options& options) {
  Table table(options.output / "error_terms.csv", {"model", "axes", "ns_min", "ns_median", "ns_max", "instructions",
                                                   "extra_ns_min", "extra_ns_median", "extra_ns_max"});
  // A repetition takes the least of several short times: on a shared machine a long one is interrupted every time.
  const auto least = std::chrono::microseconds(options.quick ? 200 : 2000);
  const int attempts = options.quick ? 2 : 5;
  const Model empty = both("ErrorModel{}");
  // Counting needs valgrind and a program that it knows the instructions of: benchmarks/error_models --instructions.
  const std::optional<double> instructions;
  const std::vector<Model> all = models();
  std::vector<double> alone;
  std::vector<std::vector<double>> times(all.size()), extra(all.size());
  // A repetition is one of all models, so that minutes in which the machine is slow do not meet one of them alone.
  for (int repetition = 1; repetition <= options.repetitions; ++repetition) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto pair = paired({empty.kernel, all[k].kernel}, attempts, least);
      alone.push_back(pair[0].min);
      times[k].push_back(pair[1].min);
      extra[k].push_back(pair[1].min - pair[0].min);
    }
    progress("error_terms: ", all.size(), " models, repetition ", repetition, " of ", options.repetitions);
  }
  const Times nothing = summary(alone);
  table.row(empty.name, empty.axes, nothing.min, nothing.median, nothing.max, instructions, 0, 0, 0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Times whole = summary(times[k]), more = summary(extra[k]);
    table.row(all[k].name, all[k].axes, whole.min, whole.median, whole.max, instructions, more.min, more.median,
              more.max);
  }
  table.commit();
}

}  // namespace study
