// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <splinertia/allan/averaging_factors.hpp>
#include <splinertia/allan/deviations.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "allan/reference.hpp"
#include "golden/golden_table.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

golden::Table table(const std::string& name) { return golden::Table(SPLINERTIA_GOLDEN_DIR "/allan/" + name + ".csv"); }

/// By name, as in tables.
template <typename Scalar>
Scalar deviation(const std::string& name, const IntegratedSignal<Scalar>& signal, std::int64_t m) {
  Scalar result = std::numeric_limits<Scalar>::quiet_NaN();
  for_each_deviation([&]<typename D>() {
    if (D::name == name) result = deviations<D>(signal, {m}).at(0);
  });
  return result;
}

/// The rates of SP 1065, table 29.
std::vector<double> nbs9() {
  std::vector<double> rates;
  const golden::Table rows = table("nbs9");
  for (std::size_t i = 0; i < rows.size(); ++i) rates.push_back(rows[i].input<double>("rate"));
  return rates;
}

/// The worst relative error of all deviations at these factors against exact integer arithmetic.
template <typename Scalar>
Scalar worst_error(const Integers& integers, Scalar unit, const AveragingFactors& grid) {
  Scalar worst = 0;
  const IntegratedSignal<Scalar> signal(scaled(integers, unit), Scalar(200));
  const Integers phase = phase_of(integers);
  for_each_deviation([&]<typename D>() {
    const auto factors = grid.up_to(D::largest_factor(signal.samples()));
    const auto values = deviations<D>(signal, factors);
    for (std::size_t j = 0; j < factors.size(); ++j) {
      const auto exact = static_cast<Scalar>(exact_deviation<D>(phase, factors[j], 200));
      const Scalar error = std::abs(values[j] / (exact * unit) - 1);
      worst = error <= worst ? worst : error;  // NaN, too
    }
  });
  return worst;
}

}  // namespace

TEST_CASE("The published deviations of NBS's 9 and 1000 rates") {
  const IntegratedSignal of_9(nbs9(), 1.0);
  const IntegratedSignal of_1000(scaled(nbs1000(), 1.0 / nbs1000_unit), 1.0);
  const golden::Table rows = table("nbs_published");
  CHECK(rows.size() == 35);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // Half a unit of the seventh digit is 1e-7 to 3e-7, and some of those published are off by one more.
    const bool small = rows[i].text("set") == "nbs9", rounded = rows[i].text("value") == "1.687202e-01";
    INFO(rows[i].text("set") << " " << rows[i].text("deviation") << " at m = " << rows[i].text("m"));
    CHECK_THAT(deviation(rows[i].text("deviation"), small ? of_9 : of_1000, rows[i].integer64("m")),
               WithinRel(rows[i].input<double>("value"), small     ? 1.5e-7
                                                         : rounded ? 3e-7
                                                                   : 2e-7));
  }
}

TEMPLATE_TEST_CASE("The exact deviations of NBS's 1000 rates", "", double, long double) {
  using Scalar = TestType;
  const Integers integers = nbs1000();
  CHECK(integers[1] == 395529916);
  CHECK(integers[3] == 633705974);
  std::vector<Scalar> rates;
  for (const std::int64_t y : integers) rates.push_back(static_cast<Scalar>(y) / static_cast<Scalar>(nbs1000_unit));
  const IntegratedSignal<Scalar> signal(rates, 1);
  const golden::Table rows = table("nbs1000_exact");
  CHECK(rows.size() == 66);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    INFO(rows[i].text("deviation") << " at m = " << rows[i].text("m"));
    const std::int64_t m = rows[i].integer64("m");
    const Scalar value = deviation(rows[i].text("deviation"), signal, m);
    const auto expected = static_cast<Scalar>(rows[i].outputs("value").at(0));
    CHECK(std::abs(value / expected - 1) <= (std::same_as<Scalar, double> ? Scalar(1e-13) : Scalar(1e-16L)));
    for_each_deviation([&]<typename D>() {
      if (D::name != rows[i].text("deviation")) return;
      CHECK(D::terms(1000, m) == rows[i].integer64("terms"));
      const auto exact = static_cast<Scalar>(exact_deviation<D>(phase_of(integers), m, 1) / nbs1000_unit);
      CHECK(std::abs(exact / expected - 1) <= 2 * std::numeric_limits<Scalar>::epsilon());
    });
  }
}

TEMPLATE_TEST_CASE("Deviations are exact for logs of any length", "", double, long double) {
  using Scalar = TestType;
  for (std::size_t n : {3U, 4U, 5U, 6U, 7U, 8U, 9U, 50U, 201U, 1100U}) {
    INFO(n << " samples");
    const Scalar worst = worst_error(noisy_integers(n, 9810, 5, 0.1), Scalar(1) / 1024,
                                     n < 300 ? AveragingFactors::all() : AveragingFactors::logarithmic());
    CHECK(worst <= (std::same_as<Scalar, double> ? Scalar(1e-12) : Scalar(1e-15L)));
  }
}

TEST_CASE("Long logs of quantised specific forces") {
  // σ = 1e-3 in digits of 1e-3 on top of 9.81; the same with a random walk that ends 1 m/s² away.
  const Integers white = noisy_integers(2'000'000, 9810, 1, 0), drifting = noisy_integers(300'000, 9810, 1, 1.5);
  const IntegratedSignal signal(scaled(white, 1e-3), 200.0);
  const auto factors = AveragingFactors::logarithmic().up_to(1'000'000);
  const auto values = deviations<OverlappingAllanDeviation>(signal, factors);
  const Integers phase = phase_of(white);
  double worst = 0;
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const auto exact = static_cast<double>(exact_deviation<OverlappingAllanDeviation>(phase, factors[j], 200));
    worst = std::max(worst, std::abs(values[j] / (exact * 1e-3) - 1));
  }
  CHECK(factors.size() > 80);
  CHECK(worst <= 1e-9);
  worst = worst_error(drifting, 1e-3, AveragingFactors::octave());
  CHECK(worst <= 1e-9);
}

TEST_CASE("Deviations that are known") {
  // ±1 in turn: second differences over m = 1 are ±2·2; averages over an even number are equal.
  std::vector<double> turns, ramp, parabola;
  for (int i = 0; i < 64; ++i) {
    turns.push_back(i % 2 == 0 ? 1 : -1);
    ramp.push_back(0.25 * i);
    parabola.push_back(0.5 * i * i);
  }
  const IntegratedSignal alternating(turns, 1.0), drift(ramp, 1.0), accelerated(parabola, 1.0);
  CHECK_THAT(deviation("adev", alternating, 1), WithinRel(std::sqrt(2.0), 1e-14));
  CHECK_THAT(deviation("oadev", alternating, 3), WithinRel(std::sqrt(2.0) / 3, 1e-14));
  for (const char* name : {"adev", "oadev", "mdev", "tdev", "hdev", "ohdev"}) {
    CHECK(deviation(name, alternating, 2) == 0);
  }
  // A ramp of R: R·tau/√2, and nothing of it in third differences; a parabola has its second derivative in these.
  for (int m : {1, 2, 5, 20}) {
    for (const char* name : {"adev", "oadev", "mdev"}) {
      CHECK_THAT(deviation(name, drift, m), WithinRel(0.25 * m / std::sqrt(2.0), 1e-13));
    }
    CHECK(deviation("hdev", drift, m) <= 1e-15 * 16);
    CHECK(deviation("ohdev", drift, m) <= 1e-15 * 16);
    CHECK_THAT(deviation("hdev", accelerated, m), WithinRel(m * m / std::sqrt(6.0), 1e-11));
  }
}

TEST_CASE("Deviations at one sample, of shifted and of scaled signals") {
  const Integers integers = noisy_integers(5000, 0, 100, 1);
  const IntegratedSignal signal(scaled(integers, 1.0), 50.0);
  Integers reversed(integers.rbegin(), integers.rend());
  for (auto& y : reversed) y = 1'000'000 - y;
  const IntegratedSignal mirrored(scaled(reversed, 1.0), 50.0);
  CHECK_THAT(deviation("oadev", signal, 1), WithinRel(deviation("adev", signal, 1), 1e-14));
  CHECK_THAT(deviation("mdev", signal, 1), WithinRel(deviation("adev", signal, 1), 1e-13));
  CHECK_THAT(deviation("totdev", signal, 1), WithinRel(deviation("adev", signal, 1), 1e-14));
  CHECK_THAT(deviation("ohdev", signal, 1), WithinRel(deviation("hdev", signal, 1), 1e-14));
  for (std::int64_t m : {1, 5, 100, 1600}) {
    const double tau = static_cast<double>(m) / 50;
    CHECK_THAT(deviation("tdev", signal, m), WithinRel(deviation("mdev", signal, m) * tau / std::sqrt(3.0), 1e-14));
    for (const char* name : {"oadev", "mdev", "ohdev", "totdev"}) {
      CHECK_THAT(deviation(name, mirrored, m), WithinRel(deviation(name, signal, m), 1e-11));
    }
    // A power of two changes the exponents only; any other factor little.
    for (double factor : {0x1p-900, 0x1p-3, 0x1p+950, 1e-300, 1e300, 3.7}) {
      const IntegratedSignal other(scaled(integers, factor), 50.0);
      for (const char* name : {"adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev"}) {
        const double expected = deviation(name, signal, m) * factor;
        if (std::ldexp(1.0, std::ilogb(factor)) == factor) {
          CHECK(deviation(name, other, m) == expected);
        } else {
          CHECK_THAT(deviation(name, other, m), WithinRel(expected, 1e-11));
        }
      }
    }
  }
}

TEST_CASE("Deviations of extreme signals are numbers") {
  const auto length = 300U;
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = 1e300;
  std::vector<std::vector<double>> signals{
      {1, 2, 4}, {0, 0, tiny}, {huge, -huge, huge}, {1, 1, 1 + 1e-15}, {tiny, huge, 1}};
  std::vector<double> step(length, 9.81), spike(length, 0), turns(length, huge), denormals(length, 0), mixed(length, 0);
  std::fill(step.begin() + length / 2, step.end(), 9.81 + 2e-15);
  spike[17] = huge;
  for (std::size_t i = 0; i < length; ++i) {
    if (i % 2 == 0) turns[i] = -huge;
    denormals[i] = tiny * static_cast<double>(i * i % 7);
    mixed[i] = std::pow(10.0, static_cast<double>(i) - 300) * (i % 3 == 0 ? -1 : 1);
  }
  for (const auto& y : {step, spike, turns, denormals, mixed}) signals.push_back(y);
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const IntegratedSignal signal(signals[s], 200.0);
    for_each_deviation([&]<typename D>() {
      for (const double value :
           deviations<D>(signal, AveragingFactors::all().up_to(D::largest_factor(signal.samples())))) {
        if (std::isfinite(value) && value >= 0) continue;
        FAIL_CHECK("signal " << s << ", " << D::name << ": " << value);
      }
    });
  }
  CHECK_THAT(deviation("adev", IntegratedSignal(std::vector<double>{huge, -huge, huge}, 1.0), 1),
             WithinRel(std::sqrt(2.0) * huge, 1e-14));
  CHECK(deviation("adev", IntegratedSignal(std::vector<double>{0, 4 * tiny, 0}, 1.0), 1) == 3 * tiny);  // 2√2
}

TEST_CASE("Factors outside the data are refused") {
  const IntegratedSignal signal(scaled(noisy_integers(20, 0, 100, 0), 1.0), 1.0);
  const auto refusal = [&]<typename D>(std::int64_t m) -> std::string {
    try {
      (void)deviations<D>(signal, {1, m});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  CHECK(refusal.template operator()<AllanDeviation>(0) ==
        "Allan analysis: averaging factor 0 is outside the data, expected 1 to 10");
  CHECK(refusal.template operator()<TotalDeviation>(11) ==
        "Allan analysis: averaging factor 11 is outside the data, expected 1 to 10");
  CHECK(refusal.template operator()<OverlappingHadamardDeviation>(7) ==
        "Allan analysis: averaging factor 7 is outside the data, expected 1 to 6");
  for_each_deviation([&]<typename D>() {
    CHECK(refusal.template operator()<D>(D::largest_factor(20)) == "nothing thrown");
    for (const std::int64_t m : {-1L, 0L, static_cast<long>(D::largest_factor(20)) + 1, 1L << 62}) {
      CHECK(refusal.template operator()<D>(m) != "nothing thrown");
    }
  });
}
