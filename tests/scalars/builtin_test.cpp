// SPDX-License-Identifier: MIT
// Every class template, with every member, for every built-in scalar; and what each of them is good for.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/parameter_blocks.hpp>
#include <splinertia/splinertia.hpp>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

template class splinertia::Product<Sophus::SO3f, Eigen::Vector3f>;
template class splinertia::Product<Sophus::SO3d, Eigen::Vector3d>;
template class splinertia::Product<Sophus::SO3<long double>, Eigen::Vector3<long double>>;

template struct splinertia::UniformKnots<float>;
template struct splinertia::UniformKnots<double>;
template struct splinertia::UniformKnots<long double>;
template struct splinertia::UniformKnots<nanoseconds>;

template <typename Scalar>
using NoisyImu = Imu<ErrorModel<RandomWalk<Scalar>, WhiteNoise<Scalar>>, ErrorModel<Saturation<Scalar>>,
                     ErrorModel<StampJitter<Scalar>>>;

// What each scalar brings with it, as a macro because explicit instantiation is a declaration.
#define SPLINERTIA_INSTANTIATE(Scalar)                                                                      \
  template struct splinertia::GroupTraits<Eigen::Vector3<Scalar>>;                                          \
  template struct splinertia::GroupTraits<Sophus::SO2<Scalar>>;                                             \
  template struct splinertia::GroupTraits<Sophus::SO3<Scalar>>;                                             \
  template struct splinertia::GroupTraits<Sophus::SE2<Scalar>>;                                             \
  template struct splinertia::GroupTraits<Sophus::SE3<Scalar>>;                                             \
  template struct splinertia::GroupTraits<splinertia::SO3xR3<Scalar>>;                                      \
  template struct splinertia::detail::DualMatrix3<Scalar>;                                                  \
  template struct splinertia::ParameterLayout<Eigen::Vector3<Scalar>>;                                      \
  template struct splinertia::ParameterLayout<Sophus::SO2<Scalar>>;                                         \
  template struct splinertia::ParameterLayout<Sophus::SO3<Scalar>>;                                         \
  template struct splinertia::ParameterLayout<Sophus::SE2<Scalar>>;                                         \
  template struct splinertia::ParameterLayout<Sophus::SE3<Scalar>>;                                         \
  template struct splinertia::ParameterLayout<splinertia::SO3xR3<Scalar>>;                                  \
  template class splinertia::Spline<Eigen::Vector3<Scalar>, 4>;                                             \
  template class splinertia::Spline<Sophus::SO2<Scalar>, 3>;                                                \
  template class splinertia::Spline<Sophus::SO3<Scalar>, 4, UniformKnots<Scalar>>;                          \
  template class splinertia::Spline<Sophus::SE2<Scalar>, 5, UniformKnots<nanoseconds>>;                     \
  template class splinertia::Spline<Sophus::SE3<Scalar>, 4, UniformKnots<nanoseconds>>;                     \
  template class splinertia::Spline<splinertia::SO3xR3<Scalar>, 6, NonUniformKnots<double>>;                \
  template struct splinertia::Circle<Scalar>;                                                               \
  template struct splinertia::Ellipse<Scalar>;                                                              \
  template struct splinertia::Coning<Scalar>;                                                               \
  template struct splinertia::ConstantTwist<Sophus::SE3<Scalar>>;                                           \
  template class splinertia::PerAxis<Scalar>;                                                               \
  template struct splinertia::ConstantBias<Scalar>;                                                         \
  template struct splinertia::TurnOnBias<Scalar>;                                                           \
  template struct splinertia::WhiteNoise<Scalar>;                                                           \
  template struct splinertia::RandomWalk<Scalar>;                                                           \
  template struct splinertia::GaussMarkov<Scalar>;                                                          \
  template struct splinertia::detail::GaussMarkovStep<Scalar>;                                              \
  template struct splinertia::FlickerBand<Scalar>;                                                          \
  template struct splinertia::BiasInstability<Scalar>;                                                      \
  template struct splinertia::QuantizationNoise<Scalar>;                                                    \
  template struct splinertia::RateRamp<Scalar>;                                                             \
  template struct splinertia::WarmUp<Scalar>;                                                               \
  template struct splinertia::TemperatureBias<Scalar, WarmUp<Scalar>>;                                      \
  template struct splinertia::TemperatureScale<Scalar, WarmUp<Scalar>>;                                     \
  template struct splinertia::ScaleFactor<Scalar>;                                                          \
  template struct splinertia::Misalignment<Scalar>;                                                         \
  template struct splinertia::detail::KalibrMisalignment<Scalar>;                                           \
  template struct splinertia::GSensitivity<Scalar>;                                                         \
  template struct splinertia::GSquaredSensitivity<Scalar>;                                                  \
  template struct splinertia::SizeEffect<Scalar>;                                                           \
  template struct splinertia::CorrelatedNoise<Scalar, 3>;                                                   \
  template struct splinertia::ScaleFactorAsymmetry<Scalar>;                                                 \
  template struct splinertia::VibrationRectification<Scalar>;                                               \
  template struct splinertia::Spikes<Scalar>;                                                               \
  template struct splinertia::StuckReadings<Scalar>;                                                        \
  template class splinertia::SensorErrors<ErrorModel<WhiteNoise<Scalar>>, 2, ErrorModel<>, Scalar, Scalar>; \
  template struct splinertia::SinusoidalVibration<Scalar>;                                                  \
  template struct splinertia::RandomVibration<Scalar>;                                                      \
  template struct splinertia::FirstOrderBandwidth<Scalar>;                                                  \
  template struct splinertia::SecondOrderBandwidth<Scalar>;                                                 \
  template struct splinertia::Quantization<Scalar>;                                                         \
  template struct splinertia::Saturation<Scalar>;                                                           \
  template struct splinertia::ClockOffset<Scalar>;                                                          \
  template struct splinertia::ClockDrift<Scalar>;                                                           \
  template struct splinertia::StampJitter<Scalar>;                                                          \
  template struct splinertia::DroppedSamples<Scalar>;                                                       \
  template struct splinertia::Stamp<Scalar>;                                                                \
  template struct splinertia::SensorSample<Scalar>;                                                         \
  template class splinertia::ErrorModel<WhiteNoise<Scalar>, RandomWalk<Scalar>>;                            \
  template struct splinertia::BasicImuReading<Scalar, nanoseconds>;                                         \
  template struct splinertia::StampedImuReading<Scalar, Scalar>;                                            \
  template class splinertia::ImuErrors<NoisyImu<Scalar>, Scalar, nanoseconds>;                              \
  template class splinertia::detail::Simulation<const splinertia::Ellipse<Scalar>&, NoisyImu<Scalar>>;      \
  template struct splinertia::Mounting<Scalar>;                                                             \
  template struct splinertia::NavState<Scalar>;                                                             \
  template struct splinertia::NavState<Scalar, nanoseconds>;                                                \
  template struct splinertia::detail::GalileanVector<Scalar>;                                               \
  template struct splinertia::detail::NavIncrement<Scalar>;                                                 \
  template struct splinertia::StepMean<Scalar>;                                                             \
  template struct splinertia::detail::StepMoments<Scalar>;                                                  \
  template struct splinertia::ImuSample<Scalar, nanoseconds>;                                               \
  template struct splinertia::ImuIncrement<Scalar, nanoseconds>;                                            \
  template struct splinertia::Magnus4::Weights<Scalar>;                                                     \
  template struct splinertia::GapOptions<Scalar>;                                                           \
  template struct splinertia::RotatingFrame<Scalar>;                                                        \
  template struct splinertia::IntegrationOptions<Scalar, RotatingFrame<Scalar>>;                            \
  template class splinertia::detail::SampleWindow<Magnus4, Scalar, Scalar>;                                 \
  template class splinertia::detail::SampleWindow<TwoSampleIncrements, Scalar, nanoseconds>;                \
  template class splinertia::Integrator<Midpoint, Scalar, Scalar>;                                          \
  template class splinertia::Integrator<RungeKutta4DoubleStep, Scalar, nanoseconds, RotatingFrame<Scalar>>; \
  template class splinertia::Integrator<ThreeSampleIncrements, Scalar, nanoseconds>;                        \
  template struct splinertia::ImuBias<Scalar>;                                                              \
  template struct splinertia::detail::BiasJacobians<Scalar>;                                                \
  template struct splinertia::detail::LinearizedIncrement<Scalar>;                                          \
  template struct splinertia::ImuNoise<Scalar>;                                                             \
  template class splinertia::detail::ImuCovariance<Scalar>;                                                 \
  template class splinertia::PreintegratedImu<Scalar>;                                                      \
  template class splinertia::PreintegratedImu<Scalar, ImuCovariance<Scalar>>;                               \
  template class splinertia::Preintegrator<Magnus4, Scalar, Scalar>;                                        \
  template class splinertia::Preintegrator<TwoSampleIncrements, Scalar, nanoseconds, ImuNoise<Scalar>>;

SPLINERTIA_INSTANTIATE(float)
SPLINERTIA_INSTANTIATE(double)
SPLINERTIA_INSTANTIATE(long double)

TEMPLATE_TEST_CASE("A curve is as accurate as its scalar", "", float, double, long double) {
  using Scalar = TestType;
  using G = SO3xR3<Scalar>;
  using Wide = SO3xR3<long double>;
  testing::Random random(1);
  const auto points = random.walk<G>(4);
  std::vector<Wide> wide;
  for (const G& x : points) {
    Sophus::SO3<long double> R;
    for (int i = 0; i < 4; ++i) R.data()[i] = rotation(x).data()[i];
    wide.emplace_back(R, position(x).template cast<long double>());
  }
  const auto basis = uniform_basis<4, 2>(Scalar(0.375), Scalar(0.5));  // exact in every scalar
  const auto m = evaluate<2>(std::span<const G, 4>(points), basis);
  const auto expected = evaluate<2>(std::span<const Wide, 4>(wide), uniform_basis<4, 2>(0.375L, 0.5L));
  const long double eps = std::numeric_limits<Scalar>::epsilon();
  CHECK((position(m.value).template cast<long double>() - position(expected.value)).norm() < 16 * eps);
  // The norm of a float's quaternion is 1 to rounding only, which the truth in long double sees.
  CHECK((m.velocity.template cast<long double>() - expected.velocity).norm() < 64 * eps);
  CHECK((m.acceleration.template cast<long double>() - expected.acceleration).norm() < 256 * eps);
  const auto imu = ideal_imu(m);
  const auto truth = ideal_imu(expected);
  CHECK((imu.accel.template cast<long double>() - truth.accel).norm() < 512 * eps);
}

namespace {

/// Every error term that does not round or drop; of those for one kind of sensor, that of a gyroscope.
template <typename Scalar, bool of_gyro>
auto every_term() {
  const auto per_axis = [](double size) {
    return PerAxis<Scalar>(static_cast<Scalar>(size), static_cast<Scalar>(2 * size), static_cast<Scalar>(3 * size));
  };
  const Eigen::Matrix3<Scalar> skew{{0, Scalar(0.01), Scalar(0.02)}, {Scalar(-0.01), 0, 0}, {0, 0, Scalar(0.01)}};
  const WarmUp<Scalar> warm_up(20, 60, 10);
  const auto of_sensor = [&] {
    if constexpr (of_gyro) {
      return GSensitivity{Eigen::Matrix3<Scalar>(skew / 10)};
    } else {
      return VibrationRectification{per_axis(0.001)};
    }
  }();
  return ErrorModel{ConstantBias{per_axis(0.1)},
                    TurnOnBias{per_axis(0.1)},
                    RandomWalk{per_axis(0.01)},
                    GaussMarkov{per_axis(0.1), per_axis(3)},
                    BiasInstability{per_axis(0.1)},
                    RateRamp{per_axis(0.01)},
                    TemperatureBias{per_axis(0.01), warm_up},
                    TemperatureScale{per_axis(0.001), warm_up},
                    ScaleFactor{per_axis(0.01)},
                    Misalignment{Eigen::Matrix3<Scalar>(Eigen::Matrix3<Scalar>::Identity() + skew)},
                    of_sensor,
                    SinusoidalVibration{per_axis(0.1), per_axis(7)},
                    RandomVibration{per_axis(0.1), per_axis(7), per_axis(0.1)},
                    FirstOrderBandwidth{per_axis(30)},
                    SecondOrderBandwidth{per_axis(30), per_axis(0.5)},
                    WhiteNoise{per_axis(0.01)},
                    QuantizationNoise{per_axis(0.001)},
                    Saturation{per_axis(1000)}};
}

}  // namespace

TEMPLATE_TEST_CASE("Every error term makes of the same random numbers the same in every scalar", "", float,
                   long double) {
  using Scalar = TestType;
  const Scalar eps = std::max(std::numeric_limits<Scalar>::epsilon(), Scalar(std::numeric_limits<double>::epsilon()));
  const auto run_of = []<typename S>(const Ellipse<S>& motion) {
    const Imu imu{every_term<S, true>(), every_term<S, false>(),
                  ErrorModel{ClockDrift<S>{S(0.001)}, ClockOffset<S>{S(0.5)}}};
    return simulate(motion, imu, {.rate = 64, .seed = 1, .start = S(0), .end = S(10)});
  };
  const Ellipse<Scalar> motion;
  const Ellipse<double> motion_in_double;
  const auto run = run_of(motion);
  const auto run_in_double = run_of(motion_in_double);
  CHECK(run.size() == 641);
  auto expected = run_in_double.begin();
  for (const auto& r : run) {
    const auto differ = [](const Eigen::Vector3<Scalar>& a, const Eigen::Vector3d& b) {
      return (a - b.template cast<Scalar>()).norm();
    };
    REQUIRE(std::abs(r.time - static_cast<Scalar>(expected->time)) < 32 * eps);
    REQUIRE(differ(r.gyro, expected->gyro) < 1000 * eps);
    REQUIRE(differ(r.accel, expected->accel) < 2000 * eps);
    REQUIRE(differ(r.gyro_bias, expected->gyro_bias) < 1000 * eps);
    ++expected;
  }
}

namespace {

/// The state after 64 steps of 1/128 s in the aggressive motion, with increments by Simpson's rule.
template <typename Scheme, typename Scalar>
NavState<Scalar, Scalar> integrated() {
  const testing::AggressiveMotion<Scalar> motion;
  Integrator<Scheme, Scalar, Scalar, RotatingFrame<Scalar>> integrator(
      nav_state(motion.template evaluate<1>(0), Scalar(0)), standard_gravity<Scalar>(), {},
      RotatingFrame<Scalar>{{Scalar(0.125), 0, 0}});
  const Scalar h = Scalar(1) / 128;
  for (int i = 0; i <= 64; ++i) {
    const auto imu = [&](Scalar t) { return ideal_imu(motion.template evaluate<2>(t)); };
    const auto end = imu(static_cast<Scalar>(i) * h);
    if constexpr (!Scheme::takes_increments) {
      integrator.push(ImuSample<Scalar, Scalar>{static_cast<Scalar>(i) * h, end.gyro, end.accel});
    } else if (i > 0) {
      const auto begin = imu(static_cast<Scalar>(i - 1) * h), middle = imu((static_cast<Scalar>(i) - Scalar(0.5)) * h);
      integrator.push(ImuIncrement<Scalar, Scalar>{static_cast<Scalar>(i) * h,
                                                   (begin.gyro + 4 * middle.gyro + end.gyro) * (h / 6),
                                                   (begin.accel + 4 * middle.accel + end.accel) * (h / 6)});
    }
  }
  integrator.finish();
  return integrator.state();
}

}  // namespace

TEMPLATE_TEST_CASE("Every scheme computes the same in every scalar", "", Euler, ZeroOrderHold, Midpoint, Trapezoid,
                   RungeKutta4, RungeKutta4DoubleStep, Magnus4, UncorrectedIncrements, RotationCorrectedIncrements,
                   TwoSampleIncrements, ThreeSampleIncrements) {
  const auto expected = integrated<TestType, long double>();
  const auto check = [&]<typename Scalar>(Scalar) {
    const auto got = integrated<TestType, Scalar>();
    const long double eps = std::numeric_limits<Scalar>::epsilon();
    CHECK(got.time == Scalar(0.5));
    // Readings of 20 rad/s and 129 m/s² with an error of some eps each, added up over 0.5 s.
    const auto attitude = got.R_WB.unit_quaternion().template cast<long double>();
    CHECK((expected.R_WB.unit_quaternion().conjugate() * attitude).vec().norm() < 50 * eps);
    CHECK((got.v_WB.template cast<long double>() - expected.v_WB).norm() < 1000 * eps);
    CHECK((got.p_WB.template cast<long double>() - expected.p_WB).norm() < 500 * eps);
  };
  check(float());
  check(double());
}
