// SPDX-License-Identifier: MIT
// Real data: allan/stable32_phase_dat allan/stable32_pink
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/degrees_of_freedom.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;

namespace {

using namespace splinertia::detail;

using Count = std::int64_t;

/// M²/Σ ρ²: (tr C)²/tr C² of the M×M covariance matrix C, from its row of correlations.
double exact_degrees(const std::vector<double>& correlation, Count terms) {
  const auto rho = [&](Count l) {
    const auto i = static_cast<std::size_t>(l);
    return i < correlation.size() ? correlation[i] : 0.0;
  };
  double sum = 0;
  for (Count i = 0; i < terms; ++i) {
    for (Count j = 0; j < terms; ++j) sum += rho(std::abs(i - j)) * rho(std::abs(i - j));
  }
  return static_cast<double>(terms) * static_cast<double>(terms) / sum;
}

/// The correlations of differences from how they weigh the independent numbers w that the phase is made of: itself
/// (alpha = 2), its increments (0), their increments (−2).
std::vector<double> correlations_from_weights(DifferenceShape shape, int alpha, Count m, Count stride) {
  const auto step = static_cast<std::size_t>(m);
  const auto span = step * static_cast<std::size_t>(shape.differences + (shape.modified ? 1 : 0)) + 2;
  std::vector<double> weights(span, 0);
  weights[0] = 1;
  for (int sums = (2 - alpha) / 2; sums > 0; --sums) {
    for (std::size_t i = 1; i < span; ++i) weights[i] += weights[i - 1];
  }
  for (int d = 0; d < shape.differences; ++d) {
    for (std::size_t i = span; i-- > step;) weights[i] -= weights[i - step];
  }
  if (shape.modified) {
    std::vector<double> means(span, 0);
    for (std::size_t i = 0; i < span; ++i) {
      for (std::size_t j = 0; j < std::min(step, i + 1); ++j) means[i] += weights[i - j];
    }
    weights = means;
  }
  std::vector<double> correlations;
  for (std::size_t lag = 0; lag < span; lag += static_cast<std::size_t>(stride)) {
    double sum = 0;
    for (std::size_t i = lag; i < span; ++i) sum += weights[i] * weights[i - lag];
    correlations.push_back(sum);
  }
  const double variance = correlations[0];
  for (double& c : correlations) c /= variance;
  return correlations;
}

/// The same from the spectral density of the phase, |2 sin πf|^(alpha − 2): sums over frequencies between 0 and 1/2.
std::vector<double> correlations_from_spectrum(DifferenceShape shape, int alpha, Count m, Count stride, Count terms) {
  constexpr int frequencies = 1 << 12;
  const double pi = std::acos(-1.0);
  std::vector<double> correlations(static_cast<std::size_t>(terms), 0);
  for (int i = 0; i < frequencies; ++i) {
    const double f = (i + 0.5) / (2.0 * frequencies), single = std::abs(2 * std::sin(pi * f)),
                 step = std::abs(2 * std::sin(pi * f * static_cast<double>(m)));
    double power = std::pow(step, 2 * shape.differences) * std::pow(single, alpha - 2);
    if (shape.modified) power *= (step / single) * (step / single);
    for (std::size_t l = 0; l < correlations.size(); ++l) {
      correlations[l] += power * std::cos(2 * pi * f * static_cast<double>(l) * static_cast<double>(stride));
    }
  }
  const double variance = correlations[0];
  for (double& c : correlations) c /= variance;
  return correlations;
}

std::vector<int> alphas(DifferenceShape shape) {
  std::vector<int> result;
  for (int alpha = -4; alpha <= 2; ++alpha) {
    if (alpha + 2 * shape.differences > 1) result.push_back(alpha);
  }
  return result;
}

constexpr DifferenceShape shapes[] = {{1, false}, {1, true}, {2, false}, {2, true}, {3, false}, {3, true}};

}  // namespace

TEST_CASE("Degrees of freedom of sums of independent numbers are those of their covariance matrix") {
  for (DifferenceShape shape : shapes) {
    for (int alpha : alphas(shape)) {
      if (alpha % 2 != 0) continue;
      for (Count m : {1, 2, 3, 4, 7, 16, 100, 500}) {
        for (Count stride : {Count(1), m / 16, m / 3, m, 2 * m}) {
          if (stride < 1) continue;
          const auto correlations = correlations_from_weights(shape, alpha, m, stride);
          for (Count terms : {1, 2, 3, 10, 61, 300, 1000}) {
            INFO(shape.differences << (shape.modified ? " modified" : "") << " differences, alpha " << alpha << ", m "
                                   << m << ", stride " << stride << ", terms " << terms);
            // Short sums are exact; long ones are integrals between their first and last terms.
            const double tolerance = m / stride < 30 ? 1e-9 : 1e-4;
            CHECK_THAT(equivalent_degrees_of_freedom(shape, alpha, m, terms, stride),
                       WithinRel(exact_degrees(correlations, terms), tolerance));
          }
        }
      }
    }
  }
}

TEST_CASE("Degrees of freedom of fractional noise are those of its spectrum") {
  for (DifferenceShape shape : shapes) {
    for (int alpha : alphas(shape)) {
      for (Count m : {1, 2, 5, 16}) {
        for (Count stride : {Count(1), m}) {
          const Count terms = 40;
          const auto correlations = correlations_from_spectrum(shape, alpha, m, stride, terms);
          INFO(shape.differences << (shape.modified ? " modified" : "") << " differences, alpha " << alpha << ", m "
                                 << m << ", stride " << stride);
          // The sum over frequencies misses 1e-8; lags beyond 16 steps, left out here, add 2e-5.
          CHECK_THAT(equivalent_degrees_of_freedom(shape, alpha, m, terms, stride),
                     WithinRel(exact_degrees(correlations, terms), 3e-5));
        }
      }
    }
  }
}

TEST_CASE("Known degrees of freedom") {
  // White rates without overlap, m = 1: correlation −1/2 with the next, edf = M/(3/2 − 1/2M). A random walk of the rate
  // at m = 1: the differences are independent.
  CHECK_THAT(equivalent_degrees_of_freedom({}, 0, 1, 999), WithinRel(999 / (1.5 - 0.5 / 999), 1e-14));
  CHECK_THAT(equivalent_degrees_of_freedom({}, -2, 1, 999), WithinRel(999.0, 1e-14));
  CHECK_THAT(equivalent_degrees_of_freedom({1, false}, 0, 1, 999), WithinRel(999.0, 1e-14));
  // Greenhall and Riley's model of white phase noise is this one; means of a random walk are correlated more.
  CHECK_THAT(equivalent_degrees_of_freedom({}, 2, 5, 99, 1, PhaseModel::greenhall_riley),
             WithinRel(equivalent_degrees_of_freedom({}, 2, 5, 99), 1e-12));
  CHECK_THAT(equivalent_degrees_of_freedom({}, 0, 1, 999, 1, PhaseModel::greenhall_riley) / 999,
             WithinAbs(0.783, 5e-4));
  for (DifferenceShape shape : shapes) CHECK(equivalent_degrees_of_freedom(shape, 0, 1000, 1) == 1);
}

TEST_CASE("Greenhall and Riley's tables of many overlapping terms") {
  // PTTI 2003, tables 1 (modified) and 2: 1/edf = (a0 − a1/r)/r, r = terms/m, for r >= differences + 1. Fractions and
  // three digits. Those of odd alpha leave out lags beyond differences + 1 steps, which adds up to 2 %: see above for
  // the exact values of these. Table 2 for alpha = 2 has terms for r: with m at most 16.
  struct Row {
    DifferenceShape shape;
    int alpha;
    double a0, a1, tolerance;
  };
  constexpr Row rows[] = {
      {{1, true}, 2, 2.0 / 3, 1.0 / 3, 1e-4},   {{2, true}, 2, 7.0 / 9, 1.0 / 2, 1e-4},
      {{3, true}, 2, 22.0 / 25, 2.0 / 3, 1e-4}, {{1, true}, 0, 1.079, 0.368, 1e-3},
      {{2, true}, 0, 1.033, 0.607, 1e-3},       {{3, true}, 0, 1.184, 0.848, 1e-3},
      {{2, true}, -2, 1.302, 0.535, 1e-3},      {{3, true}, -2, 1.175, 0.777, 1e-3},
      {{3, true}, -4, 1.489, 0.702, 1e-3},      {{1, false}, 0, 2.0 / 3, 1.0 / 6, 1e-4},
      {{2, false}, 0, 2.0 / 3, 1.0 / 3, 1e-4},  {{3, false}, 0, 7.0 / 9, 1.0 / 2, 1e-4},
      {{2, false}, -2, 1.079, 0.368, 1e-3},     {{3, false}, -2, 1.033, 0.607, 1e-3},
      {{3, false}, -4, 1.302, 0.535, 1e-3},     {{1, true}, 1, 0.840, 0.345, 2e-2},
      {{2, true}, 1, 0.997, 0.616, 2e-3},       {{3, true}, 1, 1.141, 0.843, 2e-3},
      {{2, true}, -1, 1.048, 0.534, 1e-2},      {{3, true}, -1, 1.180, 0.816, 2e-3},
      {{3, true}, -3, 1.194, 0.703, 1e-2},      {{2, false}, -1, 0.852, 0.375, 1e-2},
      {{3, false}, -1, 0.997, 0.617, 2e-3},     {{3, false}, -3, 1.053, 0.553, 1e-2},
  };
  for (const Row& row : rows) {
    for (double m : {1e4, 1e9}) {
      for (double r : {4.0, 10.0, 1e5}) {
        INFO(row.shape.differences << (row.shape.modified ? " modified" : "") << " differences, alpha " << row.alpha
                                   << ", m " << m << ", r " << r);
        const double degrees =
            equivalent_degrees_of_freedom(row.shape, row.alpha, static_cast<Count>(m), static_cast<Count>(r * m));
        CHECK_THAT(degrees, WithinRel(r / (row.a0 - row.a1 / r), row.tolerance));
      }
    }
  }
  const double binomials[] = {3.0 / 2, 35.0 / 18, 231.0 / 100};  // table 2, alpha = 2: edf of r >> 1 is M/a0
  for (int d = 1; d <= 3; ++d) {
    CHECK_THAT(equivalent_degrees_of_freedom({d, false}, 2, 1'000'000, 1'000'000'000'000),
               WithinRel(1e12 / binomials[d - 1], 1e-5));
  }
}

TEST_CASE("The scatter of simulated deviations is that of their degrees of freedom") {
  struct Trial {
    DifferenceShape shape;
    int alpha;
    Count m;
  };
  // 4000 trials give the variance, and so the degrees of freedom, within 2.5 % (one standard error; the seed is fixed).
  // The last, m = 4, has 29.2 degrees here and 25.8 in Greenhall and Riley's model.
  for (const Trial& trial : {Trial{{2, false}, 0, 1}, Trial{{2, true}, 0, 4}, Trial{{3, false}, -2, 3},
                             Trial{{2, false}, -2, 2}, Trial{{1, false}, 0, 6}, Trial{{2, false}, 0, 4}}) {
    constexpr Count points = 90;
    const Count m = trial.m, terms = number_of_terms(trial.shape, m, points);
    std::mt19937_64 bits(7);
    std::normal_distribution<double> normal;
    double sum = 0, squares = 0;
    constexpr int trials = 4000;
    for (int i = 0; i < trials; ++i) {
      std::vector<double> x(points, 0);
      double rate = 0;
      for (std::size_t k = 1; k < points; ++k) {
        rate = trial.alpha == 0 ? normal(bits) : rate + normal(bits);
        x[k] = x[k - 1] + rate;
      }
      const auto step = static_cast<std::size_t>(m);
      for (int d = 0; d < trial.shape.differences; ++d) {
        for (std::size_t k = 0; k + step < x.size(); ++k) x[k] = x[k + step] - x[k];
        x.resize(x.size() - step);
      }
      double variance = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(terms); ++k) {
        double z = 0;
        for (std::size_t j = 0; j < (trial.shape.modified ? step : 1); ++j) z += x[k + j];
        variance += z * z;
      }
      sum += variance;
      squares += variance * variance;
    }
    const double mean = sum / trials, simulated = 2 * mean * mean / (squares / trials - mean * mean);
    INFO(trial.shape.differences << (trial.shape.modified ? " modified" : "") << " differences, alpha " << trial.alpha
                                 << ", m " << m);
    CHECK_THAT(equivalent_degrees_of_freedom(trial.shape, trial.alpha, m, terms), WithinRel(simulated, 0.07));
  }
}

TEST_CASE("Degrees of freedom are at least 1 and at most the number of terms") {
  for (DifferenceShape shape : shapes) {
    for (int alpha : alphas(shape)) {
      for (Count m :
           {1LL, 2LL, 15LL, 16LL, 33LL, 1000LL, 10'001LL, 100'001LL, 1'000'000'000LL, 1'000'000'000'000'000LL}) {
        for (Count stride : {Count(1), m / 16, m, 3 * m}) {
          for (Count terms : {1LL, 2LL, 20LL, 400LL, 1'000'000'000LL, 1'000'000'000'000'000LL}) {
            for (PhaseModel model : {PhaseModel::sampled, PhaseModel::greenhall_riley}) {
              if (stride < 1) continue;
              const double degrees = equivalent_degrees_of_freedom(shape, alpha, m, terms, stride, model);
              if (degrees >= 1 && degrees <= static_cast<double>(terms)) continue;
              CAPTURE(shape.differences, shape.modified, alpha, m, stride, terms, degrees);
              FAIL_CHECK("not in [1, terms]");
            }
          }
        }
      }
      // Every sixteenth of m has nearly all that all terms have, and the sum changes little with m when that is large.
      const double all = equivalent_degrees_of_freedom(shape, alpha, 160'000, 1'600'000);
      if (alpha < (shape.modified ? 2 : 1)) {
        CHECK_THAT(equivalent_degrees_of_freedom(shape, alpha, 160'000, 160, 10'000), WithinRel(all, 0.02));
        CHECK_THAT(equivalent_degrees_of_freedom(shape, alpha, 1'600'000, 16'000'000), WithinRel(all, 1e-4));
      }
    }
  }
}

TEST_CASE("The number of terms") {
  CHECK(number_of_terms({2, false}, 1, 1001) == 999);
  CHECK(number_of_terms({2, false}, 128, 1001) == 745);
  CHECK(number_of_terms({2, false}, 128, 1001, 128) == 6);
  CHECK(number_of_terms({2, true}, 128, 1001) == 618);
  CHECK(number_of_terms({3, false}, 128, 1001) == 617);
  CHECK(number_of_terms({3, false}, 128, 1001, 128) == 5);
  CHECK(number_of_terms({2, false}, 5, 11) == 1);
  CHECK(number_of_terms({2, false}, 5, 10) == 0);
  CHECK(number_of_terms({2, true}, 5, 15) == 1);
  CHECK(number_of_terms({2, true}, 5, 14) == 0);
  CHECK(number_of_terms({2, true}, 1, 0) == 0);
  CHECK(number_of_terms({3, true}, std::numeric_limits<Count>::max(), std::numeric_limits<Count>::max()) == 0);
}

TEST_CASE("Intervals are those of Stable32", "[.real_data]") {
  const std::string folder = SPLINERTIA_TEST_DATA "/allan/";
  const auto rows = [&](const std::string& file, const auto& check) {
    std::ifstream input(folder + file);
    REQUIRE(input);
    int count = 0;
    for (std::string line; std::getline(input, line);) {
      std::istringstream numbers(line);
      Count m = 0, terms = 0;
      int alpha = 0;
      double tau = 0, lower = 0, sigma = 0, upper = 0;
      if (!(numbers >> m >> tau >> terms >> alpha >> lower >> sigma >> upper) || lower == 0) continue;
      INFO(file << ", m = " << m << ", alpha = " << alpha);
      check(m, terms, alpha, lower, sigma, upper);
      ++count;
    }
    CHECK(count >= 8);
  };
  const auto compare = [](double degrees, double lower, double sigma, double upper, double tolerance) {
    const auto interval = deviation_interval(sigma, degrees);
    CHECK_THAT(interval.lower, WithinRel(lower, tolerance));
    CHECK_THAT(interval.upper, WithinRel(upper, tolerance));
  };
  for (const auto& [file, shape, overlapping, points] :
       {std::tuple{"stable32_phase_dat/phase_dat_adev_octave.txt", DifferenceShape{2, false}, false, 1001},
        std::tuple{"stable32_phase_dat/phase_dat_hdev_octave.txt", DifferenceShape{3, false}, false, 1001},
        std::tuple{"stable32_phase_dat/phase_dat_oadev_octave.txt", DifferenceShape{2, false}, true, 1001},
        std::tuple{"stable32_phase_dat/phase_dat_mdev_octave.txt", DifferenceShape{2, true}, true, 1001},
        std::tuple{"stable32_phase_dat/phase_dat_tdev_octave.txt", DifferenceShape{2, true}, true, 1001},
        std::tuple{"stable32_phase_dat/phase_dat_ohdev_octave.txt", DifferenceShape{3, false}, true, 1001},
        std::tuple{"stable32_pink/s32_oadev_octave.txt", DifferenceShape{2, false}, true, 10001}}) {
    rows(file, [&, differences = shape, overlap = overlapping, count = points](
                   Count m, Count terms, int alpha, double lower, double sigma, double upper) {
      const Count stride = overlap ? 1 : m;
      CHECK(number_of_terms(differences, m, count, stride) == terms);
      compare(equivalent_degrees_of_freedom(differences, alpha, m, terms, stride, PhaseModel::greenhall_riley), lower,
              sigma, upper, 5e-4);
      // That the phase is sampled and not averaged changes the interval's ends by up to 0.3 % of the deviation.
      compare(equivalent_degrees_of_freedom(differences, alpha, m, terms, stride), lower, sigma, upper, 3e-3);
    });
  }
}

TEST_CASE("What has no degrees of freedom is refused") {
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({0, false}, 0, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({4, false}, 0, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({2, false}, 3, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({3, false}, -5, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({2, true}, -3, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({1, false}, -1, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({2, false}, 0, 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({2, false}, 0, 1'000'000'000'000'001, 1), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({2, false}, 0, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(equivalent_degrees_of_freedom({2, false}, 0, 1, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(number_of_terms({0, false}, 1, 10), std::invalid_argument);
  CHECK_THROWS_AS(number_of_terms({2, false}, 0, 10), std::invalid_argument);
  CHECK_THROWS_AS(number_of_terms({2, false}, 1, 10, 0), std::invalid_argument);
}
