// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/turn_on_bias.hpp>
#include <splinertia/errors/noise/correlated_noise.hpp>
#include <splinertia/errors/noise/gauss_markov.hpp>
#include <splinertia/imu/imu_noise.hpp>
#include <splinertia/imu/presets.hpp>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

/// Somebody else's term, which has a name and a density, too.
struct OtherNoise {
  static constexpr std::string_view name = "white noise";
  template <typename Normals>
  using State = Normals;

  PerAxis<double, 1> density{7.0};

  void apply(SensorSample<double>&, auto&) const {}
};

}  // namespace

TEST_CASE("The noise of an IMU is that of its white noise and random walks") {
  const ImuNoise noise = imu_noise(presets::euroc);
  CHECK(noise.gyro_density == Approx(1.6968e-4).epsilon(1e-15));
  CHECK(noise.accel_density == Approx(2.0e-3).epsilon(1e-15));
  CHECK(noise.gyro_walk == Approx(1.9393e-5).epsilon(1e-15));
  CHECK(noise.accel_walk == Approx(3.0e-3).epsilon(1e-15));
}

TEST_CASE("Terms of a kind add up as squares, the noisiest axis counts, other terms do not") {
  const Imu imu{ErrorModel{WhiteNoise{3e-3}, TurnOnBias{1.0}, WhiteNoise{4e-3}, GaussMarkov{0.1, 10}},
                ErrorModel{WhiteNoise{PerAxis<double>(1, 3, 2)}, RandomWalk{0.5}}};
  const ImuNoise noise = imu_noise(imu);
  CHECK(noise.gyro_density == Approx(5e-3).epsilon(1e-15));
  CHECK(noise.gyro_walk == 0);
  CHECK(noise.accel_density == 3);
  CHECK(noise.accel_walk == 0.5);
  CHECK(imu_noise<float>(imu).accel_density == 3.0F);
  CHECK(imu_noise(Imu{}).accel_density == 0);
  CHECK(imu_noise(Imu{ErrorModel{OtherNoise{}}, ErrorModel{}}).gyro_density == 0);
}

TEST_CASE("Noise that is correlated between axes is white noise, too") {
  const Eigen::Matrix3d R{{1, 0.5, -0.25}, {0.5, 1, 0}, {-0.25, 0, 1}};
  const Imu imu{ErrorModel{CorrelatedNoise{3e-3, R}, WhiteNoise{4e-3}},
                ErrorModel{CorrelatedNoise{PerAxis<double>(1, 3, 2), R}, RandomWalk{0.5}}};
  const ImuNoise noise = imu_noise(imu);
  CHECK(noise.gyro_density == Approx(5e-3).epsilon(1e-15));
  CHECK(noise.accel_density == 3);
  CHECK(noise.gyro_walk == 0);
  CHECK(noise.accel_walk == 0.5);
}

TEST_CASE("Densities whose squares underflow or overflow count, and one term has its own density to the bit") {
  for (const double unit : {1e-320, 1e-170, 1.0, 0.1, 1e102}) {
    CHECK(imu_noise(Imu{ErrorModel{WhiteNoise{unit}}, ErrorModel{}}).gyro_density == unit);
    const ImuNoise two = imu_noise(Imu{ErrorModel{}, ErrorModel{RandomWalk{3 * unit}, RandomWalk{4 * unit}}});
    CHECK(two.accel_walk == Approx(5 * unit).epsilon(1e-3).margin(0));
  }
  CHECK(imu_noise<float>(Imu{ErrorModel{WhiteNoise{1e-30F}}, ErrorModel{}}).gyro_density == 1e-30F);
}
