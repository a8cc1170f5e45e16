// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <splinertia/strapdown/preintegration/detail/imu_covariance.hpp>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename Scalar>
const ImuNoise<Scalar> some_noise{Scalar(0.01F), Scalar(0.1F), Scalar(0.02F), Scalar(0.3F)};

constexpr std::size_t steps = 8;

/// Held rates and forces, and what noise adds to them: 12 numbers a step, the white noise of both sensors, and what
/// both biases walk in it.
using Noises = Eigen::Matrix<double, 12 * steps, 1>;

/// The motion, and what the biases have walked, of a body that makes what it is measured to make with other noise.
Eigen::Matrix<double, 15, 1> residual(const NavIncrement<double>& measured, const Noises& noises) {
  const auto samples = testing::some_samples<ZeroOrderHold, double>(steps);
  const ImuNoise<double>& density = some_noise<double>;
  PreintegratedImu<double> truth;
  Eigen::Vector3d gyro_walk = Eigen::Vector3d::Zero(), accel_walk = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < steps; ++i) {
    const Eigen::Matrix<double, 12, 1> n = noises.segment<12>(static_cast<Eigen::Index>(12 * i));
    const double h = samples[i + 1].time - samples[i].time, root = std::sqrt(h);
    const Eigen::Vector3d gyro = samples[i].gyro - gyro_walk - density.gyro_density / root * n.segment<3>(0);
    const Eigen::Vector3d accel = samples[i].accel - accel_walk - density.accel_density / root * n.segment<3>(3);
    truth.append(linearize_increment(StepMean<double>{gyro * h, accel * h, h}));
    gyro_walk += density.gyro_walk * root * n.segment<3>(6);
    accel_walk += density.accel_walk * root * n.segment<3>(9);
  }
  Eigen::Matrix<double, 15, 1> r;
  r << testing::difference(measured, truth.delta()), gyro_walk, accel_walk;
  return r;
}

template <typename Scheme, typename Scalar>
auto preintegrated(const ImuNoise<Scalar>& noise, std::size_t intervals = steps) {
  return testing::preintegrate<Scheme, Scalar>(2.0, testing::some_samples<Scheme, Scalar>(intervals), {}, noise);
}

}  // namespace

TEMPLATE_TEST_CASE("The covariance is the sum over all noise of the squares of what it does", "", float, double) {
  const auto imu = preintegrated<ZeroOrderHold, double>(some_noise<double>);
  const auto J = testing::central_differences<15, 12 * steps, double>(
      [&](const Noises& n) { return residual(imu.delta(), n); }, 1e-2);  // errors of (0.01 N)⁶ and 1e-16/0.01
  const Eigen::Matrix<double, 15, 15> expected = J * J.transpose();
  const Eigen::Matrix<double, 15, 15> P =
      preintegrated<ZeroOrderHold, TestType>(some_noise<TestType>).covariance().matrix().template cast<double>();
  // Each entry beside the variances of its row and column.
  const Eigen::Matrix<double, 15, 1> scale = expected.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 15, 15> error = scale.asDiagonal() * (P - expected) * scale.asDiagonal();
  CHECK(error.cwiseAbs().maxCoeff() <= std::max(1e-10, 8.0 * steps * testing::eps<TestType>));
}

TEST_CASE("A step's covariance is its densities over its interval") {
  const double h = 0.25;
  const auto step = linearize_increment(StepMean<double>{{0, 0, 0}, {0, 0, 0}, h});
  const auto P = ImuCovariance<double>(step, ImuNoise<double>{2, 3, 5, 7}).matrix();
  Eigen::Matrix<double, 15, 15> expected = Eigen::Matrix<double, 15, 15>::Zero();
  const auto set = [&](int i, int j, double value) {
    expected.block<3, 3>(i, j) = value * Eigen::Matrix3d::Identity();
    expected.block<3, 3>(j, i) = expected.block<3, 3>(i, j);
  };
  set(0, 0, 4 * h);              // N² h
  set(3, 3, 9 * h);              // N² h
  set(6, 6, 9 * h * h * h / 4);  // a force held over the step
  set(3, 6, 9 * h * h / 2);
  set(9, 9, 25 * h);  // K² h
  set(12, 12, 49 * h);
  CHECK(testing::largest_difference(P, expected) == 0);
}

TEST_CASE("At rest the covariance grows as that of random walks") {
  // At n steps of h: attitude N²t, velocity along the force N²t + K²t³/3, position along it N²t³/3 + K²t⁵/20.
  constexpr int n = 2000;
  const double h = 1e-3, t = n * h;
  const ImuNoise<double> noise{0.01, 0.1, 0.02, 0.3};
  PreintegratedImu<double, ImuCovariance<double>> imu;
  const auto step = linearize_increment(StepMean<double>{{0, 0, 0}, {0, 0, 9.8 * h}, h});
  for (int i = 0; i < n; ++i) imu.append(step, {step, noise});
  const auto P = imu.covariance().matrix();
  const auto square = [](double x) { return x * x; };
  const double N = square(0.1), K = square(0.3), tilt = square(0.01), drift = square(0.02);
  const double relative = 4.0 / n;  // sums instead of integrals
  CHECK_THAT(P(2, 2), WithinRel(tilt * t + drift * t * t * t / 3, relative));
  CHECK_THAT(P(5, 5), WithinRel(N * t + K * t * t * t / 3, relative));
  CHECK_THAT(P(8, 8), WithinRel(N * t * t * t / 3 + K * std::pow(t, 5) / 20, relative));
  // Across it the tilt adds its own: velocity (9.8)² (N²t³/3 + K²t⁵/20).
  CHECK_THAT(
      P(3, 3),
      WithinRel(N * t + K * t * t * t / 3 + 96.04 * (tilt * t * t * t / 3 + drift * std::pow(t, 5) / 20), relative));
  // What the biases have walked goes with the velocity: −K²t²/2 of a bias that is taken off.
  CHECK_THAT(P(5, 14), WithinRel(-K * t * t / 2, relative));
  CHECK_THAT(P(14, 14), WithinRel(K * t, 1e-12));
}

TEMPLATE_TEST_CASE("A covariance is symmetric and has no negative variance", "", ZeroOrderHold, Euler, Midpoint,
                   Trapezoid, Magnus4, RotationCorrectedIncrements, TwoSampleIncrements) {
  for (const std::size_t intervals : {4U, 5U, 50U, 500U}) {
    const auto P = preintegrated<TestType, double>(some_noise<double>, intervals).covariance().matrix();
    CHECK(P == P.transpose());
    const Eigen::Matrix<double, 15, 1> scale = P.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 15, 15>> solver(scale.asDiagonal() * P *
                                                                              scale.asDiagonal());
    CHECK(solver.eigenvalues().minCoeff() > 1e-8);
  }
}

TEST_CASE("No noise, no covariance") {
  CHECK(preintegrated<Midpoint, double>(ImuNoise<double>{0, 0, 0, 0}).covariance().matrix().isZero(0));
  CHECK(preintegrated<Midpoint, double>(ImuNoise<double>{}).covariance().matrix().isZero(0));
}

template class splinertia::detail::ImuCovariance<float>;
template class splinertia::detail::ImuCovariance<double>;
template class splinertia::detail::ImuCovariance<long double>;
