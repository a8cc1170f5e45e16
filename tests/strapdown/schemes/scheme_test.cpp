// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>

#include "strapdown/matrix_exponential.hpp"
#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using testing::galilean_matrix;
using testing::matrix_exponential;

namespace {

/// A scheme of a user's own: what was measured at the end of a step, held over it.
struct Backward : PointScheme<2> {
  template <typename Scalar>
  static StepMean<Scalar> moments(const auto& window, std::size_t from) {
    const Scalar h = step_interval<Scalar>(window, from);
    return {window[from + 1].gyro * h, window[from + 1].accel * h, h};
  }
};

template <typename Scheme, typename Scalar>
using Window = std::array<std::conditional_t<Scheme::takes_increments, StepMean<Scalar>, ImuSample<Scalar, Scalar>>,
                          Scheme::window>;

/// A window of samples of a constant rate and force.
template <typename Scheme, typename Scalar>
Window<Scheme, Scalar> constant(const Eigen::Vector3<Scalar>& gyro, const Eigen::Vector3<Scalar>& accel, Scalar h) {
  Window<Scheme, Scalar> window;
  for (std::size_t i = 0; i < window.size(); ++i) {
    if constexpr (Scheme::takes_increments) {
      window[i] = {gyro * h, accel * h, h};
    } else {
      window[i] = {static_cast<Scalar>(i) * h, gyro, accel};
    }
  }
  return window;
}

}  // namespace

TEST_CASE("The motion in which orders are measured is as aggressive as it says") {
  const testing::AggressiveMotion<> motion;
  double fastest = 0, strongest = 0;
  for (int i = 0; i <= 100'000; ++i) {
    const auto imu = ideal_imu(motion.evaluate<2>(i * 1e-4));
    fastest = std::max(fastest, imu.gyro.norm());
    strongest = std::max(strongest, imu.accel.norm());
  }
  CHECK_THAT(fastest, WithinAbs(20.74, 0.005));
  CHECK_THAT(strongest, WithinAbs(128.9, 0.05));
}

TEMPLATE_TEST_CASE("A constant rate and force are integrated to rounding, however large the angle of a step", "",
                   ZeroOrderHold, Midpoint, Magnus4, RotationCorrectedIncrements, TwoSampleIncrements,
                   ThreeSampleIncrements, Backward) {
  const auto check = []<typename Scalar>(Scalar) {
    const long double eps = std::numeric_limits<Scalar>::epsilon();
    for (const double angle : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 2.0, 3.0}) {
      const Scalar h = Scalar(1) / Scalar(128);  // its multiples are exact
      const Eigen::Vector3<Scalar> gyro = Eigen::Vector3<Scalar>(1, -2, 2) / Scalar(3) * static_cast<Scalar>(angle) / h;
      const Eigen::Vector3<Scalar> accel(3, 1, -9);
      const auto got = step_increment<TestType, Scalar>(constant<TestType, Scalar>(gyro, accel, h), 0);
      const GalileanVector<Scalar> step{gyro * got.interval, accel * got.interval, Eigen::Vector3<Scalar>::Zero(),
                                        got.interval};
      CAPTURE(angle);
      const auto expected = matrix_exponential(galilean_matrix(step));
      const auto error = (galilean_matrix(got) - expected).eval();
      const long double several = 8 * eps * std::max(1.0L, static_cast<long double>(step.phi.norm()));
      CHECK(error.template topLeftCorner<3, 3>().norm() < several);
      CHECK(error.template block<3, 1>(0, 3).norm() < several * static_cast<long double>(step.nu.norm()));
      CHECK(error.template block<3, 1>(0, 4).norm() <
            several * static_cast<long double>(step.nu.norm() * got.interval));
      const long double sine = std::sin(step.phi.template cast<long double>().norm() / 2);
      const auto vec = got.rotation.vec().template cast<long double>();
      CHECK(std::abs(vec.norm() - std::abs(sine)) <
            several * std::min(1.0L, static_cast<long double>(step.phi.norm())));
    }
  };
  check(double());
  check(float());
}

TEMPLATE_TEST_CASE("A body that does not turn gets the mean of its forces", "", Euler, Trapezoid, RungeKutta4,
                   RungeKutta4DoubleStep, UncorrectedIncrements) {
  const Eigen::Vector3d accel(3, 1, -9);
  const auto got = step_increment<TestType, double>(constant<TestType, double>({0, 0, 0}, accel, 0.5), 0);
  const double h = got.interval;
  CHECK(got.rotation.coeffs() == Eigen::Quaterniond::Identity().coeffs());
  CHECK((got.velocity - accel * h).norm() < 1e-14);
  CHECK((got.position - accel * (h * h / 2)).norm() < 1e-14);
}

TEST_CASE("The logarithm of a step has the signs of X' = X A") {
  // A linear in time, by Runge and Kutta's method on matrices: its error is far below that of magnus4.
  const auto error = [](double h) {
    const GalileanVector<double> A0{{1, 2, 3}, {-5, 4, 9}, {0, 0, 0}, 1}, A1{{-8, 3, 5}, {7, 20, -9}, {0, 0, 0}, 0};
    const auto A = [&](long double t) -> testing::Matrix5 { return galilean_matrix(A0) + t * galilean_matrix(A1); };
    testing::Matrix5 X = testing::Matrix5::Identity();
    constexpr int n = 200;
    const long double d = static_cast<long double>(h) / n;
    for (int i = 0; i < n; ++i) {
      const long double t = d * i;
      const testing::Matrix5 k1 = X * A(t), k2 = (X + d / 2 * k1) * A(t + d / 2), k3 = (X + d / 2 * k2) * A(t + d / 2),
                             k4 = (X + d * k3) * A(t + d);
      X += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const GalileanVector<double> mean = A0 + A1 * (h / 2);
    const StepMoments<double> m{mean.phi * h, mean.nu * h, A1.phi * (h * h / 12), A1.nu * (h * h / 12), h};
    const auto omega = magnus4(m);
    CHECK(omega.tau == h);
    const testing::Matrix5 difference = galilean_matrix(increment_from(m)) - X;
    return std::array<long double, 3>{difference.topLeftCorner<3, 3>().norm(), difference.col(3).norm(),
                                      difference.col(4).norm()};
  };
  const auto coarse = error(0.04), fine = error(0.02);
  for (std::size_t i = 0; i < 3; ++i) CHECK(std::log2(coarse[i] / fine[i]) > 4.8L);
}

TEST_CASE("A scheme of one's own takes three lines") {
  testing::check_order<Backward>(1, testing::regular_stamps);
  STATIC_CHECK(HasMoments<Backward, double, Window<Backward, double>>);
  STATIC_CHECK_FALSE(HasMoments<Euler, double, Window<Euler, double>>);
}
