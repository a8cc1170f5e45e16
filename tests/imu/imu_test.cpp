// SPDX-License-Identifier: MIT
#include <chrono>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/errors/size_effect.hpp>
#include <splinertia/imu/imu.hpp>
#include <type_traits>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

/// A term with a parameter of that name.
struct OfASensor {
  struct State {};
  int sensor = 1;

  void apply(SensorSample<double>&, State&) const {}
};

}  // namespace

TEST_CASE("What an IMU has no errors of takes no room") {
  STATIC_CHECK(std::is_empty_v<Imu<>>);
  using Gyro = ErrorModel<WhiteNoise<double>>;
  STATIC_CHECK(sizeof(Imu<Gyro, Gyro>) == 2 * sizeof(WhiteNoise<double>));
}

TEST_CASE("An IMU is put together from two models, or three") {
  static constexpr Imu ideal{};
  STATIC_CHECK(std::is_same_v<decltype(ideal), const Imu<>>);
  static constexpr Imu two{ErrorModel{WhiteNoise{0.1}}, ErrorModel{}};
  STATIC_CHECK(std::is_same_v<decltype(two.stamps), ErrorModel<>>);
  STATIC_CHECK(std::get<0>(two.gyro.terms()).density[0] == 0.1);
  static constexpr Imu three{ErrorModel{}, ErrorModel{ConstantBias{1}}, ErrorModel{ClockOffset{0.25}}};
  STATIC_CHECK(std::get<0>(three.accel.terms()).bias[2] == 1);
  STATIC_CHECK(std::get<0>(three.stamps.terms()).offset == 0.25);
}

TEST_CASE("Terms for one kind of sensor are in its model only, all others in any") {
  const Imu imu{ErrorModel{GSensitivity{Eigen::Matrix3d::Zero()}, OfASensor{}, WhiteNoise{0.1}},
                ErrorModel{SizeEffect{Eigen::Matrix3d::Zero()}, OfASensor{}, WhiteNoise{0.1}}};
  using Gyro = decltype(imu.gyro);
  using Accel = decltype(imu.accel);
  STATIC_CHECK(detail::is_for<Gyro, SensorKind::gyro>);
  STATIC_CHECK(detail::is_for<Accel, SensorKind::accel>);
  STATIC_CHECK_FALSE(detail::is_for<Gyro, SensorKind::accel>);
  STATIC_CHECK_FALSE(detail::is_for<Accel, SensorKind::gyro>);
  STATIC_CHECK(detail::is_for<ErrorModel<>, SensorKind::accel>);
}

TEST_CASE("Readings are plain values, which tell the true time where it differs") {
  using Stamped = StampedImuReading<float, std::chrono::nanoseconds>;
  STATIC_CHECK(std::is_base_of_v<BasicImuReading<float, std::chrono::nanoseconds>, Stamped>);
  STATIC_CHECK(std::is_copy_assignable_v<Stamped>);
  const auto has_true_time = []<typename R>(const R&) { return requires(R r) { r.true_time; }; };
  CHECK(has_true_time(Stamped{}));
  CHECK_FALSE(has_true_time(ImuReading{}));
}
