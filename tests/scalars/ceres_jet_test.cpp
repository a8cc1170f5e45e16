// SPDX-License-Identifier: MIT
// ceres::Jet as the scalar: differentiating the code itself must give the analytic derivatives, to rounding.
#include <ceres/jet.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/bias/temperature_bias.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/gauss_markov.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/output/first_order_bandwidth.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/spline/spline.hpp>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

template <int N>
using Jet = ceres::Jet<double, N>;

template <typename T>
auto values(const T& m) {
  return m.unaryExpr([](const auto& jet) { return jet.a; }).eval();
}
/// The derivative of a vector of Jets by their infinitesimal parts.
template <typename T, int Rows, int N = decltype(T().v)::RowsAtCompileTime>
Eigen::Matrix<double, Rows, N> derivative(const Eigen::Matrix<T, Rows, 1>& m) {
  Eigen::Matrix<double, Rows, N> J;
  for (int i = 0; i < Rows; ++i) J.row(i) = m[i].v.transpose();
  return J;
}

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

/// x exp(δ) at δ = 0, the infinitesimals from `first` on being those of δ.
template <typename T, typename G>
WithScalar<G, T> perturbed(const G& x, int first) {
  using H = WithScalar<G, T>;
  Tangent<H> delta;
  for (int i = 0; i < delta.size(); ++i) delta[i] = T(0.0, first + i);
  return GroupTraits<H>::compose(testing::with_scalar<T>(x), GroupTraits<H>::exp(delta));
}

}  // namespace

template struct splinertia::GroupTraits<Sophus::SO2<Jet<4>>>;
template struct splinertia::GroupTraits<Sophus::SO3<Jet<4>>>;
template struct splinertia::GroupTraits<Sophus::SE2<Jet<4>>>;
template struct splinertia::GroupTraits<Sophus::SE3<Jet<4>>>;
template class splinertia::Spline<Sophus::SO3<Jet<4>>, 4>;
template class splinertia::Spline<Sophus::SE3<Jet<4>>, 4>;
template class splinertia::Spline<SO3xR3<Jet<4>>, 4>;
template class splinertia::Spline<Eigen::Vector3<Jet<4>>, 4>;

TEMPLATE_TEST_CASE("Jets: exp and log have the group's Jacobians", "", Eigen::Vector3d, Sophus::SO3d, Sophus::SE3d,
                   SO3xR3<double>) {
  using G = TestType;
  using T = Jet<DofOf<G>>;
  using H = WithScalar<G, T>;
  testing::Random random(1);
  for (const auto& regime : testing::regimes()) {
    INFO(regime.name);
    const auto points = testing::control_points<G>(2, regime, random);
    const Tangent<G> tau = increment<G>(points[0], points[1]);
    const G x = GroupTraits<G>::exp(tau);

    Tangent<H> moved;
    for (int i = 0; i < DofOf<G>; ++i) moved[i] = T(tau[i], i);
    const Tangent<H> from_x = increment<H>(testing::with_scalar<T>(x), GroupTraits<H>::exp(moved));
    CHECK(largest(derivative(from_x) - right_jacobian<G>(tau)) <= 32 * eps);

    const Tangent<H> log = GroupTraits<H>::log(perturbed<T>(x, 0));
    CHECK(largest(derivative(log) - right_jacobian_inverse<G>(tau)) <= 64 * eps);
    CHECK(largest(values(log) - tau) <= 16 * eps);
  }
}

TEMPLATE_TEST_CASE("Jets: a curve's derivatives by its control points are the analytic Jacobians", "", Eigen::Vector3d,
                   Sophus::SO3d, Sophus::SE3d, SO3xR3<double>) {
  using G = TestType;
  const auto check_order = [&]<int Order>() {
    using T = Jet<Order * DofOf<G>>;
    using H = WithScalar<G, T>;
    testing::Random random(Order);
    const auto basis = uniform_basis<Order, 2>(0.3, 0.5);
    for (const auto& regime : testing::regimes()) {
      INFO("order " << Order << ", " << regime.name);
      const auto points = testing::control_points<G>(Order, regime, random);
      std::vector<H> jets;
      for (std::size_t j = 0; j < Order; ++j) jets.push_back(perturbed<T>(points[j], static_cast<int>(j) * DofOf<G>));
      const auto analytic = linearize<2>(std::span<const G, Order>(points), basis);
      const auto automatic = evaluate<2>(std::span<const H, Order>(jets), testing::with_scalar<T>(basis));
      const auto compare = [&](const Tangent<H>& jet, const auto& jacobians) {
        const auto J = derivative(jet);
        double worst = 0, size = 1;
        for (int j = 0; j < Order; ++j) {
          const auto& expected = jacobians[static_cast<std::size_t>(j)];
          size = std::max(size, largest(expected));
          worst = std::max(worst, largest(J.template middleCols<DofOf<G>>(j * DofOf<G>) - expected));
        }
        CHECK(worst <= 64 * eps * size);
      };
      compare(increment<H>(testing::with_scalar<T>(analytic.value), automatic.value), analytic.value_jacobian);
      compare(automatic.velocity, analytic.velocity_jacobian);
      compare(automatic.acceleration, analytic.acceleration_jacobian);
    }
  };
  check_order.template operator()<2>();
  check_order.template operator()<4>();
}

TEMPLATE_TEST_CASE("Jets: a curve's derivatives by time are its velocity, acceleration and jerk", "", Eigen::Vector3d,
                   Sophus::SO3d, Sophus::SE3d, SO3xR3<double>) {
  using G = TestType;
  using T = Jet<1>;
  using H = WithScalar<G, T>;
  testing::Random random(3);
  for (const auto& regime : testing::regimes()) {
    INFO(regime.name);
    const auto points = testing::control_points<G>(4, regime, random);
    std::vector<H> jets;
    for (const G& x : points) jets.push_back(testing::with_scalar<T>(x));
    const double interval = 0.5, u = 0.3;
    const auto m = evaluate<3>(std::span<const G, 4>(points), uniform_basis<4, 3>(u, interval));
    const T time(u * interval, 0);
    const auto jet = evaluate<2>(std::span<const H, 4>(jets), uniform_basis<4, 2, T>(time / interval, T(interval)));
    const auto check = [](const Tangent<H>& automatic, const Tangent<G>& analytic) {
      CHECK(largest(derivative(automatic) - analytic) <= 64 * eps * (1 + largest(analytic)));
    };
    check(increment<H>(testing::with_scalar<T>(m.value), jet.value), m.velocity);
    check(jet.velocity, m.acceleration);
    check(jet.acceleration, m.jerk);
  }
}

TEST_CASE("Jets: a Spline of them takes time as a number") {
  using T = Jet<12>;
  using H = Sophus::SO3<T>;
  testing::Random random(4);
  const auto points = random.walk<Sophus::SO3d>(6);
  std::vector<H> jets;
  for (std::size_t j = 0; j < points.size(); ++j) {
    jets.push_back(j >= 1 && j < 5 ? perturbed<T>(points[j], 3 * (static_cast<int>(j) - 1))
                                   : testing::with_scalar<T>(points[j]));
  }
  const Spline<H, 4> curve({.start = 0.0, .interval = 0.5}, jets);
  const auto l = linearize<1>(std::span<const Sophus::SO3d, 4>(points.data() + 1, 4), uniform_basis<4, 1>(0.5, 0.5));
  const auto J = derivative(curve.evaluate<1>(0.75).velocity);
  for (int j = 0; j < 4; ++j) {
    CHECK(largest(J.middleCols<3>(3 * j) - l.velocity_jacobian[static_cast<std::size_t>(j)]) <= 64 * eps);
  }
}

TEST_CASE("Jets: a reading differentiates by the parameters of its errors") {
  // Two samples of a chain of errors as a function of one parameter of each.
  const auto gyro = []<typename T>(const std::array<T, 12>& p) {
    Eigen::Matrix3<T> matrix = Eigen::Matrix3<T>::Identity(), sensitivity = Eigen::Matrix3<T>::Zero();
    matrix(0, 1) = p[3];
    sensitivity(1, 2) = p[4];
    const ErrorModel model{ConstantBias{PerAxis<T>(p[0])},
                           RateRamp{PerAxis<T>(p[1])},
                           ScaleFactor{PerAxis<T>(p[2])},
                           Misalignment{matrix},
                           GSensitivity{sensitivity},
                           TemperatureBias{PerAxis<T>(p[5]), WarmUp<T>(T(20), T(60), T(1))},
                           SinusoidalVibration{PerAxis<T>(T(1)), PerAxis<T>(p[6])},
                           GaussMarkov{PerAxis<T>(T(0.1)), PerAxis<T>(p[7])},
                           RandomWalk{PerAxis<T>(p[8])},
                           FirstOrderBandwidth{PerAxis<T>(p[9])},
                           SecondOrderBandwidth{PerAxis<T>(p[10]), PerAxis<T>(T(0.5))},
                           WhiteNoise{PerAxis<T>(p[11])},
                           Saturation{PerAxis<T>(T(1000))}};
    auto state = model.start(StreamKey(1));
    ImuSensorSample<T> sample;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3<T> omega(T(1.0 + i), T(2.0), T(3.0 * i)), force(T(4.0), T(5.0), T(6.0));
      sample = {{omega, Eigen::Vector3<T>::Zero(), T(0.125), i == 0, T(0.125 * i)}, {omega, force}};
      model.apply(sample, state);
    }
    return sample.value;
  };
  const std::array<double, 12> parameters{0.1, 0.2, 0.3, 0.04, 0.5, 0.06, 0.7, 0.8, 0.9, 1.1, 1.2, 1.3};
  using T = Jet<12>;
  std::array<T, 12> jets;
  for (int i = 0; i < 12; ++i) jets[static_cast<std::size_t>(i)] = T(parameters[static_cast<std::size_t>(i)], i);
  const Eigen::Vector3<T> automatic = gyro(jets);
  CHECK(largest(values(automatic) - gyro(parameters)) < 1e-13);
  const auto J = derivative(automatic);
  const double h = 1e-4;
  for (int i = 0; i < 12; ++i) {
    const auto moved = [&](double d) {
      auto p = parameters;
      p[static_cast<std::size_t>(i)] += d;
      return gyro(p);
    };
    const Eigen::Vector3d column = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
    CHECK(largest(J.col(i) - column) < 1e-9);
    CHECK(largest(column) > 1e-4);
  }
}
