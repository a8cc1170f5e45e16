// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/detail/deviation_misfit.hpp>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Curve = splinertia::allan::DeviationCurve<double>;
using Estimates = NoiseEstimates<double>;
constexpr std::size_t size = 20'000;
constexpr double rate = 50, duration = size / rate;

/// Estimates whose best description has these coefficients.
Estimates model(double white, double walk = 0) {
  Estimates estimates;
  estimates.duration = duration;
  Description<double> description;
  description.values[static_cast<std::size_t>(NoiseTerm::white)] = white;
  description.values[static_cast<std::size_t>(NoiseTerm::random_walk)] = walk;
  estimates.descriptions.push_back(description);
  return estimates;
}

Curve curve_of(const std::vector<double>& y) { return overlapping(y, rate); }

/// What white noise of density 1 has at these factors, times a ratio at each.
struct Point {
  std::int64_t factor;
  double ratio;
};
Curve curve_with(const std::vector<Point>& points) {
  Curve curve{"oadev", rate, 10'000'000, 0, 0.6827, {}};
  for (const Point& point : points) {
    const double tau = static_cast<double>(point.factor) / rate, deviation = point.ratio / std::sqrt(tau);
    curve.points.push_back({point.factor, tau, 0, deviation, 0, 0, {}});
  }
  return curve;
}

Description<double> description_of(NoiseTerm term, double correlation_time = 0, double decay_time = 0) {
  Description<double> description;
  description.values[static_cast<std::size_t>(term)] = 1;
  description.correlation_time = correlation_time;
  description.decay_time = decay_time;
  return description;
}

}  // namespace

TEST_CASE("The power law is that of the term with the most") {
  const auto law = [](const Description<double>& description, double tau) {
    return ruling_power_law(description, tau, duration);
  };
  CHECK(law(description_of(NoiseTerm::white), 1) == 0);
  CHECK(law(description_of(NoiseTerm::random_walk), 1) == -2);
  CHECK(law(description_of(NoiseTerm::bias_instability), 1) == -1);
  CHECK(law(description_of(NoiseTerm::quantization), 1) == 2);
  CHECK(law(description_of(NoiseTerm::rate_ramp), 1) == -2);
  CHECK(law(description_of(NoiseTerm::warm_up, 0, 50), 1) == -2);
  // A bias is a walk below its time and white noise above.
  CHECK(law(description_of(NoiseTerm::gauss_markov, 10), 1) == -2);
  CHECK(law(description_of(NoiseTerm::gauss_markov, 10), 100) == 0);
  // White noise of 1 and a walk of 1 have as much at √3 s.
  auto both = description_of(NoiseTerm::white);
  both.values[static_cast<std::size_t>(NoiseTerm::random_walk)] = 1;
  CHECK(law(both, 1.7) == 0);
  CHECK(law(both, 1.8) == -2);
  // Quantization noise of 1 and flicker noise of 1: at √(3π/(2 ln 2)) s.
  auto slow = description_of(NoiseTerm::quantization);
  slow.values[static_cast<std::size_t>(NoiseTerm::bias_instability)] = 1;
  CHECK(law(slow, 2.6) == 2);
  CHECK(law(slow, 2.61) == -1);
}

TEST_CASE("A walk of samples has more than one of continuous time") {
  // Half the mean square of the difference of two means of m samples: each increment of variance K²/rate has a weight
  // of up to one, by how many samples follow.
  for (const std::int64_t m : {1, 2, 3, 10, 100}) {
    double squares = 0;
    for (std::int64_t i = 1; i < 2 * m; ++i) squares += std::pow(static_cast<double>(std::min(i, 2 * m - i)), 2);
    const double tau = static_cast<double>(m) / rate;
    const double samples = squares / static_cast<double>(m * m) / rate / 2;
    const double continuous = allan_variance(NoiseTerm::random_walk, tau);
    CHECK_THAT(continuous + sampled_variance(description_of(NoiseTerm::random_walk), m, tau),
               WithinRel(samples, 1e-12));
    // A bias of a long time and σ = 1 is a walk of K² = 2/T.
    CHECK_THAT(sampled_variance(description_of(NoiseTerm::gauss_markov, 50), m, tau),
               WithinRel((samples - continuous) * 2 / 50, 1e-9));
    CHECK(sampled_variance(description_of(NoiseTerm::white), m, tau) == 0);
  }
}

TEST_CASE("Of the truth there is hardly ever a misfit") {
  constexpr std::uint64_t logs = 50;
  std::size_t misfits = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const bool walks = seed % 2 == 0;
    const double walk = walks ? 0.01 : 0;
    const auto y = simulated({.n = size, .rate = rate, .white = 0.02, .walk = walk, .seed = seed});
    misfits += deviation_misfits(curve_of(y), model(0.02, walk)).size();
  }
  // Some sixty points, of which a dozen are independent, in 50 logs: 6e-5 each is 0.04 in all.
  CHECK(misfits <= 1);
}

TEST_CASE("A model that is off by a fifth is found, above and below") {
  for (const double factor : {0.8, 1.2}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto curve = curve_of(simulated({.n = size, .rate = rate, .white = 0.02, .seed = seed}));
      const auto misfits = deviation_misfits(curve, model(0.02 * factor));
      INFO(factor << " times the truth, seed " << seed);
      REQUIRE_FALSE(misfits.empty());
      for (const auto& misfit : misfits) CHECK((misfit.ratio > 1) == (factor < 1));
      CHECK(misfits[0].shortest == curve.points.front().tau);
      CHECK(misfits[0].worst == curve.points.front().tau);  // with most degrees of freedom
      CHECK_THAT(misfits[0].ratio, WithinRel(1 / factor, 0.03));
      // A fifth is four standard deviations of 200 squares: at 20000/200 samples, 2 s, and less for shorter times.
      CHECK(misfits[0].longest > 0.3);
      CHECK(misfits[0].longest < 6);
    }
  }
}

TEST_CASE("A walk too few is found where it is") {
  const auto curve = curve_of(simulated({.n = size, .rate = rate, .white = 0.02, .walk = 0.05, .seed = 4}));
  const auto too_little = deviation_misfits(curve, model(0.02));
  REQUIRE(too_little.size() == 1);
  CHECK(too_little[0].shortest > 0.1);
  CHECK(too_little[0].shortest < 1);
  CHECK(too_little[0].longest > 30);
  CHECK(too_little[0].ratio > 1.5);
  const auto too_much = deviation_misfits(curve, model(0.02, 0.3));
  REQUIRE(too_much.size() == 1);
  CHECK(too_much[0].ratio < 0.5);
  CHECK(too_much[0].longest > 2);
}

TEST_CASE("A line that the model has not is found at its averaging times") {
  auto y = simulated({.n = size, .rate = rate, .white = 0.02, .seed = 5});
  add_line(y, rate, 0.05, 0.2);
  const auto misfits = deviation_misfits(curve_of(y), model(0.02));
  REQUIRE_FALSE(misfits.empty());
  for (const auto& misfit : misfits) {
    CHECK(misfit.shortest > 0.3);
    CHECK(misfit.longest < 20);
    CHECK(misfit.ratio > 1);
  }
  // A sine has most at 0.74 of half its period: 1.85 s.
  CHECK_THAT(misfits[0].worst, WithinAbs(1.9, 1));
}

TEST_CASE("Points of one sign less than an octave apart are one misfit") {
  const auto found = [](const std::vector<Point>& points) { return deviation_misfits(curve_with(points), model(1)); };
  CHECK(found({{1, 1}, {2, 1}, {4, 1}}).empty());
  const auto joined = found({{1, 1.1}, {2, 1.2}, {4, 1.1}, {8, 1}});
  REQUIRE(joined.size() == 1);
  CHECK(joined[0].shortest == 1 / rate);
  CHECK(joined[0].longest == 4 / rate);
  CHECK(joined[0].worst == 2 / rate);
  CHECK_THAT(joined[0].ratio, WithinRel(1.2, 1e-12));
  // A good one in between does not part them; an octave without does.
  CHECK(found({{10, 1.1}, {15, 1}, {20, 1.1}}).size() == 1);
  const auto apart = found({{10, 1.1}, {15, 1}, {21, 1.3}});
  REQUIRE(apart.size() == 2);
  CHECK(apart[0].longest == 10 / rate);
  CHECK(apart[1].shortest == 21 / rate);
  CHECK_THAT(apart[0].ratio, WithinRel(1.1, 1e-12));
  CHECK_THAT(apart[1].ratio, WithinRel(1.3, 1e-12));
  const auto signs = found({{10, 1.1}, {11, 0.9}, {12, 1.1}});
  REQUIRE(signs.size() == 3);
  CHECK(signs[0].ratio > 1);
  CHECK(signs[1].ratio < 1);
  CHECK(signs[2].shortest == 12 / rate);
}

TEST_CASE("Where a model or a curve has nothing there is nothing to compare") {
  CHECK(deviation_misfits(curve_with({{1, 1}, {2, 2}}), model(0)).empty());
  CHECK(deviation_misfits(curve_with({{1, 0}, {2, 1}}), model(1)).empty());
  CHECK(deviation_misfits(curve_with({}), model(1)).empty());
}
