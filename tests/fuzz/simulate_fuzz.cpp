// SPDX-License-Identifier: MIT
// Any error terms with any parameters, any options, along a curve.
#include <chrono>
#include <cmath>
#include <splinertia/splinertia.hpp>
#include <vector>

#include "fuzz/motions.hpp"
#include "support/any_error_model.hpp"

namespace splinertia::fuzz::simulate_target {
using std::chrono::nanoseconds;

PerAxis<double> per_axis(Numbers& numbers) {
  if (numbers.input.flag()) return numbers();
  const double x = numbers(), y = numbers();
  return {x, y, numbers()};
}

void add_term(Numbers& n, AnySensorModel& model) {
  const auto any = [&] { return per_axis(n); };
  switch (n.input.integer(0, 16)) {
    case 0:
      return model.add(ConstantBias{any()});
    case 1:
      return model.add(TurnOnBias{any()});
    case 2:
      return model.add(WhiteNoise{any()});
    case 3:
      return model.add(RandomWalk{any()});
    case 4:
      return model.add(GaussMarkov{any(), any()});
    case 5:
      return model.add(BiasInstability{any(), FlickerBand<double>{n(), n()}});
    case 6:
      return model.add(RateRamp{any()});
    case 7:
      return model.add(QuantizationNoise{any()});
    case 8:
      return model.add(Quantization{any()});
    case 9:
      return model.add(Saturation{any()});
    case 10:
      return model.add(ScaleFactor{any()});
    case 11:
      return model.add(TemperatureBias{any(), WarmUp<double>{n(), n(), n()}, n()});
    case 12:
      return model.add(TemperatureScale{any(), WarmUp<double>{n(), n(), n()}, n()});
    case 13:
      return model.add(SinusoidalVibration{any(), any(), any()});
    case 14:
      return model.add(RandomVibration{any(), any(), any()});
    case 15:
      return model.add(FirstOrderBandwidth{any()});
    default:
      return model.add(SecondOrderBandwidth{any(), any()});
  }
}

void add_term(Numbers& n, AnyStampModel& model) {
  switch (n.input.integer(0, 3)) {
    case 0:
      return model.add(ClockOffset{n()});
    case 1:
      return model.add(ClockDrift{n()});
    case 2:
      return model.add(StampJitter{n()});
    default:
      return model.add(DroppedSamples{n.input.moderate(1)});
  }
}

/// The readings may be far from those of an IMU, and the stamps too, but they are numbers in order.
template <typename Curve>
void use(Numbers& numbers, const Curve& curve) {
  using Time = typename Curve::Time;
  Input& input = numbers.input;
  (void)accepted("", [&] {
    AnyImu imu;
    for (int i = input.integer(0, 3); i > 0; --i) add_term(numbers, imu.gyro);
    for (int i = input.integer(0, 2); i > 0; --i) add_term(numbers, imu.accel);
    for (int i = input.integer(0, 2); i > 0; --i) add_term(numbers, imu.stamps);
    SimulationOptions<double, Time> options{.rate = 1 + std::abs(numbers()), .seed = input.bits<std::uint64_t>()};
    if (numbers.wild) options.rate = numbers();
    if (input.flag()) options.gravity = numbers.vector();
    if (input.flag()) options.start = numbers.time<Time>();
    if (input.flag()) options.end = numbers.time<Time>();
    const auto simulation = simulate(curve, imu, options);
    std::size_t count = 0;
    Time before{};
    for (const auto& reading : simulation) {
      expect(count < simulation.size(), count, " samples, expected at most ", simulation.size());
      if (numbers.usual) {
        expect(reading.gyro.allFinite() && reading.accel.allFinite(), "sample ", count, " is not finite");
        expect(count == 0 || reading.time > before, "stamps do not increase at sample ", count);
      }
      before = reading.time;
      if (++count == 100) break;
    }
  });
}

const Target target{"simulate", [](Input input) {
                      const bool integer = input.flag();
                      Numbers numbers{input};
                      const std::vector<SO3xR3<double>> points(8);
                      if (integer)
                        return use(numbers, Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>>(
                                                {nanoseconds{0}, nanoseconds{200'000'000}}, points));
                      use(numbers, Circle<>{});
                    }};

}  // namespace splinertia::fuzz::simulate_target
