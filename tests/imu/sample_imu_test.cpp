// SPDX-License-Identifier: MIT
#include <splinertia/imu/sample_imu.hpp>

#include <random>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

template <typename G>
Spline<G, 4> random_curve() {
  using Scalar = ScalarOf<G>;
  std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> uniform(-0.4, 0.4);
  std::vector<G> points{GroupTraits<G>::identity()};
  for (int i = 1; i < 20; ++i) {
    Tangent<G> tau;
    for (int k = 0; k < tau.size(); ++k) tau[k] = static_cast<Scalar>(uniform(bits));
    points.push_back(GroupTraits<G>::compose(points.back(), GroupTraits<G>::exp(tau)));
  }
  return {{0.0, 0.1}, points};
}

/// As in spline/sample_test.cpp: the same where nothing is fused.
template <typename Scalar>
void check_same(const Eigen::Vector3<Scalar>& got, const Eigen::Vector3<Scalar>& expected) {
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  CHECK((got - expected).cwiseAbs().maxCoeff() <= 40 * std::numeric_limits<Scalar>::epsilon() * (1 + expected.norm()));
#else
  CHECK(got == expected);
#endif
}

}  // namespace

TEMPLATE_TEST_CASE("samples are what ideal_imu() gives", "", SO3xR3<double>, SO3xR3<float>, Sophus::SE3d,
                   Sophus::SE3f) {
  using G = TestType;
  using Scalar = ScalarOf<G>;
  const auto curve = random_curve<G>();
  const Eigen::Vector3<Scalar> gravity(Scalar(0.1), Scalar(-0.2), Scalar(-9.7));
  const Mounting<Scalar> arm{GroupTraits<Sophus::SO3<Scalar>>::exp({Scalar(0.3), Scalar(1), Scalar(-2)}),
                             {Scalar(0.5), Scalar(-0.1), Scalar(0.2)}};
  const SampleTimes<double> times{0.03, 0.004};
  const auto at_rest = sample_imu(curve, times.start, times.interval, 400);
  const auto heavy = sample_imu(curve, times.start, times.interval, 400, gravity);
  const auto on_arm = sample_imu(curve, times.start, times.interval, 400, gravity, arm);
  REQUIRE(at_rest.size() == 400);
  for (std::size_t i = 0; i < 400; ++i) {
    const auto motion = curve.template evaluate<2>(times(i));
    check_same<Scalar>(at_rest[i].gyro, ideal_imu(motion).gyro);
    check_same<Scalar>(at_rest[i].accel, ideal_imu(motion).accel);
    check_same<Scalar>(heavy[i].accel, ideal_imu(motion, gravity).accel);
    check_same<Scalar>(on_arm[i].gyro, ideal_imu(motion, gravity, arm).gyro);
    check_same<Scalar>(on_arm[i].accel, ideal_imu(motion, gravity, arm).accel);
    check_same<Scalar>(position(on_arm[i].pose), position(motion.value));
    check_same<Scalar>(rotation(on_arm[i].pose).unit_quaternion().vec(),
                       rotation(motion.value).unit_quaternion().vec());
  }
}

TEST_CASE("samples are rows and a range, and come in parts") {
  const auto curve = random_curve<SO3xR3<double>>();
  const auto samples = sample_imu(curve, 0.0, 0.005, 200);
  CHECK(samples.gyro().rows() == 3);
  CHECK(samples.accel()(1, 20) == samples[20].accel.y());
  CHECK(samples.pose()(6, 20) == position(samples[20].pose).z());
  std::size_t count = 0;
  for (const auto& s : samples) count += s.accel.allFinite() ? 1 : 0;
  CHECK(count == 200);
  ImuSamples<SO3xR3<double>> part;
  sample_imu(curve, SampleTimes<double>{0.0, 0.005}, 50, 100, part, standard_gravity<double>());
  REQUIRE(part.size() == 100);
  check_same<double>(part[10].gyro, samples[60].gyro);
}

TEST_CASE("motions that are no splines are sampled one by one") {
  const Ellipse<double> ellipse{};
  const auto samples = sample_imu(ellipse, 0.0, 0.5, 40);
  CHECK(samples[7].accel == ideal_imu(ellipse.evaluate<2>(3.5)).accel);
}

TEST_CASE("times that are not on the curve are refused") {
  const auto curve = random_curve<SO3xR3<double>>();
  CHECK_THROWS_AS(sample_imu(curve, 0.0, 0.1, 1000), std::out_of_range);
  CHECK_THROWS_AS(sample_imu(curve, 0.0, -0.1, 3), std::invalid_argument);
}
