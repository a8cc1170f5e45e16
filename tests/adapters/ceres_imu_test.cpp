// SPDX-License-Identifier: MIT
#include <splinertia/adapters/ceres_imu.hpp>
#include <splinertia/imu/ideal_imu.hpp>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename T>
Eigen::Vector3<T> vector_at(const T* block) {
  return {block[0], block[1], block[2]};
}

template <LieGroup G, int Order>
struct GyroscopeFunctor {
  CumulativeBasis<double, Order, 1> basis;
  Eigen::Vector3d measured;
  Eigen::Matrix3d weight;

  template <typename T>
  bool operator()(T const* const* parameters, T* residuals) const {
    using H = WithScalar<G, T>;
    const auto curve = evaluate<1, H>(parameters, testing::with_scalar<T>(basis));
    Eigen::Vector3<T> omega;
    if constexpr (Pose<H>) {
      omega = angular_velocity(curve);
    } else {
      omega = curve.velocity;
    }
    Eigen::Map<Eigen::Vector3<T>>{residuals} =
        weight.cast<T>() * (omega + vector_at(parameters[Order]) - measured.cast<T>());
    return true;
  }
};

template <LieGroup G, int Order>
struct AccelerometerFunctor {
  CumulativeBasis<double, Order, 2> basis;
  Eigen::Vector3d measured;
  Eigen::Matrix3d weight;

  template <typename T>
  bool operator()(T const* const* parameters, T* residuals) const {
    using H = WithScalar<G, T>;
    constexpr std::size_t others = Order * ControlPointParts<G>::count;
    const auto curve = evaluate<2, H>(parameters, testing::with_scalar<T>(basis));
    const Eigen::Vector3<T> force = ideal_imu(curve, vector_at(parameters[others + 1])).accel;
    Eigen::Map<Eigen::Vector3<T>>{residuals} =
        weight.cast<T>() * (force + vector_at(parameters[others]) - measured.cast<T>());
    return true;
  }
};

template <LieGroup G, int Order>
void check_gyroscope() {
  testing::Random random(Order);
  const auto basis = uniform_basis<Order, 1>(0.3, 0.5);
  for (const auto& regime : testing::regimes()) {
    INFO("order " << Order << ", " << regime.name);
    const auto weight = testing::some_weight<3>(random);
    const Eigen::Vector3d measured(0.1, -0.2, 0.3);
    testing::Parameters p;
    p.add(testing::control_points<G>(Order, regime, random));
    p.add(Eigen::Vector3d(0.01, 0.02, -0.03));
    const CeresGyroscopeResidual<G, Order> cost(basis, measured, weight);
    CHECK(testing::compare_with_jets(cost, GyroscopeFunctor<G, Order>{basis, measured, weight}, p) <= 16);
    if (regime.good_for_differences()) testing::check_gradients(cost, p);
  }
}

template <LieGroup G, int Order>
void check_accelerometer() {
  testing::Random random(Order);
  const auto basis = uniform_basis<Order, 2>(0.3, 0.5);
  for (const auto& regime : testing::regimes()) {
    INFO("order " << Order << ", " << regime.name);
    const auto weight = testing::some_weight<3>(random);
    const Eigen::Vector3d measured(0.1, -0.2, 9.3);
    testing::Parameters p;
    p.add(testing::control_points<G>(Order, regime, random));
    p.add(Eigen::Vector3d(0.1, 0.2, -0.3));
    p.add(Eigen::Vector3d(1, 2, -9.5));
    const CeresAccelerometerResidual<G, Order> cost(basis, measured, weight);
    CHECK(testing::compare_with_jets(cost, AccelerometerFunctor<G, Order>{basis, measured, weight}, p) <= 16);
    if (regime.good_for_differences()) testing::check_gradients(cost, p);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("The Jacobians of a gyroscope's reading are right", "", Sophus::SO3d, Sophus::SE3d) {
  check_gyroscope<TestType, 4>();
  check_gyroscope<TestType, 5>();
}

TEMPLATE_TEST_CASE("The Jacobians of an accelerometer's reading are right", "", SO3xR3<double>, Sophus::SE3d) {
  check_accelerometer<TestType, 4>();
  check_accelerometer<TestType, 5>();
}

TEMPLATE_TEST_CASE("An IMU that reads what the curve says has no residual", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  testing::Random random(3);
  const auto points = random.walk<G>(4);
  const std::span<const G, 4> span(points);
  const Eigen::Vector3d gravity(0.3, -0.2, -9.8), gyro_bias(0.1, 0.2, 0.3), accel_bias(-1, 2, 3);
  const auto ideal = ideal_imu(evaluate<2>(span, uniform_basis<4, 2>(0.4, 0.5)), gravity);
  {
    testing::Parameters p;
    p.add(points);
    p.add(accel_bias);
    p.add(gravity);
    const CeresAccelerometerResidual<G, 4> cost(uniform_basis<4, 2>(0.4, 0.5), ideal.accel + accel_bias,
                                                Eigen::Matrix3d::Identity());
    CHECK(testing::evaluate_cost(cost, p).residuals.norm() < 1e-14 * 20);
  }
  {
    testing::Parameters p;
    if constexpr (SplitPose<G>) {
      std::vector<Sophus::SO3d> rotations;
      for (const G& x : points) rotations.push_back(rotation(x));
      p.add(rotations);
    } else {
      p.add(points);
    }
    p.add(gyro_bias);
    using R = std::conditional_t<SplitPose<G>, Sophus::SO3d, G>;
    const CeresGyroscopeResidual<R, 4> cost(uniform_basis<4, 1>(0.4, 0.5), ideal.gyro + gyro_bias,
                                            Eigen::Matrix3d::Identity());
    CHECK(testing::evaluate_cost(cost, p).residuals.norm() < 1e-14);
  }
}
