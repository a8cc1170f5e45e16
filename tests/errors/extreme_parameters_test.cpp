// SPDX-License-Identifier: MIT
// Terms take any parameters that they do not refuse: none makes a reading that is no number.
#include <cmath>
#include <concepts>
#include <limits>
#include <splinertia/splinertia.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename Scalar>
std::vector<Scalar> extremes() {
  const Scalar large = std::same_as<Scalar, float> ? Scalar(1e30) : Scalar(1e300), root = std::sqrt(large);
  return {0,
          1,
          large,
          root,
          1 / root,
          1 / large,
          std::numeric_limits<Scalar>::denorm_min(),
          -1,
          -large,
          -root,
          -1 / root,
          -1 / large,
          Scalar(0.25),
          Scalar(0.7),
          1000,
          std::numeric_limits<Scalar>::max(),
          -std::numeric_limits<Scalar>::max(),
          largest_factor<Scalar>(),
          -largest_factor<Scalar>()};
}

/// Calls use(parameter, parameter, parameter) with all combinations of extremes.
template <typename Scalar>
void for_all_extremes(const auto& use) {
  const std::vector<Scalar> numbers = extremes<Scalar>();
  for (const Scalar a : numbers) {
    for (const Scalar b : numbers) {
      for (const Scalar c : numbers) use(a, b, c);
    }
  }
}

/// What a term makes of some samples up to 10 times that size must be numbers, at high and low rates.
template <typename Scalar, typename Term>
void check_term(const Term& term, const std::string& parameters, Scalar size) {
  for (const double rate : {1e-3, 200.0, 1e9}) {
    const ErrorModel model{term};
    auto state = model.start(StreamKey(1));
    for (int i = 0; i < 6; ++i) {
      const auto interval = static_cast<Scalar>(1 / rate), elapsed = static_cast<Scalar>(i / rate);
      bool good = true;
      if constexpr (ClockTerm<Term>) {
        Stamp<Scalar> stamp{Scalar(1), false, interval, i == 0, elapsed};
        model.apply(stamp, state);
        good = !std::isnan(stamp.offset);
      } else {
        const Eigen::Vector3<Scalar> value(Scalar(0), size * Scalar(i), size * Scalar(-9.8));
        ImuSensorSample<Scalar> sample{
            {value, Eigen::Vector3<Scalar>::Constant(Scalar(0.1)), interval, i == 0, elapsed}, {value, value}};
        model.apply(sample, state);
        good = !sample.value.hasNaN() && !sample.bias.hasNaN();
      }
      if (!good) FAIL_CHECK(Term::name << " with " << parameters << " at " << rate << " Hz, sample " << i);
      if (!good) return;
    }
  }
}
template <typename Scalar, typename Term>
void check_term(const Term& term, const std::string& parameters) {
  check_term<Scalar>(term, parameters, Scalar(1));
  check_term<Scalar>(term, parameters, Scalar(std::same_as<Scalar, float> ? 1e11 : 1e101));
}

template <typename Scalar>
void check(const auto& make) {
  int accepted = 0;
  for_all_extremes<Scalar>([&](Scalar a, Scalar b, Scalar c) {
    try {
      check_term<Scalar>(make(a, b, c), message(a, ", ", b, ", ", c));
      ++accepted;
    } catch (const std::invalid_argument&) {
    }
  });
  CHECK(accepted > 0);
}

template <typename Scalar>
Eigen::Matrix3<Scalar> matrix(Scalar a, Scalar b, Scalar c) {
  return (Eigen::Matrix3<Scalar>() << a, b, c, b, c, a, c, a, -b).finished();
}

}  // namespace

TEMPLATE_TEST_CASE("No accepted parameter of a term makes a reading that is no number", "", float, double) {
  using S = TestType;
  using P = PerAxis<S>;
  check<S>([](S a, S b, S c) { return ConstantBias(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return TurnOnBias(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return WhiteNoise(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return RandomWalk(P{a, b, c}); });
  check<S>([](S a, S b, S) { return GaussMarkov<S>(a, b); });
  check<S>([](S a, S b, S c) { return GaussMarkov<S>(a, b, PerAxis(c)); });
  check<S>([](S a, S b, S c) { return BiasInstability<S>(a, FlickerBand<S>{b, c}); });
  check<S>([](S a, S b, S c) { return RateRamp(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return QuantizationNoise(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return Quantization(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return Saturation(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return ScaleFactor(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return Misalignment<S>(matrix(a, b, c)); });
  check<S>([](S a, S b, S c) { return GSensitivity<S>(matrix(a, b, c)); });
  check<S>([](S a, S b, S c) { return TemperatureBias<S, WarmUp<S>>(a, WarmUp<S>(b, c, S(10)), S(25)); });
  check<S>([](S a, S b, S c) { return TemperatureBias<S, WarmUp<S>>(a, WarmUp<S>(S(20), b, c), S(25)); });
  check<S>([](S a, S b, S c) { return TemperatureBias<S, WarmUp<S>>(a, WarmUp<S>(b, S(60), S(10)), c); });
  check<S>([](S a, S b, S c) { return TemperatureScale<S, WarmUp<S>>(a, WarmUp<S>(b, c, S(10)), S(25)); });
  check<S>([](S a, S b, S c) { return TemperatureScale<S, WarmUp<S>>(a, WarmUp<S>(S(20), b, c), S(25)); });
  check<S>([](S a, S b, S c) { return TemperatureScale<S, WarmUp<S>>(a, WarmUp<S>(b, S(60), S(10)), c); });
  check<S>([](S a, S b, S c) { return SinusoidalVibration<S>(a, b, c); });
  check<S>([](S a, S b, S c) { return RandomVibration<S>(a, b, c); });
  check<S>([](S a, S b, S c) { return FirstOrderBandwidth(P{a, b, c}); });
  check<S>([](S a, S b, S) { return SecondOrderBandwidth<S>(a, b); });
  check<S>([](S a, S b, S c) { return GSquaredSensitivity(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return SizeEffect<S>(matrix(a, b, c)); });
  check<S>([](S a, S b, S c) { return VibrationRectification(P{a, b, c}); });
  check<S>([](S a, S b, S c) { return ScaleFactorAsymmetry(P{a, b, c}); });
  check<S>([](S a, S b, S) { return Spikes(a, b); });
  check<S>([](S a, S b, S) { return StuckReadings<S>(a, b); });
  check<S>([](S a, S b, S c) {
    Eigen::Matrix3<S> correlation = Eigen::Matrix3<S>::Identity();
    correlation(0, 1) = correlation(1, 0) = b;
    return CorrelatedNoise(P{a, c, a}, correlation);
  });
  check<S>([](S a, S, S) { return ClockOffset<S>(a); });
  check<S>([](S a, S, S) { return ClockDrift<S>(a); });
  check<S>([](S a, S, S) { return StampJitter<S>(a); });
  check<S>([](S a, S, S) { return DroppedSamples<S>(a); });
}

TEMPLATE_TEST_CASE("A damping ratio of any size is right or refused", "", float, double) {
  using S = TestType;
  for (S damping = 1; is_finite(damping); damping *= 2) {
    try {
      const SecondOrderBandwidth<S> filter(S(10), damping);
      check_term<S>(filter, message(damping));
      // Two lags far apart: the slow one has the time constant 2ζ/ω.
      StateOf<SecondOrderBandwidth<S>, 3> state{};
      SensorSample<S> sample = testing::sample_with<S>(Eigen::Vector3<S>::Zero());
      sample.interval = damping / S(1000);
      filter.apply(sample, state);
      for (int i = 0; i < 2; ++i) {
        sample.first = false;
        sample.value.setOnes();
        filter.apply(sample, state);
      }
      const S h = sample.interval * S(10) * pi_of<S>() / damping;
      const S expected = S(1) - exp_minus(h) * one_minus_exp_minus(h) / h;
      if (damping > 1000) CHECK(std::abs(sample.value.x() - expected) < S(1e-5));
    } catch (const std::invalid_argument&) {
      CHECK(damping > S(1e12));
    }
    try {
      check_term<S>(RandomVibration<S>(S(1), S(10), damping), message(damping));
    } catch (const std::invalid_argument&) {
      CHECK(damping > S(1e12));
    }
  }
  CHECK_THROWS_WITH(
      (SecondOrderBandwidth<double>(10, 1e160)),
      "SecondOrderBandwidth: damping ratio is 1e+160, expected a number whose third power does not overflow");
}
