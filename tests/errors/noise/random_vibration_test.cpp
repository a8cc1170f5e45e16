// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <splinertia/errors/noise/random_vibration.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;
using std::numbers::pi;

namespace {

// The autocovariance that the term documents, for σ = 1.
double correlation(double omega, double zeta, double t) {
  const double a = omega * std::abs(t);
  if (zeta == 1) return std::exp(-a) * (1 + a);
  if (zeta < 1) {
    const double b = a * std::sqrt((1 - zeta) * (1 + zeta));
    return std::exp(-zeta * a) * (std::cos(b) + zeta * a * (b > 0 ? std::sin(b) / b : 1));
  }
  // The two exponentials of the overdamped oscillator, with rates p < q: (q e^{−pa} − p e^{−qa})/(q − p).
  const double root = std::sqrt((zeta - 1) * (zeta + 1)), p = 1 / (zeta + root);
  return std::exp(-p * a) * (1 - p * std::expm1(-2 * root * a) / (2 * root));
}

constexpr double sigma[] = {0.3, 2, 5}, frequency[] = {8, 20, 3}, zeta[] = {0.05, 1, 3};

auto covariance(std::size_t axis) {
  return [=](double t) { return sigma[axis] * sigma[axis] * correlation(2 * pi * frequency[axis], zeta[axis], t); };
}

template <typename Scalar>
ErrorModel<RandomVibration<Scalar, 3>> model() {
  return {RandomVibration(per_axis<Scalar>(sigma), per_axis<Scalar>(frequency), per_axis<Scalar>(zeta))};
}

constexpr double forgotten = 8;  // s, after which the slowest of the three has correlation e⁻²⁰

// Numbers that are not random, to see what a step does with them.
struct Given {
  double number = 0;
  template <typename Scalar>
  Eigen::Vector3<Scalar> draw() {
    return Eigen::Vector3<Scalar>::Constant(static_cast<Scalar>(number));
  }
};

// The matrices of one step of ωh = a.
struct Matrices {
  Eigen::Matrix2d transition, noise;

  Matrices(double a, double damping_ratio) {
    const RandomVibration term(1.0, a / (2 * pi), damping_ratio);
    for (int column = 0; column < 4; ++column) {
      RandomVibration<double>::State<NormalStreams<>> real(StreamKey(1));
      struct {
        Given for_value, for_rate;
        Eigen::Vector3d value, rate;
        decltype(real.steps) steps{};
      } state{{column == 2 ? 1.0 : 0.0},
              {column == 3 ? 1.0 : 0.0},
              Eigen::Vector3d::Constant(column == 0 ? 1 : 0),
              Eigen::Vector3d::Constant(column == 1 ? 1 : 0)};
      SensorSample<double> sample{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1, false, 1};
      term.apply(sample, state);
      (column < 2 ? transition : noise).col(column % 2) << state.value[0], state.rate[0];
    }
  }
};

}  // namespace

TEMPLATE_TEST_CASE("The autocovariance is that of a damped oscillator, whatever the rate", "", float, double) {
  using Scalar = TestType;
  for (const double rate : rates) {
    const Record errors = record<Scalar>(model<Scalar>(), regular(rate), 18);
    CHECK(errors.no_bias);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto C = [&](std::size_t l) { return covariance(axis)(static_cast<double>(l) / rate); };
      for (const double t : {0.0, 0.02, 0.06, 0.2}) {
        INFO(rate << " Hz, axis " << axis << ", " << t << " s");
        const auto lag = static_cast<std::size_t>(std::lround(t * rate));
        CHECK(off(autocovariance(errors.axes[axis], C, lag, static_cast<std::size_t>(forgotten * rate))) < 4);
      }
    }
  }
}

TEST_CASE("At irregular intervals it is the same") {
  const Intervals intervals = irregular(200, million / 3 + 1);
  const std::vector<double> t = times(intervals);
  const Record errors = record<double>(model<double>(), intervals, 19);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto C = covariance(axis);
    const std::vector<double>& x = errors.axes[axis];
    for (const std::size_t lag : {0U, 1U, 4U, 20U}) {
      INFO("axis " << axis << ", " << lag << " samples");
      // The mean of x_i x_{i+lag} over M of them. Its variance is 1/M² Σ_ij (C_ij C_{i+lag,j+lag} + C_{i,j+lag}
      // C_{i+lag,j}), taken from every 2000th i: the average over 166 neighbourhoods is good to a percent or two.
      const std::size_t M = x.size() - lag, reach = static_cast<std::size_t>(200 * forgotten / 2);
      double mean = 0, expected = 0, squares = 0, count = 0;
      for (std::size_t i = 0; i < M; ++i) {
        mean += x[i] * x[i + lag] / static_cast<double>(M);
        expected += C(t[i + lag] - t[i]) / static_cast<double>(M);
      }
      for (std::size_t i = reach; i + reach < M; i += 2000, ++count) {
        for (std::size_t j = i - reach; j < i + reach; ++j)
          squares += C(t[i] - t[j]) * C(t[i + lag] - t[j + lag]) + C(t[i] - t[j + lag]) * C(t[i + lag] - t[j]);
      }
      CHECK(off({mean, expected, std::sqrt(squares / count / static_cast<double>(M))}) < 4);
    }
  }
}

TEST_CASE("A step of any size keeps the covariance, and two are one of twice the size") {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (const double damping_ratio :
       {1e-6, 1e-3, 0.05, 0.3, 0.707, 0.99, 0.9999999, 1.0, 1.0000001, 1.01, 2.0, 30.0, 1e3, 1e6}) {
    for (double a = 1e-15; a < 1e6; a *= 2.7) {
      INFO("damping ratio " << damping_ratio << ", " << a << " rad");
      const Matrices step(a, damping_ratio);
      const Eigen::Matrix2d kept = step.transition * step.transition.transpose() + step.noise * step.noise.transpose();
      CHECK((kept - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() <= 4 * eps);
      // The phase a is rounded.
      const double allowed = 8 * eps * (1 + a * std::exp(-damping_ratio * a));
      CHECK_THAT(step.transition(0, 0), WithinAbs(correlation(a, damping_ratio, 1), 4 * allowed));
      CHECK((Matrices(2 * a, damping_ratio).transition - step.transition * step.transition).cwiseAbs().maxCoeff() <=
            4 * allowed);
    }
  }
}

TEMPLATE_TEST_CASE("It starts in its stationary law and stays there", "", float, double) {
  using Scalar = TestType;
  // A step of ωh = 2e-4 and ζ = 1e-3 forgets 2e-7 of the amplitude, close to the rounding of float.
  const ErrorModel slow{RandomVibration{Scalar(2), Scalar(0.0064), Scalar(1e-3)}};
  std::vector<double> first, last;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    const Record errors = record<Scalar>(slow, regular(200, 20), seed);
    for (const auto& axis : errors.axes) {
      first.push_back(axis.front() / 2);
      last.push_back(axis.back() / 2);
    }
  }
  for (const std::size_t lag : {0U, 1U}) {
    CHECK(off(white_autocovariance(first, lag)) < 4);
    CHECK(off(white_autocovariance(last, lag)) < 4);
  }
}

TEMPLATE_TEST_CASE("Nothing makes it infinite", "", float, double) {
  using Scalar = TestType;
  for (const double damping_ratio : {1e-9, 0.1, 1.0, 10.0, 1e9}) {
    for (const double f : {1e-30, 1e-9, 1.0, 1e9, 1e30}) {
      INFO("damping ratio " << damping_ratio << ", " << f << " Hz");
      const ErrorModel extreme{RandomVibration{Scalar(1), static_cast<Scalar>(f), static_cast<Scalar>(damping_ratio)}};
      const Record errors = record<Scalar>(extreme, irregular(200, 1000), 20);
      for (const auto& axis : errors.axes)
        CHECK(std::all_of(axis.begin(), axis.end(), [](double x) { return std::abs(x) < 6; }));
    }
  }
}

TEST_CASE("The axes are independent") {
  // Critically damped at 1 MHz: samples at 200 Hz are white.
  const Record errors = record<double>(ErrorModel{RandomVibration{1, 1e6, 1}}, regular(200), 21);
  for (const auto& axis : errors.axes)
    for (const std::size_t lag : {0U, 1U}) CHECK(off(white_autocovariance(axis, lag)) < 4);
  CHECK(off(mean_product(errors.axes[0], errors.axes[1])) < 4);
  CHECK(off(mean_product(errors.axes[1], errors.axes[2])) < 4);
  CHECK(off(mean_product(errors.axes[2], errors.axes[0])) < 4);
}

TEST_CASE("Parameters of a random vibration are given as numbers, one for each axis, or vectors") {
  STATIC_CHECK(std::is_same_v<decltype(RandomVibration{0.1F, 2.0F, 0.1F}), RandomVibration<float>>);
  STATIC_CHECK(std::is_same_v<decltype(RandomVibration{1, 2, 3}), RandomVibration<double>>);
  const RandomVibration term{Eigen::Vector3d(1, 2, 3), 100, PerAxis<double>(0.1, 0.2, 0.3)};
  CHECK(term.standard_deviation[1] == 2);
  CHECK(term.natural_frequency[2] == 100);
  CHECK(term.damping_ratio[0] == 0.1);
}

TEST_CASE("What is no random vibration is refused") {
  const double nan = std::nan("");
  CHECK_THROWS_WITH(RandomVibration(-1.0, 1.0, 1.0),
                    "RandomVibration: standard deviation is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(RandomVibration(nan, 1.0, 1.0),
                    "RandomVibration: standard deviation is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(RandomVibration(1, 0, 1), "RandomVibration: natural frequency is 0, expected a finite number > 0");
  CHECK_THROWS_WITH(RandomVibration(1.0, nan, 1.0),
                    "RandomVibration: natural frequency is nan, expected a finite number > 0");
  CHECK_THROWS_WITH(RandomVibration(1.0, 1.0, -0.1),
                    "RandomVibration: damping ratio is -0.1, expected a finite number > 0");
  CHECK_THROWS_WITH(RandomVibration(1.0, 1.0, std::numeric_limits<double>::infinity()),
                    "RandomVibration: damping ratio is inf, expected a finite number > 0");
}
