// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <splinertia/allan/streaming.hpp>
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

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <typename Scalar, typename Sample>
StreamingAllanDeviation<Scalar> streamed(const std::vector<Sample>& samples, std::optional<Scalar> offset = {}) {
  StreamingAllanDeviation<Scalar> stream(200, offset);
  for (const Sample& sample : samples) stream.push(sample);
  return stream;
}

/// Each m/16 samples, and at each of them up to m = 16.
std::int64_t stride_of(std::int64_t m) { return std::max<std::int64_t>(1, m / 16); }

/// The worst relative error of deviations whose terms are each m/16 samples, against exact integer arithmetic.
template <typename Scalar>
Scalar worst_error(const DeviationCurve<Scalar>& curve, const Integers& integers, Scalar unit) {
  const Integers phase = phase_of(integers);
  Scalar worst = 0;
  for (const auto& point : curve.points) {
    const auto squares = static_cast<Scalar>(sum_of_squares(phase, point.factor, 2, stride_of(point.factor)));
    const Scalar exact =
        std::sqrt(squares / static_cast<Scalar>(2 * point.terms)) / static_cast<Scalar>(point.factor) * unit;
    const Scalar error = std::abs(point.deviation / exact - 1);
    worst = error <= worst ? worst : error;
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("Deviations of a stream are exact for its terms", "", double, long double) {
  using Scalar = TestType;
  const Scalar limit = std::same_as<Scalar, double> ? Scalar(1e-13) : Scalar(1e-16L);
  for (std::size_t n : {3U, 4U, 15U, 16U, 31U, 32U, 33U, 63U, 64U, 100U, 127U, 128U, 1000U, 4095U, 4096U, 50'000U}) {
    INFO(n << " samples");
    const Integers integers = noisy_integers(n, 0, 100, 1);
    const auto curve = streamed(scaled(integers, Scalar(1)), std::optional<Scalar>(0)).curve();
    CHECK(worst_error(curve, integers, Scalar(1)) <= limit);
    const auto length = static_cast<std::int64_t>(n);
    CHECK(curve.points.size() == AveragingFactors::octave().up_to(length / 2).size());
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      CHECK(curve.points[k].factor == std::int64_t{1} << k);
      CHECK(curve.points[k].terms == (length - 2 * curve.points[k].factor) / stride_of(curve.points[k].factor) + 1);
    }
  }
}

TEMPLATE_TEST_CASE("A stream's curve is that of the overlapping deviation", "", double, long double) {
  using Scalar = TestType;
  // White noise that turns into a random walk at m = 1000.
  const auto y = scaled(noisy_integers(300'000, 98'100, 50, 0.08), Scalar(1) / 10'000);
  const auto stream = streamed<Scalar>(y).curve();
  const auto whole = overlapping(y, 200, {.factors = AveragingFactors::octave()});
  CHECK(stream.name == "oadev");
  CHECK(stream.rate == 200);
  CHECK(stream.samples == 300'000);
  CHECK(std::abs(stream.mean / whole.mean - 1) < Scalar(1e-14L));
  CHECK(stream.confidence == one_sigma<Scalar>);
  REQUIRE(stream.points.size() == whole.points.size());
  for (std::size_t k = 0; k < stream.points.size(); ++k) {
    const auto &point = stream.points[k], &other = whole.points[k];
    INFO("m = " << point.factor);
    CHECK(point.factor == other.factor);
    CHECK(point.tau == other.tau);
    if (point.factor <= 16) {
      CHECK(point.terms == other.terms);
      CHECK(std::abs(point.deviation / other.deviation - 1) < Scalar(1e-12L));
      CHECK(point.degrees_of_freedom == other.degrees_of_freedom);
    }
    // The terms that are left out are so like the others that it makes a tenth of the standard error.
    const Scalar standard_error = 1 / std::sqrt(2 * other.degrees_of_freedom);
    CHECK(std::abs(point.deviation / other.deviation - 1) < Scalar(3) / 10 * standard_error);
    // Fewer than 30 averages: of an octave there, of exactly 30 here.
    if (point.factor * 30 > 300'000) continue;
    CHECK(point.alpha == other.alpha);
    CHECK(std::abs(point.degrees_of_freedom / other.degrees_of_freedom - 1) < Scalar(2) / 100);
    CHECK(std::abs(point.interval.lower / other.interval.lower - 1) < Scalar(4) / 10 * standard_error);
    CHECK(std::abs(point.interval.upper / other.interval.upper - 1) < Scalar(4) / 10 * standard_error);
  }
}

TEST_CASE("Terms that are m/16 samples apart have the degrees of freedom of all") {
  for (std::int64_t m : {32, 64, 1024, 65'536, 1'048'576}) {
    for (std::int64_t averages : {2, 3, 10, 100, 1000}) {
      const auto degrees = [&](int alpha, std::int64_t stride) {
        return equivalent_degrees_of_freedom({}, alpha, m, number_of_terms({}, m, averages * m + 1, stride), stride);
      };
      INFO("m = " << m << ", " << averages << " averages");
      CHECK(degrees(0, m / 16) >= 0.995 * degrees(0, 1));
      CHECK(degrees(-1, m / 16) >= 0.9999 * degrees(-1, 1));
      CHECK(degrees(-2, m / 16) >= degrees(-2, 1));
      // No more can be left of what is independent from sample to sample.
      if (averages > 2) CHECK(degrees(2, m / 16) < 17.0 / static_cast<double>(m) * degrees(2, 1));
    }
  }
}

TEST_CASE("Types of noise of a stream are those of the whole") {
  const Integers integers = noisy_integers(200'000, 0, 1000, 0);
  std::vector<double> white = scaled(integers, 1.0), walk = white, steep, drift, quantized = white;
  for (std::size_t i = 1; i < walk.size(); ++i) walk[i] += walk[i - 1];
  steep = walk;
  for (std::size_t i = 1; i < steep.size(); ++i) steep[i] += steep[i - 1];
  for (std::size_t i = 0; i < white.size(); ++i) drift.push_back(white[i] + 1e-2 * static_cast<double>(i));
  for (std::size_t i = white.size() - 1; i > 0; --i) quantized[i] -= quantized[i - 1];
  for (const auto& y : {white, walk, steep, drift, quantized}) {
    const IntegratedSignal whole(y, 200.0);
    for (const auto& point : streamed<double>(y, y[0] + 1e4).curve().points) {
      if (point.factor * 30 <= 200'000) CHECK(point.alpha == noise_type(whole, point.factor));
    }
  }
  CHECK(streamed<double>(steep).curve().points[0].alpha == -4);
  CHECK(streamed<double>(white).curve(one_sigma<double>, -2).points[0].alpha == -2);
  // Of fewer than 30 averages, that of the last octave that has them.
  const auto points = streamed<double>(std::vector<double>(walk.begin(), walk.begin() + 100)).curve().points;
  REQUIRE(points.size() == 6);
  CHECK(points[5].alpha == points[1].alpha);
  CHECK(streamed<double>(std::vector<double>{1, 2, 4}).curve().points[0].alpha == 0);
}

TEST_CASE("Types of noise of short series are those of the same read at once") {
  const Integers integers = noisy_integers(200'000, 0, 1000, 300);
  int types = 0;
  for (std::size_t begin = 0, n = 30; begin + n < integers.size(); begin += n, n = 30 + n % 40) {
    StreamingNoiseType<double> type;
    std::vector<double> y;
    for (std::size_t i = 0; i < n; ++i) {
      y.push_back(static_cast<double>(integers[begin + i]));
      type.add(y.back());
    }
    const int expected = noise_type(IntegratedSignal(y, 1.0), 1);
    CHECK(type.count() == static_cast<std::int64_t>(n));
    CHECK(type.alpha() == expected);
    types |= 1 << (expected + 4);
  }
  CHECK(types >= 0b11100);  // 0 to −2 among them

  StreamingNoiseType<double> type;
  for (std::size_t i = 0; i < 65'536; ++i) type.add(static_cast<double>(integers[i] % 1000));
  const int first = type.alpha();
  for (int i = 0; i < 200'000; ++i) type.add(static_cast<double>(i));
  CHECK(type.alpha() == first);
  CHECK(type.count() == 65'536);
}

TEST_CASE("Long streams of quantised specific forces") {
  const Integers integers = noisy_integers(1'000'000, 9810, 1, 0);
  const auto y = scaled(integers, 1e-3);
  double worst = worst_error(streamed<double>(y).curve(), integers, 1e-3);
  CHECK(worst <= 1e-11);
  worst = worst_error(streamed<double>(y, 9.81).curve(), integers, 1e-3);
  CHECK(worst <= 1e-11);
  worst = worst_error(streamed<double>(y, 0.0).curve(), integers, 1e-3);  // an offset that is not taken off
  CHECK(worst <= 1e-9);
  CHECK_THAT(streamed<double>(y, 0.0).curve().mean, WithinRel(9.81, 1e-6));
}

TEST_CASE("Samples of any type, looked at on the way, and up to a largest factor") {
  const Integers integers = noisy_integers(5000, 100, 30, 0);
  const auto expected = streamed<double>(scaled(integers, 1.0)).curve();
  StreamingAllanDeviation<double> of_floats(200.0), of_integers(200.0), limited(200.0, {}, 64), few(200.0, 100.0, 3);
  for (std::size_t i = 0; i < integers.size(); ++i) {
    of_floats.push(static_cast<float>(integers[i]));
    of_integers.push(integers[i]);
    limited.push(static_cast<double>(integers[i]));
    few.push(static_cast<std::int16_t>(integers[i]));
    if (i >= 10 && i % 100 == 0) CHECK(of_floats.curve().samples == static_cast<std::int64_t>(i) + 1);
  }
  CHECK(of_floats.samples() == 5000);
  CHECK(limited.curve().points.size() == 7);
  CHECK(few.curve().points.size() == 2);
  for (const auto& curve : {of_floats.curve(), of_integers.curve(), limited.curve(), few.curve()}) {
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      CHECK_THAT(curve.points[k].deviation, WithinRel(expected.points[k].deviation, 1e-14));
      CHECK(curve.points[k].terms == expected.points[k].terms);
    }
  }
  const auto wide = of_floats.curve(two_sigma<double>);
  CHECK(wide.confidence == two_sigma<double>);
  CHECK(wide.points[0].interval.lower < expected.points[0].interval.lower);
}

TEST_CASE("Extreme streams have no NaN") {
  const double tiny = std::numeric_limits<double>::denorm_min();
  std::vector<double> turns, small, still(300, 9.81), large;
  for (int i = 0; i < 300; ++i) {
    turns.push_back(i % 2 == 0 ? 1 : -1);
    small.push_back(tiny * (i % 5));
    large.push_back(i % 3 == 0 ? 1e129 : -1e129);
  }
  still.back() += 2e-15;
  for (const auto& y : {turns, small, still, large, {1, 2, 4}, {0, 0, tiny}}) {
    for (const auto& point : streamed<double>(y).curve().points) {
      CHECK(std::isfinite(point.deviation));
      CHECK(point.interval.lower <= point.deviation);
      CHECK(point.interval.upper >= point.deviation);
    }
  }
}

TEST_CASE("What cannot be streamed is refused, and forgotten") {
  const auto made = [](double rate, std::optional<double> offset = {}, std::int64_t largest = 1) {
    return message_of([&] { return StreamingAllanDeviation<double>(rate, offset, largest); });
  };
  CHECK(made(200) == "nothing thrown");
  CHECK(made(0) == "StreamingAllanDeviation: rate is 0, expected a finite number > 0");
  CHECK(made(-1) == "StreamingAllanDeviation: rate is -1, expected a finite number > 0");
  CHECK(made(not_a_number) == "StreamingAllanDeviation: rate is nan, expected a finite number > 0");
  CHECK(made(200, infinity) == "StreamingAllanDeviation: offset is inf, expected a finite number");
  CHECK(made(200, 0.0, 0) == "StreamingAllanDeviation: largest_factor is 0, expected an integer >= 1");

  StreamingAllanDeviation<double> stream(200.0);
  const auto pushed = [&](auto sample) {
    return message_of([&] {
      stream.push(sample);
      return 0;
    });
  };
  const auto curve = [&] { return message_of([&] { return stream.curve(); }); };
  CHECK(pushed(not_a_number).starts_with("Allan analysis: value 0 is nan, expected a number within 5.5"));
  CHECK(curve() == "Allan analysis: 0 values, expected at least 3");
  stream.push(9.81);
  stream.push(9.81);
  CHECK(curve() == "Allan analysis: 2 values, expected at least 3");
  for (double bad : {not_a_number, infinity, -infinity, 1e300, -1e130}) {
    CHECK(pushed(bad).starts_with("Allan analysis: value 2 is "));
  }
  CHECK(pushed(std::numeric_limits<float>::infinity()).starts_with("Allan analysis: value 2 is inf"));
  stream.push(9.81);
  CHECK(curve() == "Allan analysis: the signal is constant (9.81): a sensor that is stuck, or no noise at all");
  stream.push(9.82);
  CHECK(curve() == "nothing thrown");
  CHECK_THAT(stream.curve().points.at(0).deviation, WithinRel(0.01 / std::sqrt(6.0), 1e-12));
  CHECK_THROWS_AS(stream.curve(0.0), std::invalid_argument);
  CHECK_THROWS_AS(stream.curve(not_a_number), std::invalid_argument);
  CHECK_THROWS_AS(stream.curve(0.5, -3), std::invalid_argument);
}
