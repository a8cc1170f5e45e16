// SPDX-License-Identifier: MIT
// Any bytes as an estimator's file of IMU noise. What is read is written for all estimators and read again.
#include "support/imu_noise.hpp"

#include <cmath>
#include <splinertia/io/number_text.hpp>
#include <string>

#include "fuzz/files.hpp"

namespace splinertia::fuzz::imu_noise_target {

using namespace splinertia::detail;

void expect_near(double value, double expected) {
  expect(std::abs(value - expected) <= 1e-14 * std::abs(expected), "read ", value, ", wrote ", expected);
}

/// The square of it, or its product with a rate, is a usual number, too.
bool is_usual(double value) { return value > 1e-100 && value < 1e100; }

void expect_round_trip(const ::ImuNoise& noise, Estimator estimator) {
  static InputBytes file("copy.yaml");
  const std::string& path = file.with(imu_noise_text(estimator, noise, {noise.topic}));
  const ::ImuNoise again = read_imu_noise(path, noise.update_rate);
  expect_near(again.gyro_noise_density, noise.gyro_noise_density);
  expect_near(again.gyro_random_walk, noise.gyro_random_walk);
  expect_near(again.accel_noise_density, noise.accel_noise_density);
  expect_near(again.accel_random_walk, noise.accel_random_walk);
  expect_near(again.update_rate, noise.update_rate);
}

const Target target{
    "imu_noise", [](Input input) {
      static InputBytes file("imu.yaml");
      ::ImuNoise noise;
      const bool has_rate = input.flag();
      const double rate = 2 + input.moderate(1);
      const std::string& path = file.with(input.rest());
      if (!accepted(path, [&] { noise = read_imu_noise(path, has_rate ? std::optional(rate) : std::nullopt); })) {
        return;
      }
      bool usual = true;
      for (const double value : {noise.gyro_noise_density, noise.gyro_random_walk, noise.accel_noise_density,
                                 noise.accel_random_walk, noise.update_rate}) {
        expect(value > 0 && has_finite_bits(value), "read ", value);
        usual = usual && is_usual(value);
      }
      for (const auto& matrix : {noise.gyro_misalignment, noise.accel_misalignment, noise.g_sensitivity}) {
        expect(!matrix || matrix->allFinite(), "an intrinsic that is not finite");
      }
      if (!usual) return;
      for (const Estimator estimator : estimators) expect_round_trip(noise, estimator);
      (void)accepted("", [&] { (void)imu_noise_of(errors_of(noise), noise.update_rate); });
    }};

}  // namespace splinertia::fuzz::imu_noise_target
