// SPDX-License-Identifier: MIT
// Real data: allan/stable32_phase_dat
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/total_degrees_of_freedom.hpp>
#include <splinertia/allan/deviations.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <vector>

#include "allan/reference.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Count = std::int64_t;

/// Row i − 1 gives z_i, the second difference over m of the phase about its point i, from the n rates. The phase is
/// reflected about its ends: x_{−j} = 2x_0 − x_j.
Eigen::MatrixXd second_differences(Count n, Count m) {
  Eigen::MatrixXd phase = Eigen::MatrixXd::Zero(n + 1, n), z(n - 1, n);
  for (Count k = 0; k < n; ++k) {
    phase.row(k + 1) = phase.row(k);
    phase(k + 1, k) = 1;
  }
  const auto at = [&](Count i) -> Eigen::RowVectorXd {
    if (i < 0) return 2 * phase.row(0) - phase.row(-i);
    if (i > n) return 2 * phase.row(n) - phase.row(2 * n - i);
    return phase.row(i);
  };
  for (Count i = 1; i < n; ++i) z.row(i - 1) = at(i + m) - 2 * at(i) + at(i - m);
  return z;
}

/// The covariance of the rates, up to a factor and what differences of them annul.
Eigen::MatrixXd covariance_of_rates(int alpha, Count n) {
  Eigen::VectorXd lags = Eigen::VectorXd::Zero(n);
  double psi = -1.96351002602142347944;  // the digamma function at k + 1/2
  for (Count k = 0; k < n; ++k) {
    const auto lag = static_cast<double>(k);
    if (alpha == 2) lags(k) = k == 0 ? 2 : k == 1 ? -1 : 0;
    if (alpha == 1) lags(k) = -1 / (4 * lag * lag - 1);
    if (alpha == 0) lags(k) = k == 0 ? 1 : 0;
    if (alpha == -1) lags(k) = -psi;
    if (alpha == -2) lags(k) = -lag;
    psi += 2 / (2 * lag + 1);
  }
  Eigen::MatrixXd covariance(n, n);
  if (alpha < -2) {  // begins with the log: (1 − B)^(alpha/2) of white noise
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, n);
    for (Count i = 0; i < n; ++i) {
      double weight = 1;
      for (Count k = 0; k <= i; ++k) {
        weights(i, i - k) = weight;
        weight *= (static_cast<double>(k) - alpha / 2.0) / static_cast<double>(k + 1);
      }
    }
    return weights * weights.transpose();
  }
  for (Count i = 0; i < n; ++i) {
    for (Count j = 0; j < n; ++j) covariance(i, j) = lags(std::abs(i - j));
  }
  return covariance;
}

double exact_degrees(int alpha, Count m, Count n) {
  const Eigen::MatrixXd z = second_differences(n, m);
  const Eigen::MatrixXd covariance = z * covariance_of_rates(alpha, n) * z.transpose();
  return covariance.trace() * covariance.trace() / covariance.squaredNorm();
}

}  // namespace

TEST_CASE("Degrees of freedom of the total variance are those of its covariance matrix") {
  struct Accuracy {
    int alpha;
    double few, many;  // the largest relative error for 8 rates and more, and for 64 and more
  };
  for (const Accuracy& accuracy :
       {Accuracy{2, 1e-9, 1e-9}, Accuracy{1, 0.008, 0.002}, Accuracy{0, 1e-9, 1e-9}, Accuracy{-1, 0.006, 0.002},
        Accuracy{-2, 1e-9, 1e-9}, Accuracy{-3, 0.033, 0.02}, Accuracy{-4, 0.005, 0.002}}) {
    for (Count n : {2, 3, 4, 5, 6, 7, 8, 9, 10, 26, 33, 64, 90}) {
      if (n < 8 && accuracy.few > 1e-9) continue;
      for (Count m : {Count(1), Count(2), Count(3), Count(4), n / 8, n / 5, n / 4, n / 3, n / 2}) {
        if (m < 1 || m > n / 2) continue;
        INFO("alpha " << accuracy.alpha << ", " << n << " rates, m " << m);
        CHECK_THAT(total_degrees_of_freedom(accuracy.alpha, m, n),
                   WithinRel(exact_degrees(accuracy.alpha, m, n), n < 64 ? accuracy.few : accuracy.many));
      }
    }
  }
}

TEST_CASE("The matrices are of the total deviation") {
  const Count n = 24;
  const auto rates = scaled(noisy_integers(static_cast<std::size_t>(n), 0, 1000, 300), 1.0);
  const IntegratedSignal<double> signal(rates, 1.0);
  const Eigen::Map<const Eigen::VectorXd> y(rates.data(), n);
  for (Count m : {1, 2, 5, 12}) {
    const double squares = (second_differences(n, m) * y).squaredNorm();
    const double deviation = std::sqrt(squares / (2.0 * static_cast<double>(n - 1))) / static_cast<double>(m);
    CHECK_THAT(deviations<TotalDeviation>(signal, {m}).at(0), WithinRel(deviation, 1e-12));
  }
}

TEST_CASE("The scatter of simulated total deviations is that of their degrees of freedom") {
  // 16000 logs give the degrees of freedom within 2.2 % and a share of 68 % within 0.4 % (one standard error; the seed is
  // fixed). A chi-square distribution is wider than that of few squares, or of many small and a few large ones: its
  // intervals hold more often than they say, never less.
  struct Trial {
    int alpha;
    Count m;
    double most;  // share of the intervals of one sigma that may hold
  };
  constexpr Count n = 192;
  constexpr int trials = 16000;
  for (const Trial& trial :
       {Trial{2, 1, 0.70}, Trial{2, 16, 0.74}, Trial{2, 96, 0.81}, Trial{0, 1, 0.70}, Trial{0, 16, 0.71},
        Trial{0, 96, 0.74}, Trial{-2, 1, 0.70}, Trial{-2, 16, 0.72}, Trial{-2, 96, 0.76}}) {
    splinertia::NormalStream<> normal(splinertia::StreamKey(5));  // the same numbers with every standard library
    std::vector<double> variances;
    double mean = 0, squares = 0;
    for (int i = 0; i < trials; ++i) {
      std::vector<double> rates(n);
      double before = normal(), sum = 0;
      for (double& y : rates) {
        const double w = normal();
        sum += w;
        y = trial.alpha == 2 ? w - before : trial.alpha == 0 ? w : sum;
        before = w;
      }
      const double deviation = deviations<TotalDeviation>(IntegratedSignal<double>(rates, 1.0), {trial.m}).at(0);
      variances.push_back(deviation * deviation);
      mean += variances.back() / trials;
      squares += variances.back() * variances.back() / trials;
    }
    const double degrees = total_degrees_of_freedom(trial.alpha, trial.m, n);
    INFO("alpha " << trial.alpha << ", m " << trial.m);
    CHECK_THAT(2 * mean * mean / (squares - mean * mean), WithinRel(degrees, 0.08));
    int inside = 0;
    for (const double variance : variances) {
      const auto interval = deviation_interval(std::sqrt(variance), degrees, one_sigma<double>);
      if (interval.lower <= std::sqrt(mean) && std::sqrt(mean) <= interval.upper) ++inside;
    }
    CHECK(inside >= 0.665 * trials);
    CHECK(inside <= trial.most * trials);
  }
}

TEST_CASE("Degrees of freedom of the total variance of long logs") {
  // They grow with the number of rates and stay within 1 and rates − 1. They fall with m, but of white and flicker
  // phase in short logs.
  for (int alpha = -4; alpha <= 2; ++alpha) {
    for (Count n : {Count(2), Count(3), Count(10), Count(1000), Count(1'000'000), Count(1'000'000'000'000)}) {
      double before = static_cast<double>(n) + 1;
      for (Count m = 1; m <= n / 2; m *= 2) {
        INFO("alpha " << alpha << ", " << n << " rates, m " << m);
        const double degrees = total_degrees_of_freedom(alpha, m, n);
        CHECK(degrees >= 1);
        CHECK(degrees <= static_cast<double>(n - 1));
        if (alpha <= 0) CHECK(degrees <= before);
        CHECK(total_degrees_of_freedom(alpha, m, 2 * n) >= degrees);
        before = degrees;
      }
    }
  }
  // Where they depend on the ratio alone, they are the published ones.
  for (double ratio : {4.0, 20.0, 1000.0}) {
    const Count m = 100'000, n = static_cast<Count>(ratio) * m;
    CHECK_THAT(total_degrees_of_freedom(0, m, n), WithinRel(1.5 * ratio, 1e-9));
    CHECK_THAT(total_degrees_of_freedom(-1, m, n), WithinRel(1.168 * ratio - 0.222, 0.01));
    CHECK_THAT(total_degrees_of_freedom(-2, m, n), WithinRel(0.927 * ratio - 0.358, 0.012));
  }
}

namespace {

double published(int alpha, Count m, Count n) {
  return total_degrees_of_freedom(alpha, m, n, PhaseModel::greenhall_riley);
}

}  // namespace

TEST_CASE("Published degrees of freedom of the total variance") {
  CHECK_THAT(published(0, 10, 1000), WithinRel(150.0, 1e-15));
  CHECK_THAT(published(-1, 10, 1000), WithinRel(116.578, 1e-14));
  CHECK_THAT(published(-2, 10, 1000), WithinRel(92.342, 1e-14));
  for (int alpha : {2, 1, -3, -4}) CHECK(published(alpha, 10, 1000) == total_degrees_of_freedom(alpha, 10, 1000));
}

TEST_CASE("Published degrees of freedom of the total variance give the intervals of Stable32", "[.real_data]") {
  const auto rows = stable32_rows("stable32_phase_dat/phase_dat_totdev_octave.txt");
  CHECK(rows.size() >= 8);
  for (const Stable32Row& row : rows) {
    INFO("m = " << row.m << ", alpha = " << row.alpha);
    const auto interval = deviation_interval(row.sigma, published(row.alpha, row.m, 1000));
    CHECK_THAT(interval.lower, WithinRel(row.lower, 5e-4));
    CHECK_THAT(interval.upper, WithinRel(row.upper, 5e-4));
  }
}

TEST_CASE("What has no degrees of freedom of the total variance is refused") {
  const auto refusal = [](int alpha, Count m, Count n) {
    return message_of([&] { return total_degrees_of_freedom(alpha, m, n); });
  };
  CHECK(refusal(3, 1, 10) == "total_degrees_of_freedom: alpha is 3, expected an integer from -4 to 2");
  CHECK(refusal(-5, 1, 10) == "total_degrees_of_freedom: alpha is -5, expected an integer from -4 to 2");
  CHECK(refusal(0, 1, 1) == "total_degrees_of_freedom: number of rates is 1, expected an integer >= 2");
  CHECK(refusal(0, 0, 10) ==
        "total_degrees_of_freedom: averaging factor m is 0, expected 1 to 5, half the number of rates");
  CHECK(refusal(0, 6, 11) ==
        "total_degrees_of_freedom: averaging factor m is 6, expected 1 to 5, half the number of rates");
  CHECK(refusal(0, 5, 11) == "nothing thrown");
}
