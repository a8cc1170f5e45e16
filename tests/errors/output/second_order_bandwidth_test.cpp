// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <splinertia/detail/pi.hpp>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <type_traits>
#include <vector>

#include "errors/one_term.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using testing::regular_times, testing::responses, testing::sample_with;

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The largest output that an input within [−1, 1] can have: the integral of the absolute impulse response.
double largest_gain(double damping_ratio) {
  if (damping_ratio >= 1) return 1;
  return 1 / std::tanh(turn / 4 * damping_ratio / std::sqrt(1 - damping_ratio * damping_ratio));
}

}  // namespace

TEMPLATE_TEST_CASE("It starts settled, and a constant passes as it is", "", float, double) {
  using Scalar = TestType;
  const Eigen::Vector3<Scalar> value(Scalar(1.1), Scalar(-2.3), Scalar(1e6));
  for (const Scalar& frequency : {Scalar(1e-6), Scalar(1), Scalar(1e6)}) {
    const SecondOrderBandwidth term{frequency, Scalar(0.7)};
    for (const auto& y : responses(term, regular_times(Scalar(0.01), 50), [&](Scalar) { return value; }))
      REQUIRE(y == value);
  }
}

TEMPLATE_TEST_CASE("A ramp is followed with the delay 2 zeta/omega at any rate", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const Scalar frequency = 2, omega = 2 * splinertia::detail::pi_of<Scalar>() * frequency;
  const PerAxis<Scalar> damping_ratios(Scalar(0.2), 1, 3);
  const Eigen::Vector3<Scalar> start(1, 2, 3), slope(1, -5, 20);
  for (const Scalar& interval : {Scalar(0.002), Scalar(0.05), Scalar(3)}) {
    const auto times = regular_times(interval, 2000);
    const auto outputs = responses(SecondOrderBandwidth{frequency, damping_ratios}, times,
                                   [&](Scalar t) { return Eigen::Vector3<Scalar>(start + slope * t); });
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Scalar t = times[i];
      for (int axis = 0; axis < 3; ++axis) {
        const Scalar zeta = damping_ratios[static_cast<std::size_t>(axis)];
        // Until it has settled: the distance from the delayed ramp is 2ζ/ω at first, its derivative −1.
        const Eigen::Matrix<Scalar, 2, 2> transition = oscillator_transition<Scalar>(omega * t, zeta);
        const Scalar transient = (transition(0, 0) * 2 * zeta - transition(0, 1)) / omega;
        const Scalar expected = start[axis] + slope[axis] * (t - 2 * zeta / omega + transient);
        const Scalar size = std::abs(start[axis]) + std::abs(slope[axis]) * t;
        const Scalar memory = std::max(2 * zeta, 1 / zeta) / omega;  // the slower time constant
        const Scalar steps = std::min(Scalar(i + 1), 1 + memory / interval);
        REQUIRE(std::abs(outputs[i][axis] - expected) <= 8 * eps * size * steps);
      }
    }
    if (times.back() > 100) {
      const Scalar delay = 2 * damping_ratios[2] / omega;
      CHECK(std::abs((times.back() - (outputs.back()[2] - start[2]) / slope[2]) / delay - 1) <
            64 * eps * times.back() / delay);
    }
  }
}

TEST_CASE("A well sampled sine comes out as the continuous filter has it; Butterworth's is at -3 dB") {
  const double natural = 10;
  for (const double zeta : {std::sqrt(0.5), 0.1, 2.0}) {
    for (const double frequency : {1.0, 10.0, 40.0}) {
      const double interval = 1 / (frequency * 512), ratio = frequency / natural;
      const std::complex<double> gain = 1.0 / std::complex<double>(1 - ratio * ratio, 2 * zeta * ratio);
      if (zeta == std::sqrt(0.5) && ratio == 1) CHECK_THAT(std::abs(gain), WithinRel(std::sqrt(0.5), 1e-12));
      // The slower time constant is 10 periods of the natural frequency over 2π: 31 of them make 6 s.
      const auto times = regular_times(interval, static_cast<int>(6 / interval) + 1024);
      const auto outputs = responses(SecondOrderBandwidth{natural, zeta}, times, [&](double t) {
        return Eigen::Vector3d(std::sin(turn * frequency * t), std::cos(turn * frequency * t), 0);
      });
      // A straight line is off the sine by (ω interval)²/8 at most.
      const double tolerance = std::pow(turn / 512, 2) / 8 * largest_gain(zeta);
      double largest = 0;
      for (std::size_t i = times.size() - 1024; i < times.size(); ++i) {
        const double phase = turn * frequency * times[i] + std::arg(gain);
        REQUIRE_THAT(outputs[i][0], WithinAbs(std::abs(gain) * std::sin(phase), tolerance));
        REQUIRE_THAT(outputs[i][1], WithinAbs(std::abs(gain) * std::cos(phase), tolerance));
        largest = std::max(largest, outputs[i][0]);
      }
      CHECK_THAT(largest, WithinAbs(std::abs(gain), 2 * tolerance));
    }
  }
}

TEST_CASE("Straight lines between samples at irregular times are the same as between many regular ones") {
  const SecondOrderBandwidth term{PerAxis<double>(0.3, 3, 30), PerAxis<double>(0.1, 1, 3)};
  const std::vector<double> corners{0, 0.25, 0.375, 1.5, 1.625, 2};
  const auto input = [&](double t) {
    const auto next = std::min<std::size_t>(
        static_cast<std::size_t>(std::upper_bound(corners.begin(), corners.end(), t) - corners.begin()),
        corners.size() - 1);
    const double u = (t - corners[next - 1]) / (corners[next] - corners[next - 1]);
    const auto value = [](std::size_t i) { return (i % 2 == 0 ? 1.0 : -2.0) * static_cast<double>(i); };
    return Eigen::Vector3d(Eigen::Vector3d::Constant(value(next - 1) * (1 - u) + value(next) * u));
  };
  const auto coarse = responses(term, corners, input);
  const auto fine = responses(term, regular_times(1.0 / 1024, 2048), input);
  for (std::size_t i = 0; i < corners.size(); ++i)
    CHECK((coarse[i] - fine[static_cast<std::size_t>(corners[i] * 1024)]).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("From nearly no bandwidth to all of it, whatever the damping, the output is bounded", "", float,
                   double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  testing::Random random(1);
  std::vector<Scalar> frequencies{std::numeric_limits<Scalar>::denorm_min(), std::numeric_limits<Scalar>::max()};
  for (double frequency = 1e-9; frequency < 2e9; frequency *= 10) frequencies.push_back(static_cast<Scalar>(frequency));
  for (const Scalar& frequency : frequencies) {
    for (const double zeta : {1e-6, 0.01, 0.7, 1.0, 1.3, 100.0, 1e6}) {
      INFO("natural frequency " << frequency << ", damping ratio " << zeta);
      std::vector<Eigen::Vector3<Scalar>> inputs;
      const SecondOrderBandwidth<Scalar> term{frequency, static_cast<Scalar>(zeta)};
      const auto outputs = responses(term, regular_times(Scalar(0.125), 200), [&](Scalar) {
        inputs.push_back(Eigen::Vector3<Scalar>::NullaryExpr([&] { return static_cast<Scalar>(random.symmetric()); }));
        return inputs.back();
      });
      for (const auto& y : outputs) REQUIRE(y.cwiseAbs().maxCoeff() <= static_cast<Scalar>(largest_gain(zeta) + 1e-5));
      // It moves by (ωt)² in 25 s, or ωt/ζ, and by the rounding of each sample's share.
      if (frequency <= Scalar(1e-8)) CHECK((outputs.back() - inputs.front()).norm() < 1000 * eps + Scalar(1e-11));
      if (frequency >= Scalar(1e8) && zeta == 0.7) CHECK((outputs.back() - inputs.back()).norm() < Scalar(1e-6));
    }
  }
}

TEST_CASE("It filters what stands before it and nothing behind it") {
  const ErrorModel model{ConstantBias{1}, SecondOrderBandwidth{1, 0.7}, ConstantBias{2}};
  auto state = model.start(StreamKey(1));
  for (const bool first : {true, false}) {
    auto sample = sample_with<double>(Eigen::Vector3d::Constant(first ? 0 : 10));
    sample.first = first;
    model.apply(sample, state);
    CHECK(sample.bias == Eigen::Vector3d::Constant(3));
    if (first) CHECK(sample.value == Eigen::Vector3d::Constant(3));
    if (!first) CHECK((sample.value[0] > 3 && sample.value[0] < 4));
  }
}

TEST_CASE("Parameters are given as numbers, one for each axis, or vectors") {
  STATIC_CHECK(std::is_same_v<decltype(SecondOrderBandwidth{50, 1}), SecondOrderBandwidth<double>>);
  STATIC_CHECK(std::is_same_v<decltype(SecondOrderBandwidth{50.0F, 0.7F}), SecondOrderBandwidth<float>>);
  CHECK(SecondOrderBandwidth{Eigen::Vector3d(1, 2, 3), 0.7}.natural_frequency[1] == 2);
  CHECK(SecondOrderBandwidth{50, Eigen::Vector3d(1, 2, 3)}.damping_ratio[2] == 3);
  static constexpr ErrorModel model{SecondOrderBandwidth{50, PerAxis<double>(1, 2, 3)}};
  STATIC_CHECK(std::get<0>(model.terms()).damping_ratio[2] == 3);
}

TEST_CASE("Parameters that are none are refused") {
  CHECK_THROWS_WITH((SecondOrderBandwidth{0, 1}),
                    "SecondOrderBandwidth: natural frequency is 0, expected a finite number > 0");
  CHECK_THROWS_WITH((SecondOrderBandwidth{PerAxis<double>(1, testing::nan<double>, 1), 1}),
                    "SecondOrderBandwidth: natural frequency is nan, expected a finite number > 0");
  CHECK_THROWS_WITH((SecondOrderBandwidth{1, 0}),
                    "SecondOrderBandwidth: damping ratio is 0, expected a finite number > 0");
  CHECK_THROWS_WITH((SecondOrderBandwidth{1, -0.5}),
                    "SecondOrderBandwidth: damping ratio is -0.5, expected a finite number > 0");
  CHECK_THROWS_AS((SecondOrderBandwidth{1, testing::infinity<double>}), std::invalid_argument);
}

TEST_CASE("A second-order bandwidth in words") {
  CHECK(describe(SecondOrderBandwidth{50, 0.7}, SensorKind::accel) ==
        "second-order bandwidth: natural frequency 50 Hz, damping ratio 0.7");
}
