// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/noise_densities.hpp>
#include <splinertia/random/normal.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("A sample and a step of continuous-time noise") {
  CHECK_THAT(white_noise_sigma(0.015, 200), WithinRel(0.21213203435596426, 1e-15));
  CHECK_THAT(white_noise_density(0.21213203435596426, 200), WithinRel(0.015, 1e-15));
  CHECK_THAT(random_walk_sigma(5e-5, 200), WithinRel(3.5355339059327378e-6, 1e-15));
  CHECK_THAT(random_walk_density(3.5355339059327378e-6, 200.0), WithinRel(5e-5, 1e-15));
  CHECK(white_noise_sigma(0.5, 4) == 1);
  CHECK(random_walk_sigma(0.5, 0.25) == 1);
  CHECK(white_noise_sigma(0.0, 200) == 0);
}

TEMPLATE_TEST_CASE("There and back, in any scalar", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const Scalar x = Scalar(123) / Scalar(10000);
  const auto same = [&](Scalar y) { return std::abs(y - x) <= 4 * eps * x; };
  for (const double rate : {0.5, 100.0, 208.3, 8000.0}) {
    CHECK(same(white_noise_density(white_noise_sigma(x, rate), rate)));
    CHECK(same(random_walk_density(random_walk_sigma(x, rate), rate)));
    CHECK(same(white_noise_density_from_rms(white_noise_rms(x, rate), rate)));
  }
  CHECK(same(white_noise_density_from_one_sided(one_sided_density(x))));
  CHECK(same(bias_instability_from_floor(allan_floor(x))));
  STATIC_CHECK(std::is_same_v<decltype(white_noise_sigma(x, 200.0)), Scalar>);
  STATIC_CHECK(std::is_same_v<decltype(allan_floor(x)), Scalar>);

  const Scalar pi = std::acos(Scalar(-1));
  CHECK(std::abs(allan_floor_over_bias_instability<Scalar>() - std::sqrt(2 * std::log(Scalar(2)) / pi)) <= eps);
  CHECK(std::abs(root_half<Scalar>() * root_half<Scalar>() - Scalar(0.5)) <= eps);
  CHECK(std::abs(first_order_noise_bandwidth(Scalar(2)) - pi) <= 2 * eps * pi);
}

TEST_CASE("What data sheets give is known while compiling") {
  STATIC_CHECK(bias_instability_from_floor(0.664282470267960019) == 1);
  STATIC_CHECK(white_noise_density_from_one_sided(2.0) * white_noise_density_from_one_sided(2.0) > 1.9999999999999);
  CHECK_THAT(bias_instability_from_floor(14.5), WithinRel(21.828063, 1e-7));
  CHECK_THAT(white_noise_density_from_one_sided(0.005), WithinRel(0.00353553390593, 1e-11));
}

TEST_CASE("The noise of samples that do not alias fills half the rate") {
  for (const double rate : {100.0, 200.0, 1000.0}) {
    CHECK_THAT(white_noise_rms(0.015, rate / 2), WithinRel(white_noise_sigma(0.015, rate), 1e-15));
  }
  // A data sheet's density is defined by rms = density·√bandwidth.
  CHECK_THAT(white_noise_rms(white_noise_density_from_one_sided(0.005), 100), WithinRel(0.05, 1e-14));
}

TEST_CASE("Behind a filter of first order white noise has the standard deviation of its noise bandwidth") {
  constexpr double density = 0.3, cutoff = 5, rate = 4000;
  const double decay = std::exp(-2 * std::acos(-1.0) * cutoff / rate);
  NormalStream normal(StreamKey(3));
  const double sigma = white_noise_sigma(density, rate);
  double filtered = 0, squares = 0;
  constexpr int n = 2'000'000;
  for (int i = 0; i < n; ++i) {
    filtered = decay * filtered + (1 - decay) * sigma * normal();
    squares += filtered * filtered;
  }
  const double expected = white_noise_rms(density, first_order_noise_bandwidth(cutoff));
  CHECK_THAT(expected, WithinRel(density * std::sqrt(std::acos(-1.0) * cutoff), 1e-15));
  // Some n/100 independent values; that the filter is discrete matters less.
  CHECK_THAT(std::sqrt(squares / n), WithinRel(expected, 0.02));
}

TEST_CASE("What is no density, rate or bandwidth is refused") {
  const double nan = std::nan("");
  CHECK_THROWS_WITH(white_noise_sigma(-0.1, 200), "white_noise_sigma: density is -0.1, expected a finite number >= 0");
  CHECK_THROWS_WITH(white_noise_sigma(0.1, 0.0), "white_noise_sigma: rate is 0, expected a finite number > 0");
  CHECK_THROWS_WITH(white_noise_density(nan, 200), "white_noise_density: sigma is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(white_noise_density(0.1, -1), "white_noise_density: rate is -1, expected a finite number > 0");
  CHECK_THROWS_WITH(random_walk_sigma(-1.0, 200), "random_walk_sigma: density is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(random_walk_sigma(1.0, nan), "random_walk_sigma: rate is nan, expected a finite number > 0");
  CHECK_THROWS_WITH(random_walk_density(-1.0, 200), "random_walk_density: sigma is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(random_walk_density(1.0, 0), "random_walk_density: rate is 0, expected a finite number > 0");
  CHECK_THROWS_AS(white_noise_rms(-1.0, 100), std::invalid_argument);
  CHECK_THROWS_WITH(white_noise_rms(1.0, 0), "white_noise_rms: noise bandwidth is 0, expected a finite number > 0");
  CHECK_THROWS_AS(white_noise_density_from_rms(-1.0, 100), std::invalid_argument);
  CHECK_THROWS_AS(white_noise_density_from_rms(1.0, -100), std::invalid_argument);
  CHECK_THROWS_AS(white_noise_density_from_one_sided(-1.0), std::invalid_argument);
  CHECK_THROWS_AS(one_sided_density(nan), std::invalid_argument);
  CHECK_THROWS_AS(first_order_noise_bandwidth(0.0), std::invalid_argument);
  CHECK_THROWS_AS(bias_instability_from_floor(-1.0), std::invalid_argument);
  CHECK_THROWS_AS(allan_floor(std::numeric_limits<double>::infinity()), std::invalid_argument);
}
