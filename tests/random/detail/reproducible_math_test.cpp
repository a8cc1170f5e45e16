// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <splinertia/detail/pi.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <splinertia/random/random_stream.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// The largest error of f over reference, relative, over a ladder of arguments ±x.
template <typename F, typename Reference>
double worst(const F& f, const Reference& reference, double from, double to, double ratio) {
  double result = 0;
  for (double x = from; x < to; x *= ratio) {
    const long double exact = reference(static_cast<long double>(x));
    const double error = static_cast<double>(std::abs((f(x) - exact) / exact));
    if (!(error <= result)) result = error;  // NaN, too
  }
  return result;
}

}  // namespace

TEST_CASE("The logarithm is right to 2 eps for all normal numbers") {
  const auto reference = [](long double x) { return std::log(x); };
  CHECK(worst(reproducible_log, reference, std::numeric_limits<double>::min(), 0x1p1023, 1.013) < 2 * eps);
  CHECK(worst(reproducible_log, reference, 0.5, 0.9999, 1.00001) < 2 * eps);
  CHECK(worst(reproducible_log, reference, 1.0001, 2, 1.00001) < 2 * eps);
  for (int k = 1; k <= 52; ++k) {
    for (const double x : {1 + std::ldexp(1, -k), 1 - std::ldexp(0.5, -k)})
      CHECK_THAT(reproducible_log(x), WithinRel(static_cast<double>(std::log(static_cast<long double>(x))), 2 * eps));
  }
  CHECK(reproducible_log(1) == 0);
  CHECK_THAT(reproducible_log(std::numeric_limits<double>::max()), WithinRel(709.782712893384, 1e-15));
}

TEST_CASE("The exponential is right to one eps from zero to the end of the normal numbers") {
  const auto f = [](double x) { return reproducible_exp(-x); };
  const auto reference = [](long double x) { return std::exp(-x); };
  CHECK(worst(f, reference, 1e-320, 1, 1.01) < eps);
  CHECK(worst(f, reference, 1, 708, 1.00003) < eps);
  CHECK(reproducible_exp(0) == 1);
  CHECK(reproducible_exp(-0.0) == 1);
  CHECK(reproducible_exp(-708) > 0);
  for (const double x : {-708.1, -745.0, -1e9, -std::numeric_limits<double>::infinity()})
    CHECK(reproducible_exp(x) == 0);
}

TEST_CASE("The exponential less one keeps its relative accuracy to the smallest numbers") {
  const auto f = [](double x) { return reproducible_expm1(-x); };
  const auto reference = [](long double x) { return std::expm1(-x); };
  CHECK(worst(f, reference, 1e-320, 1e-3, 1.03) < eps);
  CHECK(worst(f, reference, 1e-3, 1000, 1.00003) < 2 * eps);
  CHECK(reproducible_expm1(0) == 0);
  CHECK(reproducible_expm1(-1e300) == -1);
  CHECK(reproducible_expm1(-std::numeric_limits<double>::infinity()) == -1);
}

TEST_CASE("Sine and cosine are right to one eps, and whole turns change nothing") {
  double error = 0;
  const long double two_pi = 2 * splinertia::detail::pi_of<long double>();
  for (int i = -50'000; i <= 50'000; ++i) {
    const double x = i * 1.23456789e-4;
    const auto [sine, cosine] = reproducible_sine_cosine(x);
    const long double whole = std::floor(static_cast<long double>(x)), angle = two_pi * (x - whole);
    error = std::max({error, static_cast<double>(std::abs(sine - std::sin(angle))),
                      static_cast<double>(std::abs(cosine - std::cos(angle)))});
  }
  CHECK(error < eps);
  for (double x = 1e-300; x < 0.124; x *= 1.1) {
    const double expected = static_cast<double>(std::sin(two_pi * static_cast<long double>(x)));
    CHECK_THAT(reproducible_sine_cosine(x).sine, WithinRel(expected, 2 * eps));
    CHECK(reproducible_sine_cosine(-x).sine == -reproducible_sine_cosine(x).sine);
  }
  for (const double turns : {1.0, 1e6, -1e6, 0x1p40, -0x1p40}) {
    for (const double x : {0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875}) {
      INFO(turns << " turns and " << x);
      const auto [sine, cosine] = reproducible_sine_cosine(turns + x);
      const auto [expected_sine, expected_cosine] = reproducible_sine_cosine(x);
      CHECK_THAT(sine, WithinAbs(expected_sine, eps));  // −7/8 of a turn may be found from another quarter
      CHECK_THAT(cosine, WithinAbs(expected_cosine, eps));
    }
  }
  for (const double x : {0.0, -0.0, 1.0, 0x1p52, -0x1p52, 1e300, -std::numeric_limits<double>::max()}) {
    CHECK(reproducible_sine_cosine(x).sine == 0);
    CHECK(reproducible_sine_cosine(x).cosine == 1);
  }
  CHECK(reproducible_sine_cosine(0.25).sine == 1);
  CHECK(reproducible_sine_cosine(0.25).cosine == 0);
  CHECK(reproducible_sine_cosine(-0.25).sine == -1);
  CHECK(reproducible_sine_cosine(0x1p51 + 0.5).cosine == -1);
}

TEST_CASE("Powers of two are exact, and zero below the normal numbers") {
  for (int n = -1022; n <= 1023; ++n) CHECK(power_of_two(n) == std::ldexp(1.0, n));
  CHECK(power_of_two(-1023) == 0);
  CHECK(power_of_two(-5000) == 0);
}

TEST_CASE("All of it can be done while compiling, to two more roundings") {
  constexpr double logarithm_of_10 = reproducible_log(10), one_over_e = reproducible_exp(-1),
                   rest = reproducible_expm1(-1);
  constexpr auto sixth = reproducible_sine_cosine(1.0 / 6);
  STATIC_CHECK(reproducible_exp(0) == 1);
  STATIC_CHECK(reproducible_log(1) == 0);
  CHECK_THAT(logarithm_of_10, WithinRel(std::numbers::ln10, 4 * eps));
  CHECK_THAT(one_over_e, WithinRel(1 / std::numbers::e, 4 * eps));
  CHECK_THAT(rest, WithinRel(1 / std::numbers::e - 1, 4 * eps));
  CHECK_THAT(sixth.sine, WithinRel(std::numbers::sqrt3 / 2, 4 * eps));
  CHECK_THAT(sixth.cosine, WithinRel(0.5, 4 * eps));
}

TEMPLATE_TEST_CASE("Decay, rise, logarithm and oscillation are those functions, rounded", "", float, double) {
  using Scalar = TestType;
  const Scalar x = Scalar(0.7);
  const double given = static_cast<double>(x);
  const double tolerance = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  CHECK_THAT(static_cast<double>(exp_minus(x)), WithinRel(std::exp(-given), tolerance));
  CHECK_THAT(static_cast<double>(one_minus_exp_minus(x)), WithinRel(1 - std::exp(-given), tolerance));
  CHECK_THAT(static_cast<double>(logarithm(x)), WithinRel(std::log(given), tolerance));
  const Oscillation<Scalar> oscillation(x);
  CHECK_THAT(static_cast<double>(oscillation.sine), WithinAbs(std::sin(2 * std::numbers::pi * given), 4 * tolerance));
  CHECK_THAT(static_cast<double>(oscillation.cosine), WithinAbs(std::cos(2 * std::numbers::pi * given), 4 * tolerance));
  CHECK(exp_minus(Scalar(0)) == 1);
  CHECK(one_minus_exp_minus(Scalar(0)) == 0);
  CHECK(exp_minus(std::numeric_limits<Scalar>::max()) == 0);
  CHECK(one_minus_exp_minus(std::numeric_limits<Scalar>::max()) == 1);
  CHECK(one_minus_exp_minus(std::numeric_limits<Scalar>::denorm_min()) == std::numeric_limits<Scalar>::denorm_min());
}

TEST_CASE("The functions are the same to the last bit on every compiler and platform") {
  std::uint64_t hash = 0;
  const auto add = [&](double value) { hash = scramble(hash ^ std::bit_cast<std::uint64_t>(value)); };
  for (int i = 1; i <= 100'000; ++i) {
    const double x = i * 0.0073;
    add(reproducible_log(x));
    add(reproducible_exp(-x));
    add(reproducible_expm1(-x / 64));
    const auto [sine, cosine] = reproducible_sine_cosine(x);
    add(sine);
    add(cosine);
  }
  CHECK(hash == 0x87ceee287ecd1e05U);
}
