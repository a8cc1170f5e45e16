// SPDX-License-Identifier: MIT
#include <numbers>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegration_residual.hpp>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename Scalar>
struct Pair {
  NavState<Scalar> i, j;
  ImuBias<Scalar> bias_i, bias_j;

  template <typename To>
  Pair<To> cast() const {
    const auto state = [](const NavState<Scalar>& s) -> NavState<To> {
      return {s.R_WB.template cast<To>(), s.v_WB.template cast<To>(), s.p_WB.template cast<To>(), s.time};
    };
    const auto bias = [](const ImuBias<Scalar>& b) -> ImuBias<To> {
      return {b.gyro.template cast<To>(), b.accel.template cast<To>()};
    };
    return {state(i), state(j), bias(bias_i), bias(bias_j)};
  }
  /// Moved by right perturbations of both states and biases, in the order of the Jacobians.
  Pair moved(const Eigen::Matrix<Scalar, 30, 1>& d) const {
    const auto state = [&](const NavState<Scalar>& s, int at) -> NavState<Scalar> {
      return {s.R_WB * GroupTraits<Sophus::SO3<Scalar>>::exp(d.template segment<3>(at)),
              s.v_WB + d.template segment<3>(at + 3), s.p_WB + d.template segment<3>(at + 6), s.time};
    };
    const auto bias = [&](const ImuBias<Scalar>& b, int at) -> ImuBias<Scalar> {
      return {b.gyro + d.template segment<3>(at), b.accel + d.template segment<3>(at + 3)};
    };
    return {state(i, 0), state(j, 15), bias(bias_i, 9), bias(bias_j, 24)};
  }
};

const Eigen::Vector3d gravity(0.3, -0.2, -9.8);

template <typename Scalar>
auto measured() {
  const ImuBias<Scalar> bias{{Scalar(0.01F), Scalar(0.02F), Scalar(-0.03F)}, {Scalar(0.1F), Scalar(0), Scalar(0.2F)}};
  return testing::preintegrate<Midpoint, Scalar>(2.0, testing::some_samples<Midpoint, Scalar>(30), bias);
}

template <typename Scalar>
auto residual(const Pair<Scalar>& pair) {
  return preintegration_residual(measured<Scalar>(), pair.i, pair.bias_i, pair.j, pair.bias_j,
                                 Eigen::Vector3<Scalar>(gravity.cast<Scalar>()));
}

/// States that would fit what is measured, but for an attitude that is off by `angle` and other differences up to 1.
Pair<double> some_pair(double angle, testing::Random& random) {
  const auto imu = measured<double>();
  const auto some = [&](double size) -> Eigen::Vector3d { return random.tangent<Eigen::Vector3d>(size); };
  Pair<double> pair;
  pair.i = {random.walk<Sophus::SO3d>(1)[0], some(2), some(5), 2.0};
  pair.bias_i = {imu.bias().gyro + some(0.3), imu.bias().accel + some(0.3)};
  pair.bias_j = {imu.bias().gyro + some(0.3), imu.bias().accel + some(0.3)};
  const auto delta = imu.corrected(pair.bias_i);
  pair.j = InertialFrame{}.advance(pair.i, delta, gravity, 2.0 + delta.interval);
  pair.j.R_WB *= GroupTraits<Sophus::SO3d>::exp(angle * some(1).normalized());
  pair.j.v_WB += some(1);
  pair.j.p_WB += some(1);
  return pair;
}

}  // namespace

TEMPLATE_TEST_CASE("States that the same scheme integrates leave no residual", "", float, double) {
  using Scalar = TestType;
  const auto check = [&]<typename Scheme>() {
    const auto samples = testing::some_samples<Scheme, Scalar>(100);
    testing::Random random(1);
    const NavState<Scalar> i{random.walk<Sophus::SO3<Scalar>>(1)[0],
                             {Scalar(1), Scalar(2), Scalar(3)},
                             {Scalar(-4), Scalar(5), Scalar(6)},
                             2.0};
    const Eigen::Vector3<Scalar> g = gravity.cast<Scalar>();
    const auto j = integrate<Scheme>(i, samples, g).back();
    const auto imu = testing::preintegrate<Scheme, Scalar>(2.0, samples);
    // Sums of a hundred steps, of size 10.
    CHECK(preintegration_residual(imu, i, {}, j, {}, g).cwiseAbs().maxCoeff() <= 100 * 10 * testing::eps<Scalar>);
  };
  check.template operator()<ZeroOrderHold>();
  check.template operator()<Euler>();
  check.template operator()<Midpoint>();
  check.template operator()<Trapezoid>();
  check.template operator()<Magnus4>();
  check.template operator()<RotationCorrectedIncrements>();
  check.template operator()<TwoSampleIncrements>();
}

TEMPLATE_TEST_CASE("The residual's Jacobians are right, also for large rotations", "", float, double) {
  using Real = long double;
  testing::Random random(2);
  for (const double angle : {0.0, 1e-8, 1e-3, 1.0, 2.0, 3.0, std::numbers::pi - 1e-2}) {
    INFO("attitude off by " << angle);
    // In all types the same.
    const Pair<TestType> pair = some_pair(angle, random).template cast<TestType>();
    const Pair<Real> exact = pair.template cast<Real>();
    const Eigen::Matrix<Real, 15, 30> numeric = testing::central_differences<15, 30, Real>(
        [&](const Eigen::Matrix<Real, 30, 1>& d) { return residual(exact.moved(d)); }, Real(1e-3L));
    const auto l = linearize_preintegration_residual(measured<TestType>(), pair.i, pair.bias_i, pair.j, pair.bias_j,
                                                     Eigen::Vector3<TestType>(gravity.cast<TestType>()));
    Eigen::Matrix<TestType, 15, 30> J;
    J << l.state_i, l.bias_i, l.state_j, l.bias_j;
    const Eigen::Matrix<Real, 15, 30> error = J.template cast<Real>() - numeric;
    // Entries up to 5, of what 30 steps have made; differences of large rotations err by 1e-15.
    CHECK(error.cwiseAbs().maxCoeff() <= std::max(Real(1e-12L), 30 * 5 * Real(testing::eps<TestType>)));
    CHECK(l.value == preintegration_residual(measured<TestType>(), pair.i, pair.bias_i, pair.j, pair.bias_j,
                                             Eigen::Vector3<TestType>(gravity.cast<TestType>())));
  }
}

TEST_CASE("The residual is in the axes of the body at the beginning, and has the order that is said") {
  const PreintegratedImu<double> imu = [] {
    PreintegratedImu<double> result;
    result.append(linearize_increment(StepMean<double>{{0, 0, 0}, {0, 0, 0}, 1}));  // nothing for a second
    return result;
  }();
  const NavState<double> i{GroupTraits<Sophus::SO3d>::exp({0, 0, std::numbers::pi / 2}), {0, 0, 0}, {0, 0, 0}, 0};
  NavState<double> j = i;
  j.R_WB *= GroupTraits<Sophus::SO3d>::exp({0.1, 0.2, 0.3});
  j.v_WB = {0, 1, 0};  // north, where the body's x axis points
  j.p_WB = {-2, 0, 0};
  const auto r = preintegration_residual(imu, i, {}, j, {{1, 2, 3}, {4, 5, 6}}, Eigen::Vector3d::Zero().eval());
  Eigen::Matrix<double, 15, 1> expected;
  expected << 0.1, 0.2, 0.3, 1, 0, 0, 0, 2, 0, 1, 2, 3, 4, 5, 6;
  CHECK((r - expected).cwiseAbs().maxCoeff() < 1e-15);
}
