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
#include <splinertia/errors/output/first_order_bandwidth.hpp>
#include <type_traits>
#include <vector>

#include "errors/one_term.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using testing::regular_times, testing::responses, testing::sample_with;

namespace {
constexpr double turn = 2 * std::numbers::pi;
}

TEMPLATE_TEST_CASE("It starts settled, and a constant passes as it is", "", float, double) {
  using Scalar = TestType;
  const Eigen::Vector3<Scalar> value(Scalar(1.1), Scalar(-2.3), Scalar(1e6));
  for (const Scalar& cutoff : {Scalar(1e-6), Scalar(1), Scalar(1e6)}) {
    const FirstOrderBandwidth term{cutoff};
    for (const auto& y : responses(term, regular_times(Scalar(0.01), 50), [&](Scalar) { return value; }))
      REQUIRE(y == value);
  }
}

TEMPLATE_TEST_CASE("A ramp is followed with the delay tau at any rate", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const Eigen::Vector3<Scalar> start(1, 2, 3), slope(1, -5, 20);
  const PerAxis<Scalar> cutoff(Scalar(0.5), 2, 30);
  for (const Scalar& interval : {Scalar(0.001), Scalar(0.05), Scalar(3)}) {
    const auto times = regular_times(interval, 200);
    const auto outputs = responses(FirstOrderBandwidth{cutoff}, times,
                                   [&](Scalar t) { return Eigen::Vector3<Scalar>(start + slope * t); });
    for (std::size_t i = 0; i < times.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const Scalar tau =
            Scalar(1) / (2 * splinertia::detail::pi_of<Scalar>() * cutoff[static_cast<std::size_t>(axis)]);
        const Scalar t = times[i], delay = -tau * std::expm1(-t / tau);
        const Scalar size = std::abs(start[axis]) + std::abs(slope[axis]) * t;
        // Each step is rounded; what is forgotten of that in a step is at least interval/τ of it, or all.
        const Scalar steps = std::min(Scalar(i + 1), 1 + tau / interval);
        REQUIRE(std::abs(outputs[i][axis] - (start[axis] + slope[axis] * (t - delay))) <= 4 * eps * size * steps);
      }
    }
  }
}

TEST_CASE("A well sampled sine comes out as the continuous filter has it, at -3 dB at the cutoff") {
  const double cutoff = 10;
  for (const double frequency : {1.0, 10.0, 40.0}) {
    const double interval = 1 / (frequency * 512);
    const std::complex<double> gain = 1.0 / std::complex<double>(1, frequency / cutoff);
    if (frequency == cutoff) CHECK_THAT(std::abs(gain), WithinRel(std::sqrt(0.5), 1e-12));
    // Half a second is 31 time constants: the start is forgotten.
    const auto times = regular_times(interval, static_cast<int>(0.5 / interval) + 1024);
    const auto outputs = responses(FirstOrderBandwidth{cutoff}, times, [&](double t) {
      return Eigen::Vector3d(std::sin(turn * frequency * t), std::cos(turn * frequency * t), 0);
    });
    // A straight line is off the sine by (ω interval)²/8 at most, and a first-order filter makes nothing larger.
    const double tolerance = std::pow(turn / 512, 2) / 8;
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

TEST_CASE("Straight lines between samples at irregular times are the same as between many regular ones") {
  const FirstOrderBandwidth term{PerAxis<double>(0.3, 3, 30)};
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
    CHECK((coarse[i] - fine[static_cast<std::size_t>(corners[i] * 1024)]).norm() < 1e-13);
}

TEST_CASE("A step is answered with 1 - exp(-t/tau) after the straight line up to it") {
  const double tau = 1 / (turn * 5), interval = 0.004;
  const auto times = regular_times(interval, 1000);
  const auto outputs = responses(FirstOrderBandwidth{5}, times,
                                 [](double t) { return Eigen::Vector3d(Eigen::Vector3d::Constant(t > 0 ? 1 : 0)); });
  for (std::size_t i = 1; i < times.size(); ++i) {
    // Ramps up during the first interval, then decays.
    const double after_ramp = 1 - tau / interval * -std::expm1(-interval / tau);
    const double expected = 1 - (1 - after_ramp) * std::exp(-(times[i] - interval) / tau);
    REQUIRE_THAT(outputs[i][0], WithinAbs(expected, 1e-14));
  }
  CHECK_THAT(outputs.back()[0], WithinAbs(1, 1e-14));
}

TEMPLATE_TEST_CASE("From nearly no bandwidth to all of it the output stays within the input", "", float, double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  testing::Random random(1);
  std::vector<Scalar> cutoffs{std::numeric_limits<Scalar>::denorm_min(), std::numeric_limits<Scalar>::max()};
  for (double cutoff = 1e-9; cutoff < 2e9; cutoff *= 10) cutoffs.push_back(static_cast<Scalar>(cutoff));
  for (const Scalar& cutoff : cutoffs) {
    INFO("cutoff " << cutoff);
    std::vector<Eigen::Vector3<Scalar>> inputs;
    const auto outputs = responses(FirstOrderBandwidth{cutoff}, regular_times(Scalar(0.125), 300), [&](Scalar) {
      inputs.push_back(Eigen::Vector3<Scalar>::NullaryExpr([&] { return static_cast<Scalar>(random.symmetric()); }));
      return inputs.back();
    });
    for (const auto& y : outputs) REQUIRE(y.cwiseAbs().maxCoeff() <= 1 + 16 * eps);
    if (cutoff >= Scalar(1e8)) CHECK((outputs.back() - inputs.back()).norm() < Scalar(1e-7) + 4 * eps);
    if (cutoff <= Scalar(1e-8)) CHECK((outputs.back() - inputs.front()).norm() < Scalar(1e-5));
  }
}

TEST_CASE("It filters what stands before it and nothing behind it") {
  const ErrorModel model{ConstantBias{1}, FirstOrderBandwidth{1}, ConstantBias{2}};
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

TEST_CASE("A cutoff is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(FirstOrderBandwidth{50}), FirstOrderBandwidth<double>>);
  STATIC_CHECK(std::is_same_v<decltype(FirstOrderBandwidth{0.1F}), FirstOrderBandwidth<float>>);
  CHECK(FirstOrderBandwidth{Eigen::Vector3d(1, 2, 3)}.cutoff[1] == 2);
  static constexpr ErrorModel model{FirstOrderBandwidth{50}};
  STATIC_CHECK(std::get<0>(model.terms()).cutoff[2] == 50);
}

TEST_CASE("A cutoff that is none is refused") {
  CHECK_THROWS_WITH(FirstOrderBandwidth{0}, "FirstOrderBandwidth: cutoff frequency is 0, expected a finite number > 0");
  CHECK_THROWS_WITH((FirstOrderBandwidth{PerAxis<double>(1, 1, -5)}),
                    "FirstOrderBandwidth: cutoff frequency is -5, expected a finite number > 0");
  CHECK_THROWS_AS(FirstOrderBandwidth{testing::nan<double>}, std::invalid_argument);
  CHECK_THROWS_AS(FirstOrderBandwidth{testing::infinity<double>}, std::invalid_argument);
}

TEST_CASE("A first-order bandwidth in words") {
  CHECK(describe(FirstOrderBandwidth{50}, SensorKind::gyro) == "first-order bandwidth: cutoff frequency 50 Hz");
}
