// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// A window of a scheme with a step of `from`, samples at rates of about `rate` rad/s, 10 ms apart, and δ added to all:
/// of rates and forces, or of what they are in an increment.
template <typename Scheme, typename Scalar>
auto window(double rate, const Eigen::Matrix<Scalar, 6, 1>& d) {
  using Sample = typename SampleWindow<Scheme, Scalar, double>::Sample;
  std::array<Sample, Scheme::window> samples;
  double t = 3, before = 3;
  for (std::size_t i = 0; i < samples.size(); ++i, before = t, t += 0.01 + 0.001 * static_cast<double>(i)) {
    const auto at = [](double x) { return static_cast<Scalar>(static_cast<float>(x)); };  // the same in all types
    const Eigen::Vector3<Scalar> gyro(at(rate * std::sin(9 * t)), at(rate * std::cos(8 * t)),
                                      at(-rate * std::sin(7 * t)));
    const Eigen::Vector3<Scalar> accel(at(3 * std::sin(6 * t)), at(10 + std::sin(50 * t)), at(-5 * std::cos(20 * t)));
    if constexpr (Scheme::takes_increments) {
      const auto h = static_cast<Scalar>(i == 0 ? 0.0078125 : t - before);
      samples[i] = {{(gyro + d.template head<3>()) * h, (accel + d.template tail<3>()) * h, h}, t};
    } else {
      samples[i] = {t, gyro + d.template head<3>(), accel + d.template tail<3>()};
    }
  }
  return samples;
}

/// The derivatives as one matrix.
template <typename Scalar>
Eigen::Matrix<Scalar, 9, 6> as_matrix(const LinearizedIncrement<Scalar>& l) {
  return testing::as_matrix<Scalar>({l.R_w, l.v_w, l.v_f, l.p_w, l.p_f});
}

template <typename Scheme, typename Scalar>
void check_step(std::size_t from, double rate) {
  INFO("from " << from << ", " << rate << " rad/s");
  const auto step = [&]<typename T>(const Eigen::Matrix<T, 6, 1>& d) {
    return linearize_step<Scheme, T>(window<Scheme, T>(rate, d), from);
  };
  using Real = long double;
  const auto exact = step(Eigen::Matrix<Real, 6, 1>::Zero().eval());
  const auto analytic = step(Eigen::Matrix<Scalar, 6, 1>::Zero().eval());
  // Differences of sixth order with steps that turn by 0.001: errors are those of rounding, eps/0.1 of the motion.
  const Eigen::Matrix<Real, 9, 6> numeric = testing::central_differences<9, 6, Real>(
      [&](const Eigen::Matrix<Real, 6, 1>& d) { return testing::difference(exact.value, step(d).value); }, Real(0.1L));
  const Eigen::Matrix<Real, 9, 6> J = as_matrix(analytic).template cast<Real>();
  const auto h = static_cast<Real>(analytic.value.interval);
  const Real turn = 1 + Real(rate) * h, force = 15;
  const auto compare = [&](const char* what, int row, int column, Real size) {
    INFO(what);
    const Eigen::Matrix3<Real> error = J.block<3, 3>(row, column) - numeric.block<3, 3>(row, column);
    CHECK(error.cwiseAbs().maxCoeff() <= 16 * Real(testing::eps<Scalar>) * size * turn);
  };
  compare("R_w", 0, 0, h);
  compare("R_f", 0, 3, h);
  compare("v_w", 3, 0, force * h * h);
  compare("v_f", 3, 3, h);
  compare("p_w", 6, 0, force * h * h * h);
  compare("p_f", 6, 3, h * h);
  // The value is what integration takes.
  const auto plain =
      step_increment<Scheme, Scalar>(window<Scheme, Scalar>(rate, Eigen::Matrix<Scalar, 6, 1>::Zero().eval()), from);
  CHECK(testing::difference(plain, analytic.value).cwiseAbs().maxCoeff() <= 4 * testing::eps<Scalar>);
  CHECK(plain.interval == analytic.value.interval);
}

template <typename Scheme, typename Scalar>
void check_scheme(std::initializer_list<std::size_t> steps) {
  // The last turns by 2.5 rad in a step; a step of two increments by twice as much.
  for (const double rate : {0.0, 1e-12, 1e-4, 1.0, 30.0, 180.0}) {
    for (const std::size_t from : steps) check_step<Scheme, Scalar>(from, rate);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("The derivatives of a step are those of its motion", "", float, double) {
  check_scheme<ZeroOrderHold, TestType>({0});
  check_scheme<Euler, TestType>({0});
  check_scheme<Midpoint, TestType>({0});
  check_scheme<Trapezoid, TestType>({0});
  check_scheme<Magnus4, TestType>({0, 1, 2});
  check_scheme<RotationCorrectedIncrements, TestType>({0});
  check_scheme<TwoSampleIncrements, TestType>({0, 1, 2});
}

TEST_CASE("A step without rotation has the derivatives of a point mass, to the last digit but for coupling") {
  const StepMean<double> rest{{0, 0, 0}, {0, 0, 0}, 0.25};
  const auto l = linearize_increment(rest);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  CHECK(l.R_w == 0.25 * I);
  CHECK(l.v_f == 0.25 * I);
  CHECK(l.p_f == 0.03125 * I);
  CHECK(l.v_w.isZero(0));
  CHECK(l.p_w.isZero(0));
}

TEST_CASE("A tiny rate leaves derivatives that are exact to rounding") {
  const double h = 0.01;
  const StepMean<double> step{{1e-160, 0, 0}, {0, 0, 9.8 * h}, h};
  const auto l = linearize_increment(step);
  // dv = h²/2 δω × f, dp = h³/6 δω × f.
  CHECK_THAT(l.v_w(0, 1), WithinRel(9.8 * h * h / 2, 1e-15));
  CHECK_THAT(l.v_w(1, 0), WithinRel(-9.8 * h * h / 2, 1e-15));
  CHECK_THAT(l.p_w(0, 1), WithinRel(9.8 * h * h * h / 6, 1e-15));
  CHECK(l.v_w(2, 2) == 0);
}

TEST_CASE("Schemes that do not say their derivatives are not linearizable") {
  using Points = std::array<ImuSample<>, 4>;
  STATIC_CHECK(LinearizableScheme<Midpoint, double, Points>);
  STATIC_CHECK(LinearizableScheme<Euler, double, Points>);
  STATIC_CHECK(LinearizableScheme<Trapezoid, double, Points>);
  STATIC_CHECK(LinearizableScheme<Magnus4, double, Points>);
  STATIC_CHECK_FALSE(LinearizableScheme<RungeKutta4, double, Points>);
  STATIC_CHECK_FALSE(LinearizableScheme<RungeKutta4DoubleStep, double, Points>);
  using Increments = std::array<SampleWindow<ThreeSampleIncrements, double, double>::Sample, 3>;
  STATIC_CHECK_FALSE(LinearizableScheme<ThreeSampleIncrements, double, Increments>);
  STATIC_CHECK_FALSE(LinearizableScheme<UncorrectedIncrements, double, Increments>);
}
