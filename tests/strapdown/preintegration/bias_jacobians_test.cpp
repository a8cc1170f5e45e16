// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/preintegration/bias_jacobians.hpp>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

const ImuBias<double> some_bias{{0.01, -0.02, 0.03}, {0.1, 0.2, -0.15}};

template <typename T>
ImuBias<T> cast(const ImuBias<double>& bias) {
  return {bias.gyro.cast<T>(), bias.accel.cast<T>()};
}

/// A second, with up to 3 rad/s.
template <typename Scheme, typename T>
auto preintegrated(const Eigen::Matrix<T, 6, 1>& d) {
  return testing::preintegrate<Scheme, T>(2.0, testing::some_samples<Scheme, T>(100),
                                          testing::moved(cast<T>(some_bias), d));
}

template <typename Scheme, typename Scalar>
void check_jacobians() {
  using Real = long double;
  const auto exact = preintegrated<Scheme, Real>(Eigen::Matrix<Real, 6, 1>::Zero());
  const Eigen::Matrix<Real, 9, 6> numeric = testing::central_differences<9, 6, Real>(
      [&](const Eigen::Matrix<Real, 6, 1>& d) {
        return testing::difference(exact.delta(), preintegrated<Scheme, Real>(d).delta());
      },
      Real(1e-3L));  // errors of 10 h⁶ = 1e-17 and eps·10/h = 1e-15
  const auto analytic = preintegrated<Scheme, Scalar>(Eigen::Matrix<Scalar, 6, 1>::Zero());
  const Eigen::Matrix<Real, 9, 6> J = testing::as_matrix(analytic.jacobians()).template cast<Real>();
  // Of size 10; a hundred steps, each with its rounding.
  CHECK(testing::largest_difference(J, numeric) <= 10 * 100 * Real(testing::eps<Scalar>));
}

/// log₂ of how an error falls when the step of the bias is halved, from the smallest of a ladder of steps on.
template <typename Scheme>
std::array<double, 3> orders_of_correction() {
  using Real = long double;
  Eigen::Matrix<Real, 6, 1> direction;
  direction << 0.1L, -0.2L, 0.15L, 0.3L, 0.5L, -0.4L;
  const auto first = preintegrated<Scheme, Real>(Eigen::Matrix<Real, 6, 1>::Zero());
  const auto errors = [&](Real step) {
    const auto again = preintegrated<Scheme, Real>(step * direction);
    const auto d = testing::difference(again.delta(), first.corrected(again.bias()));
    return std::array<Real, 3>{d.template head<3>().norm(), d.template segment<3>(3).norm(),
                               d.template tail<3>().norm()};
  };
  std::array<double, 3> orders{};
  const auto coarse = errors(0.02L), fine = errors(0.01L);
  for (std::size_t i = 0; i < 3; ++i) orders[i] = static_cast<double>(std::log2(coarse[i] / fine[i]));
  return orders;
}

}  // namespace

TEST_CASE("There is no bias, and nothing depends on one, unless it is said") {
  const ImuBias<double> bias;
  CHECK(bias.gyro.isZero(0));
  CHECK(bias.accel.isZero(0));
  CHECK(testing::as_matrix(BiasJacobians<double>{}).isZero(0));
}

TEMPLATE_TEST_CASE("The derivatives of a preintegrated motion by its biases are right", "", float, double) {
  check_jacobians<ZeroOrderHold, TestType>();
  check_jacobians<Euler, TestType>();
  check_jacobians<Midpoint, TestType>();
  check_jacobians<Trapezoid, TestType>();
  check_jacobians<Magnus4, TestType>();
  check_jacobians<RotationCorrectedIncrements, TestType>();
  check_jacobians<TwoSampleIncrements, TestType>();
}

TEMPLATE_TEST_CASE("A motion corrected for a bias is that integrated with it, to second order", "", ZeroOrderHold,
                   Euler, Midpoint, Trapezoid, Magnus4, RotationCorrectedIncrements, TwoSampleIncrements) {
  for (const double order : orders_of_correction<TestType>()) CHECK_THAT(order, WithinAbs(2, 0.1));
}
