// SPDX-License-Identifier: MIT
// Real data: allan/stable32_phase_dat allan/stable32_pink
#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <splinertia/allan/curve.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "allan/reference.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

/// Half a unit of the fifth digit, which Stable32 rounds one to from a little further.
double half_a_digit(double sigma) { return 0.505 * std::pow(10.0, std::floor(std::log10(sigma)) - 4); }

/// All rows of a table of Stable32: terms, deviations, alphas of 30 averages and more (unless one was given to it), and
/// intervals where there are some.
template <Deviation D>
void check_table(const IntegratedSignal<double>& signal, const std::string& file, bool alpha_given = false) {
  const auto rows = stable32_rows(file);
  CHECK(rows.size() >= 8);
  std::vector<std::int64_t> factors;
  for (const Stable32Row& row : rows) factors.push_back(row.m);
  const auto result = curve<D>(signal, {.factors = AveragingFactors::given(factors)});
  REQUIRE(result.points.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Stable32Row& row = rows[i];
    const auto& point = result.points[i];
    INFO(file << ", m = " << row.m << ", alpha = " << row.alpha);
    CHECK(point.factor == row.m);
    CHECK(point.terms == row.terms);
    CHECK_THAT(point.deviation, WithinAbs(row.sigma, half_a_digit(row.sigma)));
    if (!alpha_given && signal.samples() >= 30 * row.m) CHECK(point.alpha == row.alpha);
    if (row.lower == 0) continue;
    const auto interval =
        curve<D>(signal, {.factors = AveragingFactors::given({row.m}), .alpha = row.alpha}).points.at(0).interval;
    // Stable32's quantiles are approximate; its degrees of freedom at m = 1 are 0.783 n, exactly it is 2 n/3.
    const double tolerance = row.m == 1 && row.alpha == 0 ? 3e-3 : 5e-4;
    CHECK_THAT(interval.lower, WithinRel(row.lower, tolerance));
    CHECK_THAT(interval.upper, WithinRel(row.upper, tolerance));
  }
}

}  // namespace

TEST_CASE("Curves of phases are those of Stable32", "[.real_data]") {
  const std::string folder = "stable32_phase_dat/";
  const auto phase = stable32_numbers(folder + "PHASE.DAT");
  REQUIRE(phase.size() == 1001);
  const auto signal = IntegratedSignal<double>::from_integral(phase, 1.0);
  check_table<AllanDeviation>(signal, folder + "phase_dat_adev_octave.txt");
  check_table<OverlappingAllanDeviation>(signal, folder + "phase_dat_oadev.txt");
  check_table<OverlappingAllanDeviation>(signal, folder + "phase_dat_oadev_octave.txt");
  check_table<ModifiedAllanDeviation>(signal, folder + "phase_dat_mdev.txt");
  check_table<ModifiedAllanDeviation>(signal, folder + "phase_dat_mdev_octave.txt");
  check_table<TimeDeviation>(signal, folder + "phase_dat_tdev_octave.txt");
  check_table<HadamardDeviation>(signal, folder + "phase_dat_hdev_octave.txt");
  check_table<OverlappingHadamardDeviation>(signal, folder + "phase_dat_ohdev.txt");
  check_table<OverlappingHadamardDeviation>(signal, folder + "phase_dat_ohdev_octave.txt");
  check_table<TotalDeviation>(signal, folder + "phase_dat_totdev.txt");
  check_table<TotalDeviation>(signal, folder + "phase_dat_totdev_octave.txt");
}

TEST_CASE("Curves of rates are those of Stable32", "[.real_data]") {
  const std::string folder = "stable32_pink/";
  const auto rates = stable32_numbers(folder + "pink_frequency.txt");
  REQUIRE(rates.size() == 10'000);
  const IntegratedSignal signal(rates, 1.0 / 42);
  check_table<AllanDeviation>(signal, folder + "adev.txt");
  check_table<OverlappingAllanDeviation>(signal, folder + "oadev.txt");
  check_table<OverlappingAllanDeviation>(signal, folder + "s32_oadev_octave.txt");
  check_table<ModifiedAllanDeviation>(signal, folder + "mdev.txt");
  check_table<TimeDeviation>(signal, folder + "tdev.txt");
  check_table<HadamardDeviation>(signal, folder + "hdev.txt");
  check_table<OverlappingHadamardDeviation>(signal, folder + "ohdev.txt");
  check_table<TotalDeviation>(signal, folder + "totdev_alpha0.txt", true);
}

TEMPLATE_TEST_CASE("What a curve says", "", double, long double) {
  using Scalar = TestType;
  const auto y = scaled(noisy_integers(10'000, 9810, 5, 0.02), Scalar(1) / 1000);
  const auto result = overlapping(y, 200);
  STATIC_CHECK(std::same_as<decltype(result), const DeviationCurve<Scalar>>);
  const IntegratedSignal<Scalar> signal(y, 200);
  CHECK(result.name == "oadev");
  CHECK(result.rate == 200);
  CHECK(result.samples == 10'000);
  CHECK(result.mean == signal.mean());
  CHECK(result.confidence == one_sigma<Scalar>);
  const auto factors = AveragingFactors::logarithmic().up_to(5000);
  const auto values = deviations<OverlappingAllanDeviation>(signal, factors);
  REQUIRE(result.points.size() == factors.size());
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto& point = result.points[i];
    CHECK(point.factor == factors[i]);
    CHECK(point.tau == static_cast<Scalar>(factors[i]) / 200);
    CHECK(point.terms == 10'001 - 2 * factors[i]);
    CHECK(point.deviation == values[i]);
    CHECK(point.alpha == noise_type(signal, factors[i]));
    CHECK(point.degrees_of_freedom >= 1);
    CHECK(point.degrees_of_freedom <= static_cast<Scalar>(point.terms));
    CHECK(point.interval.lower < point.deviation);
    CHECK(point.interval.upper > point.deviation);
  }
}

TEST_CASE("Options of a curve") {
  const auto y = scaled(noisy_integers(3000, 0, 100, 0), 1.0);
  const auto usual = overlapping(y, 200.0);
  const auto wide = overlapping(y, 200.0, {.factors = AveragingFactors::octave(), .confidence = two_sigma<double>});
  CHECK(wide.points.size() == 11);
  CHECK(wide.confidence == two_sigma<double>);
  CHECK(wide.points[0].interval.lower < usual.points[0].interval.lower);
  const auto walk = overlapping(y, 200.0, {.alpha = -2, .phase_model = PhaseModel::sampled});
  CHECK(walk.points[0].alpha == -2);
  CHECK_THAT(walk.points[0].degrees_of_freedom, WithinRel(2999.0, 1e-12));
  const auto white = overlapping(y, 200.0, {.alpha = 0, .phase_model = PhaseModel::sampled});
  CHECK_THAT(white.points[0].degrees_of_freedom, WithinRel(2999 / (1.5 - 0.5 / 2999), 1e-12));
}

TEST_CASE("Degrees of freedom of the total deviation") {
  const IntegratedSignal<double> signal(scaled(noisy_integers(300, 0, 100, 0), 1.0), 200.0);
  for (int alpha = -4; alpha <= 2; ++alpha) {
    for (PhaseModel model : {PhaseModel::sampled, PhaseModel::greenhall_riley}) {
      const auto result = curve<TotalDeviation>(signal, {.alpha = alpha, .phase_model = model});
      for (const auto& point : result.points) {
        INFO("alpha " << alpha << ", m " << point.factor);
        CHECK(point.degrees_of_freedom == total_degrees_of_freedom(alpha, point.factor, 300, model));
      }
    }
  }
}

TEST_CASE("Curves of floats, integers, columns and Eigen's vectors are those of double") {
  const Integers integers = noisy_integers(500, 100, 20, 0);
  const auto expected = overlapping(scaled(integers, 1.0), 100.0);
  Eigen::MatrixX3d log(500, 3);
  log.setOnes();
  for (Eigen::Index i = 0; i < 500; ++i) log(i, 2) = static_cast<double>(integers[static_cast<std::size_t>(i)]);
  const auto same = [&](const auto& result) {
    REQUIRE(result.points.size() == expected.points.size());
    for (std::size_t i = 0; i < expected.points.size(); ++i) {
      CHECK(result.points[i].deviation == expected.points[i].deviation);
    }
  };
  same(overlapping(integers, 100));
  same(overlapping(scaled(integers, 1.0f), 100));
  same(overlapping(log.col(2), 100));
  same(overlapping(Eigen::VectorXf(log.col(2).cast<float>()), 100));
  same(curve<OverlappingAllanDeviation>(IntegratedSignal(integers, 100.0)));
}

TEST_CASE("Curves of extreme signals have no NaN") {
  const std::size_t n = 200;
  std::vector<double> huge(n), tiny(n), turns(n), still(n, 1.0), drift(n), cubic(n);
  const Integers integers = noisy_integers(n, 0, 100, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto y = static_cast<double>(integers[i]), t = static_cast<double>(i);
    huge[i] = y * 1e297;
    tiny[i] = y * 1e-323;
    turns[i] = i % 2 == 0 ? 1 : -1;
    drift[i] = t + 1e-3 * y;
    cubic[i] = t * t * t;
  }
  still.back() = 2;
  const std::vector<double> shortest{1, 2, 4};
  for (const auto& signal : {huge, tiny, turns, still, drift, cubic, shortest}) {
    for_each_deviation([&]<typename D>() {
      for (const auto& point : curve<D>(signal, 200.0, {.factors = AveragingFactors::all()}).points) {
        const bool good = point.deviation >= 0 && point.interval.lower >= 0 && point.degrees_of_freedom >= 1 &&
                          point.interval.upper >= point.interval.lower && std::isfinite(point.interval.upper);
        if (!good) FAIL_CHECK(D::name << " at m = " << point.factor << ": " << point.deviation);
      }
    });
  }
  CHECK(overlapping(shortest, 1.0).points.size() == 1);
}

TEST_CASE("Noise steeper than a deviation converges for has the degrees of the steepest it does") {
  std::vector<double> y(1000);
  const Integers integers = noisy_integers(1000, 0, 100, 0);
  double walk = 0, sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = sum += walk += static_cast<double>(integers[i]);
  const auto allan = overlapping(y, 1.0);
  const auto hadamard = curve<OverlappingHadamardDeviation>(y, 1.0);
  CHECK(allan.points[0].alpha == -4);
  CHECK(hadamard.points[0].alpha == -4);
  const auto as_walk = overlapping(y, 1.0, {.alpha = -2});
  CHECK(allan.points[0].degrees_of_freedom == as_walk.points[0].degrees_of_freedom);
  CHECK(curve<OverlappingHadamardDeviation>(y, 1.0, {.alpha = -4}).points[0].degrees_of_freedom ==
        hadamard.points[0].degrees_of_freedom);
  CHECK_THROWS_AS(overlapping(y, 1.0, {.alpha = -3}), std::invalid_argument);
}

TEST_CASE("Curves that cannot be are refused") {
  const std::vector<double> y{1, 2, 4, 3, 5};
  const auto refusal = [&](const DeviationOptions<double>& options) {
    return message_of([&] { return overlapping(y, 1.0, options); });
  };
  CHECK(refusal({.factors = AveragingFactors::given({3})}) ==
        "Allan analysis: averaging factor 3 is outside the data, expected 1 to 2");
  CHECK(refusal({.factors = AveragingFactors::given({0})}) ==
        "Allan analysis: averaging factor 0 is outside the data, expected 1 to 2");
  CHECK(refusal({.factors = AveragingFactors::taus({3.0}, 1.0)}) ==
        "Allan analysis: averaging factor 3 is outside the data, expected 1 to 2");
  CHECK(refusal({.confidence = 0.0}) == "deviation_interval: confidence is 0, expected a number between 0 and 1");
  CHECK(refusal({.confidence = 1.0}) == "deviation_interval: confidence is 1, expected a number between 0 and 1");
  CHECK(refusal({.confidence = std::numeric_limits<double>::quiet_NaN()}) ==
        "deviation_interval: confidence is nan, expected a number between 0 and 1");
  CHECK(message_of([&] { return overlapping(y, 0.0); }) == "Allan analysis: rate is 0, expected a finite number > 0");
  CHECK(message_of([&] { return overlapping(std::vector<float>(9, 1.5f), 200); }) ==
        "Allan analysis: the signal is constant (1.5): a sensor that is stuck, or no noise at all");
  CHECK_THROWS_AS(overlapping(std::vector<double>{1, 2}, 1.0), std::invalid_argument);
}
