// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <splinertia/imu/presets.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <tuple>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// The parameters of a model's only term of a kind.
template <typename Term, typename Model>
constexpr const Term& term(const Model& model) {
  return std::get<Term>(model.terms());
}

// Worked out by hand from data sheets: 1° = 0.0174532925 rad, 1 g = 9.80665 m/s², 1 h = 3600 s, √h = 60 √s.
constexpr double degree = 0.017453292519943295, g = 9.80665;

template <typename Sensors>
void check_simulates(const Sensors& imu) {
  int samples = 0;
  double worst_gyro = 0;
  for (const auto& r : simulate(Ellipse<double>{}, imu, {.rate = 200, .seed = 7, .start = 0.0, .end = 5.0})) {
    REQUIRE((r.gyro.allFinite() && r.accel.allFinite() && r.gyro_bias.allFinite() && r.accel_bias.allFinite()));
    worst_gyro = std::max(worst_gyro, r.gyro.norm());
    ++samples;
  }
  CHECK(samples == 1001);
  CHECK(worst_gyro < 10);
}

}  // namespace

TEST_CASE("Presets are known while compiling") {
  constexpr auto density = term<WhiteNoise<double>>(presets::adis16448.gyro).density[0];
  STATIC_CHECK(density > 1.9e-4);
  STATIC_CHECK(density < 2.0e-4);
}

TEST_CASE("MPU-6050") {
  const auto& gyro = presets::mpu6050.gyro;
  const auto& accel = presets::mpu6050.accel;
  // 0.005 °/s/√Hz, one-sided: 0.005·0.0174533/1.414214; 400 µg/√Hz: 400e-6·9.80665/1.414214.
  CHECK_THAT(term<WhiteNoise<double>>(gyro).density[2], WithinRel(6.17067e-5, 1e-5));
  CHECK_THAT(term<WhiteNoise<double>>(accel).density[2], WithinRel(2.773740e-3, 1e-5));
  CHECK_THAT(term<TurnOnBias<double>>(gyro).standard_deviation[0], WithinRel(0.116355, 1e-5));        // 20 °/s / 3
  CHECK_THAT((term<TurnOnBias<double, 3>>(accel).standard_deviation[0]), WithinRel(0.163444, 1e-5));  // 50 mg / 3
  CHECK_THAT((term<TurnOnBias<double, 3>>(accel).standard_deviation[2]), WithinRel(0.261511, 1e-5));  // 80 mg / 3
  CHECK_THAT(term<Quantization<double>>(gyro).least_significant_bit[0], WithinRel(1.064225e-3, 1e-5));
  CHECK_THAT(term<Quantization<double>>(accel).least_significant_bit[0], WithinRel(4.788403e-3, 1e-5));
  CHECK_THAT(term<Saturation<double>>(gyro).limit[0], WithinRel(34.906585, 1e-7));
  CHECK_THAT(term<Saturation<double>>(accel).limit[0], WithinRel(156.9064, 1e-7));
  // Its data sheet's other figure: 0.05 °/s RMS in 100 Hz, that is within ±100 Hz.
  const double N = term<WhiteNoise<double>>(gyro).density[0];
  CHECK_THAT(N * std::sqrt(200.0), WithinRel(0.05 * degree, 1e-12));
  check_simulates(presets::mpu6050);
}

TEST_CASE("ADIS16448") {
  const auto& gyro = presets::adis16448.gyro;
  const auto& accel = presets::adis16448.accel;
  CHECK_THAT(term<TurnOnBias<double>>(gyro).standard_deviation[0], WithinRel(8.72665e-3, 1e-6));  // 0.5 °/s
  CHECK_THAT(term<WhiteNoise<double>>(gyro).density[0], WithinRel(1.919862e-4, 1e-6));            // 0.66 °/√h
  // 14.5 °/h = 7.029798e-5 rad/s is 0.6642825 B.
  CHECK_THAT(term<BiasInstability<double>>(gyro).coefficient[0], WithinRel(1.0582544e-4, 1e-6));
  CHECK_THAT(term<Quantization<double>>(gyro).least_significant_bit[0], WithinRel(6.981317e-4, 1e-6));
  CHECK_THAT(term<Saturation<double>>(gyro).limit[0], WithinRel(17.453293, 1e-7));
  CHECK_THAT(term<TurnOnBias<double>>(accel).standard_deviation[0], WithinRel(0.196133, 1e-6));  // 20 mg
  CHECK_THAT(term<WhiteNoise<double>>(accel).density[0], WithinRel(1.8333333e-3, 1e-6));         // 0.11 m/s/√h
  CHECK_THAT(term<Quantization<double>>(accel).least_significant_bit[0], WithinRel(8.1722083e-3, 1e-6));
  CHECK_THAT(term<Saturation<double>>(accel).limit[0], WithinRel(18 * g, 1e-12));
  check_simulates(presets::adis16448);
}

TEST_CASE("STIM300") {
  const auto& gyro = presets::stim300.gyro;
  const auto& accel = presets::stim300.accel;
  CHECK_THAT(term<TurnOnBias<double>>(gyro).standard_deviation[0], WithinRel(1.939255e-5, 1e-6));       // 4 °/h
  CHECK_THAT(term<WhiteNoise<double>>(gyro).density[0], WithinRel(4.363323e-5, 1e-6));                  // 0.15 °/√h
  CHECK_THAT(term<BiasInstability<double>>(gyro).coefficient[0], WithinRel(3.649153e-6, 1e-6));         // 0.5 °/h
  CHECK_THAT(term<Quantization<double>>(gyro).least_significant_bit[0], WithinRel(1.066590e-6, 1e-6));  // 0.22 °/h
  CHECK_THAT(term<Saturation<double>>(gyro).limit[0], WithinRel(400 * degree, 1e-12));
  CHECK_THAT(term<TurnOnBias<double>>(accel).standard_deviation[0], WithinRel(7.3549875e-3, 1e-6));  // 0.75 mg
  CHECK_THAT(term<WhiteNoise<double>>(accel).density[0], WithinRel(1e-3, 1e-12));                    // 0.06 m/s/√h
  CHECK_THAT(term<BiasInstability<double>>(accel).coefficient[0], WithinRel(7.381385e-4, 1e-6));     // 0.05 mg
  CHECK_THAT(term<Saturation<double>>(accel).limit[0], WithinRel(10 * g, 1e-12));
  check_simulates(presets::stim300);
}

TEST_CASE("Sets of noise without a data sheet") {
  const auto check = [](const auto& model, double N, double K) {
    CHECK(term<WhiteNoise<double>>(model).density[1] == N);
    CHECK(term<RandomWalk<double>>(model).density[1] == K);
  };
  check(presets::euroc.gyro, 1.6968e-4, 1.9393e-5);
  check(presets::euroc.accel, 2e-3, 3e-3);
  check(presets::course.gyro, 0.015, 5e-5);
  check(presets::course.accel, 0.019, 5e-4);
  check(presets::course_quiet.gyro, 0.005, 1e-5);
  check(presets::course_quiet.accel, 3e-4, 1e-4);
  check_simulates(presets::euroc);
  check_simulates(presets::course);
  check_simulates(presets::course_quiet);
}
