// SPDX-License-Identifier: MIT
#include <chrono>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/detail/imu_covariance.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

template class splinertia::Preintegrator<ZeroOrderHold, float>;
template class splinertia::Preintegrator<Euler, long double, nanoseconds>;
template class splinertia::Preintegrator<Midpoint, double, double, ImuNoise<double>>;
template class splinertia::Preintegrator<Trapezoid, double>;
template class splinertia::Preintegrator<Magnus4, double, nanoseconds, ImuNoise<double>>;
template class splinertia::Preintegrator<RotationCorrectedIncrements, double>;
template class splinertia::Preintegrator<TwoSampleIncrements, float, double, ImuNoise<float>>;

namespace {

using Sample = ImuSample<>;
Sample at(double t) { return {t, {0, 0, 0}, {0, 0, 9.8}}; }

template <typename Scheme>
concept HasPreintegrator = requires { typename Preintegrator<Scheme, double>; };

}  // namespace

TEMPLATE_TEST_CASE("Preintegration is what integration of the same samples does without gravity", "", ZeroOrderHold,
                   Euler, Midpoint, Trapezoid, Magnus4, RotationCorrectedIncrements, TwoSampleIncrements) {
  for (const std::size_t intervals : {3U, 4U, 7U, 100U}) {
    auto samples = testing::some_samples<TestType, double>(intervals);
    const ImuBias<double> bias{{0.1, 0.2, -0.3}, {0.5, -0.5, 1}};
    const auto imu = testing::preintegrate<TestType, double>(2.0, samples, bias);
    double before = 2;
    for (auto& sample : samples) {
      if constexpr (TestType::takes_increments) {
        const double h = sample.time - before;
        sample.delta_angle -= bias.gyro * h;
        sample.delta_velocity -= bias.accel * h;
        before = sample.time;
      } else {
        sample.gyro -= bias.gyro;
        sample.accel -= bias.accel;
      }
    }
    const NavState<double> origin{{}, {0, 0, 0}, {0, 0, 0}, 2.0};
    const auto state = integrate<TestType>(origin, samples, Eigen::Vector3d::Zero()).back();
    const double rounding = 8 * static_cast<double>(intervals) * testing::eps<double>;
    CHECK(rotation_increment<double>(state.R_WB.unit_quaternion(), imu.delta().rotation).norm() <= rounding);
    CHECK((state.v_WB - imu.delta().velocity).norm() <= rounding * 10);
    CHECK((state.p_WB - imu.delta().position).norm() <= rounding * 10);
    CHECK_THAT(imu.delta().interval, WithinAbs(state.time - 2.0, rounding));
  }
}

TEST_CASE("The noise changes nothing but the covariance") {
  const auto samples = testing::some_samples<Midpoint, double>(50);
  const auto with = testing::preintegrate<Midpoint, double>(2.0, samples, {}, ImuNoise<double>{1, 2, 3, 4});
  const auto without = testing::preintegrate<Midpoint, double>(2.0, samples);
  CHECK(testing::difference(with.delta(), without.delta()).isZero(0));
  CHECK(testing::as_matrix(with.jacobians()) == testing::as_matrix(without.jacobians()));
  STATIC_CHECK(std::is_same_v<decltype(without), const PreintegratedImu<double, NoCovariance>>);
}

TEST_CASE("The result follows the samples, as far as the scheme can see") {
  Preintegrator<Midpoint, double> midpoint(0.0);
  CHECK(midpoint.result().delta().interval == 0);
  midpoint.push(at(0));
  CHECK(midpoint.result().delta().interval == 0);
  midpoint.push(at(0.5));
  CHECK(midpoint.result().delta().interval == 0.5);
  Preintegrator<Magnus4, double> magnus4(0.0);
  for (int i = 0; i < 4; ++i) magnus4.push(at(0.5 * i));
  CHECK(magnus4.result().delta().interval == 1);  // the last step waits for a sample after it
  magnus4.finish();
  CHECK(magnus4.result().delta().interval == 1.5);
}

TEST_CASE("Epoch stamps lose nothing") {
  constexpr nanoseconds start(1'700'000'000'000'000'123);
  Preintegrator<Midpoint, double, nanoseconds> imu(start);
  struct Stamped {
    nanoseconds time;
    Eigen::Vector3d gyro, accel;
  };
  for (int i = 0; i <= 1000; ++i) imu.push(Stamped{start + nanoseconds(i * 5'000'001LL), {0, 0, 1}, {1, 0, 0}});
  CHECK_THAT(imu.result().delta().interval, WithinAbs(5.000001, 1e-13));
  const auto turn = rotation_log(imu.result().delta().rotation);
  CHECK_THAT(turn.z(), WithinAbs(5.000001 - 2 * 3.14159265358979324, 1e-13));
}

TEST_CASE("A copy goes its own way") {
  Preintegrator<Midpoint, double> one(0.0);
  one.push(at(0));
  one.push(at(1));
  auto other = one;
  other.push(at(2));
  CHECK(one.result().delta().interval == 1);
  CHECK(other.result().delta().interval == 2);
}

TEST_CASE("Samples that do not follow each other are refused, and change nothing") {
  Preintegrator<Midpoint, double> imu(1.0, {}, {}, {.longest = 0.75});
  CHECK_THROWS_AS(imu.push(at(2)), std::invalid_argument);  // not at the start
  imu.push(at(1));
  imu.push(at(1.5));
  const auto before = imu.result().delta();
  CHECK_THROWS_WITH(imu.push(at(1.5)), "preintegrate: sample 2 is at 1.5, expected a time after 1.5");
  CHECK_THROWS_AS(imu.push(at(1.2)), std::invalid_argument);
  CHECK_THROWS_AS(imu.push(at(std::numeric_limits<double>::quiet_NaN())), std::invalid_argument);
  CHECK_THROWS_AS(imu.push(at(std::numeric_limits<double>::infinity())), std::invalid_argument);
  CHECK_THROWS_AS(imu.push(at(2.5)), std::invalid_argument);  // a gap
  CHECK(testing::difference(before, imu.result().delta()).isZero(0));
  imu.push(at(2));
  CHECK(imu.result().delta().interval == 1);
  CHECK(imu.gaps() == 0);
}

TEST_CASE("Gaps are bridged where that is wanted") {
  Preintegrator<Midpoint, double> imu(1.0, {}, {}, {.longest = 0.75, .policy = GapPolicy::bridge});
  for (const double t : {1.0, 1.5, 3.0, 3.5}) imu.push(at(t));
  CHECK(imu.gaps() == 1);
  CHECK(imu.result().delta().interval == 2.5);
}

TEST_CASE("No samples are no motion, two are enough") {
  Preintegrator<Magnus4, double> imu(0.0);
  imu.finish();
  CHECK(imu.result().delta().interval == 0);
  for (const double t : {0.0, 1.0}) imu.push(at(t));
  imu.finish();
  CHECK(imu.result().delta().interval == 1);
}

TEST_CASE("Readings and biases that are not finite are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Preintegrator<Midpoint, double> imu(0.0, {{1, 2, 3}, {4, 5, 6}});
  imu.push(at(0));
  CHECK_THROWS_WITH(imu.push(Sample{0.5, {0, nan, 0}, {0, 0, 0}}),
                    "preintegrate: sample 1 at 0.5 has gyro[1] = nan, expected a finite number");
  imu.push(at(1));
  CHECK(imu.result().delta().interval == 1);
  using Biased = Preintegrator<Midpoint, double>;
  CHECK_THROWS_WITH(Biased(0.0, {{1, 2, nan}, {4, 5, 6}}),
                    "preintegrate: the gyroscope's bias[2] is nan, expected a finite number");
  CHECK_THROWS_WITH(Biased(nan), "preintegrate: the initial time is nan, expected a finite number");
  using Noisy = Preintegrator<Midpoint, double, double, ImuNoise<double>>;
  CHECK_THROWS_WITH(Noisy(0.0, {}, {nan, 1, 1, 1}),
                    "preintegrate: the gyroscope's noise density is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(Noisy(0.0, {}, {1, 1, 1, -1}),
                    "preintegrate: the random walk of the accelerometer's bias is -1, expected a finite number >= 0");
  CHECK_NOTHROW(Noisy(0.0, {}, {1, 0, 0, 0}));
}

TEST_CASE("Increments begin at the start, and are refused at it") {
  using Increment = ImuIncrement<>;
  Preintegrator<RotationCorrectedIncrements, double> imu(1.0, {{0, 0, 1}, {0, 0, 0}});
  CHECK_THROWS_AS(imu.push(Increment{1.0, {0, 0, 0}, {0, 0, 0}}), std::invalid_argument);
  imu.push(Increment{1.5, {0, 0, 0.5}, {0, 0, 0}});  // all of it bias
  CHECK(imu.result().delta().interval == 0.5);
  CHECK(imu.result().delta().rotation.vec().isZero(0));
}

TEST_CASE("What cannot be preintegrated does not compile") {
  STATIC_CHECK(HasPreintegrator<Midpoint>);
  STATIC_CHECK_FALSE(HasPreintegrator<RungeKutta4>);  // has no derivatives
  STATIC_CHECK_FALSE(HasPreintegrator<UncorrectedIncrements>);
}
