// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/detail/pi.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <type_traits>
#include <vector>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("It adds amplitude sin(2 pi (f t + phase)) to the reading and nothing to the bias", "", float,
                   double, long double) {
  using Scalar = TestType;
  using Vector = Eigen::Vector3<Scalar>;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const SinusoidalVibration term{PerAxis<Scalar>(1, 2, -3), PerAxis<Scalar>(1, Scalar(0.5), 7),
                                 PerAxis<Scalar>(0, Scalar(0.25), Scalar(0.125))};
  for (const Scalar& t : {Scalar(0), Scalar(0.1), Scalar(1.7)}) {
    const auto sample = applied(term, sample_with<Scalar>(Vector(10, 20, 30), Vector(4, 5, 6), t));
    const Scalar turn = 2 * splinertia::detail::pi_of<Scalar>();
    const Vector expected(10 + std::sin(turn * t), 20 + 2 * std::sin(turn * (t / 2 + Scalar(0.25))),
                          30 - 3 * std::sin(turn * (7 * t + Scalar(0.125))));
    CHECK((sample.value - expected).norm() < 256 * eps);
    CHECK(sample.bias == Vector(4, 5, 6));
  }
}

TEST_CASE("Quarter turns are exact, late in a run too") {
  const SinusoidalVibration term{2, 4, PerAxis<double>(0, 0.25, 0.5)};
  for (const double t : {0.0, 1.0, 1e6}) {
    const auto at = [&](double later) {
      return Eigen::Vector3d(applied(term, sample_with<double>(Eigen::Vector3d::Zero(), {0, 0, 0}, t + later)).value);
    };
    CHECK(at(0) == Eigen::Vector3d(0, 2, 0));
    CHECK(at(1.0 / 16) == Eigen::Vector3d(2, 0, -2));
    CHECK(at(2.0 / 16) == Eigen::Vector3d(0, -2, 0));
    CHECK(at(3.0 / 16) == Eigen::Vector3d(-2, 0, 2));
  }
}

TEST_CASE("Frequency 0 is the sine of the phase") {
  const SinusoidalVibration term{1, 0, 0.125};
  for (const double t : {0.0, 3.0}) {
    CHECK_THAT(applied(term, sample_with<double>(Eigen::Vector3d::Zero(), {0, 0, 0}, t)).value[0],
               WithinAbs(std::sqrt(0.5), 1e-15));
  }
}

TEST_CASE("Above half the sampling rate it shows up below it") {
  const auto samples_of = [](double frequency, double phase) {
    const Imu imu{ErrorModel{SinusoidalVibration{1, frequency, phase}}, ErrorModel{}};
    std::vector<double> values;
    for (const auto& r : simulate(at_rest(SO3xR3<double>{}), imu, {.rate = 128, .start = 5.0, .end = 7.0}))
      values.push_back(r.gyro[0]);
    return values;
  };
  for (const double value : samples_of(128, 0)) CHECK(value == 0);
  CHECK(samples_of(128 + 3, 0) == samples_of(3, 0));
  const auto above = samples_of(64 + 24, 0.125), folded = samples_of(64 - 24, 0.375);  // sin(π − x) = sin x
  for (std::size_t i = 0; i < above.size(); ++i) CHECK_THAT(above[i], WithinAbs(folded[i], 1e-14));
}

TEST_CASE("Parameters in every form") {
  STATIC_CHECK(std::is_same_v<decltype(SinusoidalVibration{1, 50}), SinusoidalVibration<double>>);
  STATIC_CHECK(std::is_same_v<decltype(SinusoidalVibration{0.1F, 50}), SinusoidalVibration<float>>);
  CHECK(SinusoidalVibration{Eigen::Vector3d(1, 2, 3), 50}.amplitude[2] == 3);
  CHECK(SinusoidalVibration{1, Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)}.phase[1] == 5);
  CHECK(SinusoidalVibration{1, 50}.phase[2] == 0);
  static constexpr ErrorModel model{SinusoidalVibration{0.25, 120.0, PerAxis<double>(0, 0.25, 0.5)}};
  STATIC_CHECK(std::get<0>(model.terms()).frequency[0] == 120);
}

TEST_CASE("A vibration that is none is refused") {
  CHECK_THROWS_WITH((SinusoidalVibration{testing::nan<double>, 1}),
                    "SinusoidalVibration: amplitude is nan, expected a finite number");
  CHECK_THROWS_WITH((SinusoidalVibration{1, -1}),
                    "SinusoidalVibration: frequency is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH((SinusoidalVibration{1, testing::infinity<double>}),
                    "SinusoidalVibration: frequency is inf, expected a finite number >= 0");
  CHECK_THROWS_WITH((SinusoidalVibration{1, 1, testing::infinity<double>}),
                    "SinusoidalVibration: phase is inf, expected a finite number");
}

TEST_CASE("A vibration in words") {
  CHECK(describe(SinusoidalVibration{0.5, 120, PerAxis<double>(0, 0.25, 0.5)}, SensorKind::gyro) ==
        "sinusoidal vibration: amplitude 0.5 rad/s, frequency 120 Hz, phase (0 0.25 0.5) turns");
  CHECK(describe(SinusoidalVibration{0.5, 120}, SensorKind::accel) ==
        "sinusoidal vibration: amplitude 0.5 m/s^2, frequency 120 Hz, phase 0 turns");
}
