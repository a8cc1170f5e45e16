// SPDX-License-Identifier: MIT
// The same templates with 50 decimal digits: what the other scalars cannot see of an error in a formula shows here.
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <span>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/bias/temperature_bias.hpp>
#include <splinertia/errors/clock/clock_drift.hpp>
#include <splinertia/errors/detail/second_order_response.hpp>
#include <splinertia/errors/noise/bias_instability.hpp>
#include <splinertia/errors/noise/gauss_markov.hpp>
#include <splinertia/errors/noise/random_vibration.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/output/first_order_bandwidth.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <splinertia/errors/scale/temperature_scale.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/spline/linearize.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Real = boost::multiprecision::cpp_bin_float_50;

template struct splinertia::GroupTraits<Sophus::SO2<Real>>;
template struct splinertia::GroupTraits<Sophus::SO3<Real>>;
template struct splinertia::GroupTraits<Sophus::SE2<Real>>;
template struct splinertia::GroupTraits<Sophus::SE3<Real>>;
template class splinertia::Spline<Sophus::SO3<Real>, 4>;
template class splinertia::Spline<Sophus::SE3<Real>, 4>;
template class splinertia::Spline<SO3xR3<Real>, 4>;
template class splinertia::Spline<Eigen::Vector3<Real>, 4>;

namespace {

const Real eps = std::numeric_limits<Real>::epsilon();  // 5e-51

template <typename Derived>
Real largest(const Eigen::MatrixBase<Derived>& m) {
  Real result = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      const Real e = abs(Real(m(i, j)));
      if (!(e <= result)) result = e;
    }
  }
  return result;
}

/// A tangent whose rotation has the given angle, and other components up to 1.
template <typename G>
Tangent<G> tangent(testing::Random& random, const Real& angle) {
  Tangent<G> tau = random.tangent<G>();
  if constexpr (!is_commutative<G>) {
    constexpr int at = RigidPose<G> ? 3 : 0;
    const Eigen::Vector3<Real> axis = tau.template segment<3>(at);
    tau.template segment<3>(at) = angle / sqrt(axis.squaredNorm()) * axis;
  }
  return tau;
}

std::vector<Real> angles() {
  const Real pi = boost::math::constants::pi<Real>();
  return {Real(0), Real("1e-60"), Real("1e-30"), Real("1e-20"),     Real("1e-8"),      Real(1) / 10,
          Real(1), Real(2),       Real(3),       pi - Real("1e-8"), pi - Real("1e-20")};
}

}  // namespace

TEMPLATE_TEST_CASE("50 digits: exp, log and their Jacobians", "", Eigen::Vector3<Real>, Sophus::SO3<Real>,
                   Sophus::SE3<Real>, SO3xR3<Real>) {
  using G = TestType;
  using Traits = GroupTraits<G>;
  testing::Random random(1);
  const Jacobian<G> I = Jacobian<G>::Identity();
  for (const Real& angle : angles()) {
    INFO("angle " << angle);
    const Tangent<G> tau = tangent<G>(random, angle);
    const G x = Traits::exp(tau);
    CHECK(largest(Traits::log(x) - tau) < 16 * eps);
    const Jacobian<G> J = left_jacobian<G>(tau);
    CHECK(largest(J * left_jacobian_inverse<G>(tau) - I) < 64 * eps);
    CHECK(largest(right_jacobian_inverse<G>(tau) * right_jacobian<G>(tau) - I) < 64 * eps);

    // exp(τ + δ) = exp(J_l δ) exp(τ) by central differences of sixth order: errors h⁶ = 1e-42 and eps/h = 1e-43.
    const Real h("1e-7");
    for (int i = 0; i < DofOf<G>; ++i) {
      const auto step = [&](int n) {
        const Tangent<G> moved = tau + (n * h) * Tangent<G>::Unit(i);
        return Tangent<G>(Traits::log(Traits::compose(Traits::exp(moved), Traits::inverse(x))));
      };
      const Tangent<G> column =
          (45 * (step(1) - step(-1)) - 9 * (step(2) - step(-2)) + (step(3) - step(-3))) / (60 * h);
      CHECK(largest(column - J.col(i)) < Real("1e-40"));
    }
  }
}

TEMPLATE_TEST_CASE("50 digits: increments keep relative accuracy", "", Sophus::SO3<Real>, Sophus::SE3<Real>) {
  using G = TestType;
  testing::Random random(2);
  const G x = random.walk<G>(1)[0];
  CHECK(increment<G>(x, x).isZero(0));
  for (const Real& size : {Real("1e-3"), Real("1e-20"), Real("1e-40")}) {
    const Tangent<G> tau = size * random.tangent<G>();
    const G y = GroupTraits<G>::compose(x, GroupTraits<G>::exp(tau));
    CHECK(largest(increment<G>(x, y) - tau) < 64 * eps);  // what rounding of y leaves
  }
}

TEMPLATE_TEST_CASE("50 digits: derivatives of a spline", "", Eigen::Vector3<Real>, Sophus::SO3<Real>, Sophus::SE3<Real>,
                   SO3xR3<Real>) {
  using G = TestType;
  const auto check_order = [&]<int Order>() {
    INFO("order " << Order);
    testing::Random random(Order);
    std::vector<G> points = random.walk<G>(1);
    while (points.size() < Order) {
      points.push_back(GroupTraits<G>::compose(points.back(), GroupTraits<G>::exp(tangent<G>(random, Real(1) / 2))));
    }
    const Real u = Real(3) / 10, interval = Real(1) / 2, h("1e-7");
    const auto curve = [&]<int D>(const std::vector<G>& x, const Real& t) {
      return evaluate<D>(std::span<const G, Order>(x), uniform_basis<Order, D>(Real(t / interval), interval));
    };
    const auto difference = [&](const auto& f) {
      return Tangent<G>((45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h));
    };
    const Real t = u * interval, limit("1e-36");  // seventh derivatives are up to 1e5
    const auto m = curve.template operator()<3>(points, t);
    CHECK(largest(difference([&](const Real& dt) {
                    return increment<G>(m.value, curve.template operator()<0>(points, t + dt).value);
                  }) -
                  m.velocity) < limit);
    CHECK(largest(difference([&](const Real& dt) { return curve.template operator()<1>(points, t + dt).velocity; }) -
                  m.acceleration) < limit);
    CHECK(
        largest(difference([&](const Real& dt) { return curve.template operator()<2>(points, t + dt).acceleration; }) -
                m.jerk) < limit);

    // The Jacobians, by moving each control point along each tangent.
    const auto l = linearize<2>(std::span<const G, Order>(points), uniform_basis<Order, 2>(u, interval));
    for (std::size_t j = 0; j < Order; ++j) {
      for (int i = 0; i < DofOf<G>; ++i) {
        const auto moved = [&](const Real& d) {
          std::vector<G> x = points;
          x[j] = GroupTraits<G>::compose(x[j], GroupTraits<G>::exp(Tangent<G>(d * Tangent<G>::Unit(i))));
          return curve.template operator()<2>(x, t);
        };
        CHECK(largest(difference([&](const Real& d) { return increment<G>(m.value, moved(d).value); }) -
                      l.value_jacobian[j].col(i)) < limit);
        CHECK(largest(difference([&](const Real& d) { return moved(d).velocity; }) - l.velocity_jacobian[j].col(i)) <
              limit);
        CHECK(largest(difference([&](const Real& d) { return moved(d).acceleration; }) -
                      l.acceleration_jacobian[j].col(i)) < limit);
      }
    }
  };
  check_order.template operator()<4>();
  check_order.template operator()<5>();
}

TEST_CASE("50 digits: a spline with time in double seconds") {
  using G = SO3xR3<Real>;
  testing::Random random(3);
  const auto points = random.walk<G>(7);
  const Spline<G, 4> curve({.start = 1.0, .interval = 0.25}, points);
  const auto m = curve.evaluate<2>(1.5625);  // segment 2, u = 1/4, all exact in double
  const auto expected =
      evaluate<2>(std::span<const G, 4>(points.data() + 2, 4), uniform_basis<4, 2>(Real(1) / 4, Real(1) / 4));
  CHECK(largest(increment<G>(expected.value, m.value)) < 64 * eps);
  CHECK(largest(m.velocity - expected.velocity) < 256 * eps);
  CHECK(largest(m.acceleration - expected.acceleration) < 1024 * eps);
  const auto imu = ideal_imu(m);
  CHECK(largest(imu.gyro - m.velocity.head<3>()) == 0);
}

namespace {

/// Parameters that are exact in double.
template <typename Scalar>
auto error_terms() {
  const auto number = [](double x) { return PerAxis<Scalar>(Scalar(x)); };
  const Eigen::Matrix3<Scalar> skew{{Scalar(0), Scalar(0.25), Scalar(0)},
                                    {Scalar(-0.125), Scalar(0), Scalar(0)},
                                    {Scalar(0), Scalar(0.5), Scalar(0.25)}};
  const WarmUp<Scalar> warm_up(Scalar(20), Scalar(60), Scalar(10));
  return ErrorModel{ConstantBias{number(0.5)},
                    RandomWalk{number(0.25)},
                    GaussMarkov{number(0.25), number(3)},
                    BiasInstability{number(0.25)},
                    RateRamp{number(0.125)},
                    TemperatureBias{number(0.125), warm_up},
                    TemperatureScale{number(0.0625), warm_up},
                    ScaleFactor{number(0.125)},
                    Misalignment{Eigen::Matrix3<Scalar>(Eigen::Matrix3<Scalar>::Identity() + skew)},
                    GSensitivity{skew},
                    SinusoidalVibration{number(0.5), number(3)},
                    RandomVibration{number(0.5), number(3), number(0.25)},
                    FirstOrderBandwidth{number(10)},
                    SecondOrderBandwidth{number(10), number(0.5)},
                    WhiteNoise{number(0.25)},
                    Saturation{number(1000)}};
}

}  // namespace

TEST_CASE("50 digits: every error term makes of the same random numbers what it makes in double") {
  testing::Random random(4);
  const auto points = random.walk<SO3xR3<double>>(7);
  std::vector<SO3xR3<Real>> wide;
  for (const auto& x : points) {
    Sophus::SO3<Real> R;
    for (int i = 0; i < 4; ++i) R.data()[i] = rotation(x).data()[i];
    wide.emplace_back(R, position(x).cast<Real>());
  }
  const Spline<SO3xR3<double>, 4> curve({.start = 1.0, .interval = 0.25}, points);
  const Spline<SO3xR3<Real>, 4> wide_curve({.start = 1.0, .interval = 0.25}, wide);
  const auto run =
      simulate(curve, Imu{error_terms<double>(), ErrorModel{}, ErrorModel{ClockDrift{0.125}}}, {.rate = 32});
  const Imu imu{error_terms<Real>(), ErrorModel{}, ErrorModel{ClockDrift<Real>{Real(0.125)}}};
  auto expected = run.begin();
  for (const auto& r : simulate(wide_curve, imu, {.rate = 32})) {
    REQUIRE(r.time == expected->time);
    REQUIRE(largest(r.gyro - expected->gyro.cast<Real>()) < Real(1e-12));
    REQUIRE(largest(r.gyro_bias - expected->gyro_bias.cast<Real>()) < Real(1e-12));
    ++expected;
  }
  CHECK(expected == run.end());
}

TEST_CASE("50 digits: rounding, and what is refused") {
  SensorSample<Real> sample{Eigen::Vector3<Real>::Constant(Real(7) / 3), Eigen::Vector3<Real>::Zero(), Real(1), true,
                            Real(0)};
  Quantization<Real>::State state;
  Quantization<Real>{Real("0.1")}.apply(sample, state);
  CHECK(sample.value[0] == 23 * Real("0.1"));
  CHECK_THROWS_WITH(WhiteNoise<Real>{Real(-2)}, "WhiteNoise: density is -2, expected a finite number >= 0");
}

TEST_CASE("50 digits: the oscillator's steps in double are right to a few eps, whatever its size and damping") {
  const double double_eps = std::numeric_limits<double>::epsilon();
  for (const double zeta : {0.01, 0.7, 1 - 0x1p-53, 1.0, 1.2, 1.3, 30.0, 1e6}) {
    for (double a = 1e-9; a < 2e9; a *= 12.3) {
      INFO("a = " << a << ", damping ratio " << zeta);
      const auto transition = oscillator_transition<double>(a, zeta);
      CHECK(largest(transition.cast<Real>() - oscillator_transition<Real>(Real(a), Real(zeta))) <
            (4 + 1 / zeta) * double_eps);
      // What a ramp between samples adds, as second_order_bandwidth.hpp has it from the response to a step.
      const auto ramp = [](const auto& size, const auto& damping, const auto& T) {
        const auto response = oscillator_step_response(size, damping);
        return Real(1) - (Real(2) * damping * response + T(0, 1)) / size;
      };
      CHECK(
          abs(ramp(a, zeta, transition) - ramp(Real(a), Real(zeta), oscillator_transition<Real>(Real(a), Real(zeta)))) <
          (8 + 1 / zeta) * double_eps);
    }
  }
}
