// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <splinertia/allan/detail/model/spectral_fit.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <vector>

#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Fit = SpectralFit<double>;
using Fixed = Fit::Fixed;
using Vector = Fit::Vector;
constexpr NoiseTerms white_and_walk{NoiseTerm::white, NoiseTerm::random_walk};

DifferenceSpectrum<double> spectrum_of(const std::vector<double>& y, double rate = 1) {
  return DifferenceSpectrum<double>(IntegratedSignal<double>(y, rate));
}

/// A fit with the spectrum that it reads.
struct OwnedFit {
  std::unique_ptr<PooledSpectrum<double>> pooled;
  Fit fit;
};

OwnedFit fit_of(std::span<const DifferenceSpectrum<double>> spectra, double most_count = 1e300) {
  auto pooled = std::make_unique<PooledSpectrum<double>>(spectra);
  const std::vector<bool> all(pooled->bins().size(), true);
  Fit fit(*pooled, all, most_count);
  return {std::move(pooled), std::move(fit)};
}

OwnedFit fit_of(const DifferenceSpectrum<double>& spectrum) { return fit_of(std::span(&spectrum, 1)); }

/// −2·log-likelihood of Gaussian differences with this covariance, and of the best slope of a ramp if there is one.
double dense_objective(const std::vector<double>& y, double white, double walk, bool ramp = false) {
  const auto n = std::ssize(y) - 1;
  Eigen::MatrixXd covariance = (walk + 2 * white) * Eigen::MatrixXd::Identity(n, n);
  covariance.diagonal(1).setConstant(-white);
  covariance.diagonal(-1).setConstant(-white);
  Eigen::VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    d[i] = y[static_cast<std::size_t>(i) + 1] - y[static_cast<std::size_t>(i)];
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  const Eigen::VectorXd ones = factor.matrixL().solve(Eigen::VectorXd::Ones(n));
  Eigen::VectorXd whitened = factor.matrixL().solve(d);
  if (ramp) whitened -= ones * (ones.dot(whitened) / ones.squaredNorm());
  return whitened.squaredNorm() + 2 * factor.matrixLLT().diagonal().array().log().sum();
}

/// −2·log-likelihood from a spectrum alone, at any θ.
double objective_of(const DifferenceSpectrum<double>& spectrum, const Vector& theta) {
  double sum = 0;
  for (const auto& bin : spectrum.bins()) {
    const double expected = Eigen::Map<const Eigen::Vector4d>(bin.basis.data()).dot(theta.head<4>());
    sum += bin.count * std::log(expected) + bin.power / expected;
  }
  return sum;
}

/// The objective with both coefficients held: white by the set of terms, the walk by Fixed, at its best white.
double profile(const Fit& fit, double walk, Vector* theta = nullptr, NoiseTerms terms = white_and_walk) {
  const auto result = fit.maximise(terms, {}, Fixed{NoiseTerm::random_walk, walk});
  if (theta != nullptr) *theta = result.theta;
  return result.objective;
}

}  // namespace

TEST_CASE("The objective is the likelihood of the differences, but for a constant") {
  for (const double walk : {0.0, 1e-3, 0.1, 3.0}) {
    const auto y = simulated({.n = 61, .white = 1, .walk = walk, .ramp = 0.02, .seed = 11});
    const auto spectrum = spectrum_of(y);
    const auto [owned, fit] = fit_of(spectrum);
    const double unit = fit.spectrum().unit() * fit.spectrum().unit();
    CHECK(fit.groups() == 60);
    for (const bool ramp : {false, true}) {
      const NoiseTerms terms = ramp ? white_and_walk.with(NoiseTerm::rate_ramp) : white_and_walk;
      std::vector<double> offsets;
      for (const double held : {0.0, 1e-4, 0.01, 0.2, 5.0}) {
        // The most likely white noise is the library's choice; the likelihood at it is that of the definition.
        Vector theta;
        const double objective = profile(fit, held / unit, &theta, terms);
        CHECK(theta[1] == held / unit);
        CHECK(theta[2] == 0);
        CHECK(theta[3] == 0);
        offsets.push_back(objective - dense_objective(y, theta[0] * unit, held, ramp));
      }
      for (const double offset : offsets) CHECK_THAT(offset, WithinAbs(offsets[0], 1e-9));
    }
  }
}

TEST_CASE("The most likely coefficients are those of a brute-force search") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const auto y = simulated({.n = 64, .white = 1, .walk = 0.3, .seed = seed});
    const auto spectrum = spectrum_of(y);
    const auto [owned, fit] = fit_of(spectrum);
    const auto best = fit.maximise(white_and_walk);
    // Over 12 decades of the ratio; for each, the best common factor is known.
    double least = std::numeric_limits<double>::max(), least_ratio = 0;
    for (int i = 0; i <= 12'000; ++i) {
      const double ratio = i == 0 ? 0 : std::pow(10.0, i * 1e-3 - 9);
      double logs = 0, power = 0, count = 0;
      for (const auto& bin : spectrum.bins()) {
        const double shape = bin.basis[0] + ratio;
        logs += bin.count * std::log(shape);
        power += bin.power / shape;
        count += bin.count;
      }
      const double objective = logs + count * std::log(power / count) + count;
      if (objective < least) {
        least = objective;
        least_ratio = ratio;
      }
    }
    CHECK(best.objective <= least + 1e-9);
    CHECK_THAT(best.theta[1], WithinAbs(best.theta[0] * least_ratio, best.theta[0] * (least_ratio * 3e-3 + 1e-12)));
  }
}

TEST_CASE("At the maximum the gradient is zero, or positive where a term is") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const auto y = simulated({.n = 64,  // bins of their own
                              .white = 1,
                              .walk = 0.2,
                              .quantization = seed % 2 == 0 ? 1.0 : 0.0,
                              .ramp = seed % 3 == 0 ? 0.1 : 0.0,
                              .seed = seed});
    const auto spectrum = spectrum_of(y);
    const auto [owned, fit] = fit_of(spectrum);
    for (unsigned set = 1; set < 16; ++set) {
      INFO("seed " << seed << ", terms " << set);
      const NoiseTerms terms = NoiseTerms::numbered(set);
      const auto best = fit.maximise(terms);
      CHECK_THAT(best.objective, WithinRel(objective_of(spectrum, best.theta), 1e-12));
      for (int j = 0; j < PooledSpectrum<double>::powers; ++j) {
        if (!terms.has(static_cast<NoiseTerm>(j))) {
          CHECK(best.theta[j] == 0);
          continue;
        }
        // Per relative change of θ and, where θ is zero, in units of its standard error.
        double gradient = 0, information = 0;
        for (const auto& bin : spectrum.bins()) {
          const double expected = Eigen::Map<const Eigen::Vector4d>(bin.basis.data()).dot(best.theta.head<4>());
          const double basis = bin.basis[static_cast<std::size_t>(j)] / expected;
          gradient += basis * (bin.count - bin.power / expected);
          information += basis * basis * bin.count / 2;
        }
        const double scaled = gradient / std::sqrt(information);
        CHECK(scaled > -1e-3);
        if (best.theta[j] > 0) CHECK(scaled < 1e-3);
      }
    }
  }
}

TEST_CASE("More terms are never less likely") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto spectrum =
        spectrum_of(simulated({.n = 800, .white = 1, .walk = 0.1, .quantization = 0.5, .seed = seed}));
    const auto [owned, fit] = fit_of(spectrum);
    constexpr unsigned sets = 64;  // of all but the warm-up, which takes the place of the ramp
    const Fit::Times times{.correlation = 40};
    std::vector<double> objectives(sets);
    for (unsigned set = 1; set < sets; ++set) {
      objectives[set] = fit.maximise(NoiseTerms::numbered(set), times).objective;
    }
    for (unsigned set = 1; set < sets; ++set) {
      for (unsigned more = set; more < sets; ++more) {
        if (set == 16 || !NoiseTerms::numbered(set).within(NoiseTerms::numbered(more))) continue;
        INFO("terms " << set << " of " << more);
        CHECK(objectives[more] <= objectives[set] + 1e-6);
      }
    }
  }
}

TEST_CASE("The profile of a likelihood rises to both sides of its maximum") {
  const auto spectrum = spectrum_of(simulated({.n = 3000, .white = 1, .walk = 0.03, .ramp = 1e-4, .seed = 5}));
  const auto [owned, fit] = fit_of(spectrum);
  for (const unsigned set : {3U, 7U, 15U, 31U, 19U}) {
    const NoiseTerms terms = NoiseTerms::numbered(set);
    const auto best = fit.maximise(terms);
    for (int j = 0; j < PooledSpectrum<double>::powers; ++j) {
      const auto term = static_cast<NoiseTerm>(j);
      if (!terms.has(term)) continue;
      INFO(symbol(term) << " of terms " << set);
      const double scale = std::max(best.theta[j], best.theta.maxCoeff() * 1e-6);
      double before = best.objective;
      for (const double factor : {1.01, 1.1, 2.0, 10.0, 1e3, 1e6}) {
        const double objective = fit.maximise(terms, {}, Fixed{term, best.theta[j] + scale * (factor - 1)}).objective;
        CHECK(objective >= before - 1e-6);
        before = objective;
      }
      before = best.objective;
      for (const double factor : {0.99, 0.9, 0.5, 0.1, 0.0}) {
        const double objective = fit.maximise(terms, {}, Fixed{term, best.theta[j] * factor}).objective;
        CHECK(objective >= before - 1e-6);
        before = objective;
      }
    }
  }
}

TEST_CASE("A start changes the way to the maximum, not the maximum") {
  const auto spectrum = spectrum_of(simulated({.n = 2000, .white = 1, .walk = 0.05, .seed = 8}));
  const auto [owned, fit] = fit_of(spectrum);
  const auto best = fit.maximise(white_and_walk);
  for (const double white : {1e-4, 1.0, 1e4}) {
    for (const double walk : {1e-4, 1.0, 1e4}) {
      Vector start = Vector::Zero();
      start.head<2>() << best.theta[0] * white, best.theta[1] * walk;
      const auto other = fit.maximise(white_and_walk, {}, {}, &start);
      CHECK_THAT(other.objective, WithinAbs(best.objective, 1e-6));
      CHECK_THAT(other.theta[1], WithinRel(best.theta[1], 1e-3));
    }
  }
}

TEST_CASE("The slope of a ramp is that of weighted least squares") {
  const auto y = simulated({.n = 64, .white = 1, .walk = 0.1, .ramp = 0.3, .seed = 21});
  const auto spectrum = spectrum_of(y, 50);
  const auto [owned, fit] = fit_of(spectrum);
  const auto best = fit.maximise(white_and_walk.with(NoiseTerm::rate_ramp));
  const double unit = fit.spectrum().unit();
  Eigen::MatrixXd covariance = (best.theta[1] + 2 * best.theta[0]) * Eigen::MatrixXd::Identity(63, 63);
  covariance.diagonal(1).setConstant(-best.theta[0]);
  covariance.diagonal(-1).setConstant(-best.theta[0]);
  Eigen::VectorXd d(63);
  for (Eigen::Index i = 0; i < 63; ++i) {
    d[i] = (y[static_cast<std::size_t>(i) + 1] - y[static_cast<std::size_t>(i)]) / unit;
  }
  const Eigen::VectorXd weights = covariance.llt().solve(Eigen::VectorXd::Ones(63));
  REQUIRE(best.slopes.size() == 1);
  CHECK_THAT(best.slopes[0], WithinRel(weights.dot(d) / weights.sum(), 1e-10));
  CHECK_THAT(best.slope_error, WithinRel(1 / std::sqrt(weights.sum()), 1e-10));
  CHECK(fit.maximise(white_and_walk).slopes == std::vector<double>{0});
  CHECK(fit.maximise(white_and_walk).slope_error == 0);
}

TEST_CASE("Several spectra add up, whatever their units are") {
  const auto y = simulated({.n = 500, .white = 1, .walk = 0.1, .ramp = 0.1, .seed = 3});
  auto turned = y;
  for (double& value : turned) value = 1e7 - value;
  const auto one = spectrum_of(y);
  const std::vector<DifferenceSpectrum<double>> three{one, spectrum_of(turned), one};
  const auto [owned, single] = fit_of(one);
  const auto [owned_three, pooled] = fit_of(three);
  CHECK(pooled.spectrum().spectra() == 3);
  CHECK(pooled.groups() == single.groups());
  const NoiseTerms terms = white_and_walk.with(NoiseTerm::rate_ramp);
  const auto alone = single.maximise(terms), together = pooled.maximise(terms);
  const double ratio = pooled.spectrum().unit() / single.spectrum().unit();
  CHECK(ratio > 1000);
  for (int j = 0; j < 2; ++j) CHECK_THAT(together.theta[j] * ratio * ratio, WithinRel(alone.theta[j], 1e-4));
  REQUIRE(together.slopes.size() == 3);
  CHECK_THAT(together.slopes[0] * ratio, WithinRel(alone.slopes[0], 1e-4));
  CHECK_THAT(together.slopes[1] * ratio, WithinRel(-alone.slopes[0], 1e-4));
  CHECK(together.slopes[2] == together.slopes[0]);
  CHECK_THAT(together.slope_error * ratio, WithinRel(alone.slope_error, 1e-4));
  // Units whose quotient is no number of the scalar.
  auto tiny = y;
  auto huge = y;
  for (double& value : tiny) value *= 1e-300;
  for (double& value : huge) value *= 1e300;
  const std::vector<DifferenceSpectrum<double>> extremes{spectrum_of(tiny), spectrum_of(huge)};
  const auto result = fit_of(extremes).fit.maximise(terms);
  CHECK(result.theta.allFinite());
  CHECK(std::isfinite(result.objective));
  CHECK(std::isfinite(result.slopes[0]));
}

TEST_CASE("Bins that are not included do not count") {
  const auto y = simulated({.n = 128, .white = 1, .seed = 4});
  const auto spectrum = spectrum_of(y, 50);
  const PooledSpectrum<double> pooled(std::span(&spectrum, 1));
  std::vector<bool> half(pooled.bins().size(), true);
  double power = 0, basis = 0;
  for (std::size_t i = 0; i < half.size(); ++i) {
    half[i] = i % 3 == 0;
    if (!half[i]) continue;
    power += pooled.bins()[i].power / pooled.bins()[i].basis[0];
    basis += pooled.bins()[i].count;
  }
  // Of white noise alone, θ is the mean of power over basis.
  CHECK_THAT(Fit(pooled, half).maximise({NoiseTerm::white}).theta[0], WithinRel(power / basis, 1e-9));
}

TEST_CASE("A bound on counts lets a part of the spectrum have no more to say than its share") {
  // White noise whose upper half has four times the power: nearly all of the bins of 32 and more are below it.
  const auto y = simulated({.n = 20'000, .white = 1, .seed = 4});
  const auto spectrum = spectrum_of(y);
  PooledSpectrum<double> pooled(std::span(&spectrum, 1));
  const auto [owned, fit] = fit_of(spectrum);
  const auto [owned_bounded, bounded] = fit_of(std::span(&spectrum, 1), 8);
  const double all = fit.maximise({NoiseTerm::white}).theta[0], few = bounded.maximise({NoiseTerm::white}).theta[0];
  CHECK_THAT(few, WithinRel(all, 0.1));
  CHECK(few != all);
}

TEST_CASE("The basis of a Gauss-Markov bias is that of its covariance on cosines") {
  // b_k is the chord times the cosine transform of the samples, whose mean square the covariance gives.
  constexpr int n = 400;
  const double rate = 2, time = 20, keep = std::exp(-1 / (rate * time));
  const auto [owned, fit] = fit_of(spectrum_of(simulated({.n = n, .white = 1, .seed = 1}), rate));
  for (const int k : {1, 5, 20, 100, 390}) {
    INFO("k " << k);
    double square = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        square += std::pow(keep, std::abs(i - j)) * std::cos(std::numbers::pi * k * (i + 0.5) / n) *
                  std::cos(std::numbers::pi * k * (j + 0.5) / n) * 2 / n;
      }
    }
    const double chord = 2 * std::sin(std::numbers::pi * k / (2 * n));
    // In units of 2σ²/(T·rate). What is not exact: the ends, a share of 2T/duration of what is slower than T.
    const double share = 2 * time * rate / n / (1 + std::pow(std::numbers::pi * k * time * rate / n, 2));
    CHECK_THAT(fit.gauss_markov_basis(chord * chord, time) * 2 / (time * rate),
               WithinRel(square * chord * chord, 2 * share + 1e-3));
  }
}

TEST_CASE("The means of a trend are the transform of its differences") {
  constexpr std::size_t n = 300;
  const double rate = 5;
  for (const double decay : {3.0, 30.0, 1e4}) {
    std::vector<double> differences;
    for (std::size_t i = 0; i + 1 < n; ++i) differences.push_back(std::exp(-static_cast<double>(i) / (rate * decay)));
    const auto b = sine_transform(differences);
    const auto spectrum = spectrum_of(simulated({.n = n, .white = 1, .seed = 1}), rate);
    const PooledSpectrum<double> pooled(std::span(&spectrum, 1));
    for (std::size_t k = 1; k < 128; ++k) {  // bins of their own
      const auto means = pooled.trend_means(pooled.bins()[k - 1], decay);
      CHECK_THAT(k % 2 == 1 ? means.odd : means.even, WithinAbs(b[k - 1], 1e-9 * std::abs(b[0])));
    }
  }
}

TEST_CASE("Signals that leave no power have a floor") {
  std::vector<double> ramp(200), steps(1025, 1.0);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<double>(i);
  steps.back() = 2;  // beyond the length of the transform
  for (const auto& y : {ramp, steps}) {
    const auto spectrum = spectrum_of(y);
    const auto [owned, fit] = fit_of(spectrum);
    for (unsigned set = 0; set < NoiseTerms::sets; ++set) {
      const auto best = fit.maximise(NoiseTerms::numbered(set), {.correlation = 50});
      CHECK(best.theta.allFinite());
      CHECK(std::isfinite(best.objective));
    }
  }
}
