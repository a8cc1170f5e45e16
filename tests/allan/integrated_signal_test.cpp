// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <deque>
#include <limits>
#include <list>
#include <ranges>
#include <span>
#include <splinertia/allan/integrated_signal.hpp>
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

template <typename S>
std::string refusal(const S& signal, double rate = 200) {
  return message_of([&] { return IntegratedSignal(signal, rate); });
}

/// Whatever it is stored in, 1 4 2 8 5 is this.
template <typename S>
void check_signal(const S& signal) {
  STATIC_CHECK(Signal<S>);
  const IntegratedSignal integrated(signal, 200.0);
  CHECK(integrated.samples() == 5);
  CHECK(integrated.mean() == 4);
  CHECK(integrated.unit() == 16);
  REQUIRE(integrated.sums().size() == 6);
  const std::array<int, 6> sums{0, -3, -3, -5, -1, 0};
  for (std::size_t i = 0; i < 6; ++i) CHECK(integrated.sums()[i] * 16 == sums[i]);
}

}  // namespace

TEST_CASE("Any range of numbers that can be read twice is a signal") {
  check_signal(std::vector<double>{1, 4, 2, 8, 5});
  check_signal(std::vector<float>{1, 4, 2, 8, 5});
  check_signal(std::vector<long double>{1, 4, 2, 8, 5});
  check_signal(std::vector<int>{1, 4, 2, 8, 5});
  check_signal(std::vector<std::int16_t>{1, 4, 2, 8, 5});
  check_signal(std::vector<std::uint8_t>{1, 4, 2, 8, 5});
  check_signal(std::array<double, 5>{1, 4, 2, 8, 5});
  check_signal(std::deque<double>{1, 4, 2, 8, 5});
  check_signal(std::list<double>{1, 4, 2, 8, 5});
  const double plain[] = {1, 4, 2, 8, 5};
  check_signal(plain);
  check_signal(std::span(plain));
  check_signal(Eigen::Map<const Eigen::VectorXd>(plain, 5));
  Eigen::MatrixX3d log(5, 3);
  log << 0, 1, 0, 0, 4, 0, 0, 2, 0, 0, 8, 0, 0, 5, 0;
  const Eigen::VectorXd axis = log.col(1);
  const Eigen::Matrix<double, 3, Eigen::Dynamic> wide = log.transpose();
  check_signal(axis);
  check_signal(log.col(1));
  check_signal(wide.row(1));
  check_signal(Eigen::RowVector<float, 5>(1, 4, 2, 8, 5));
  const std::array<double, 10> interleaved{1, 0, 4, 0, 2, 0, 8, 0, 5, 0};
  check_signal(Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(interleaved.data(), 5));
#if !defined(__clang__) || __clang_major__ >= 16  // older ones cannot read libstdc++'s views
  struct Reading {
    double stamp, rate;
  };
  const std::vector<Reading> readings{{0, 1}, {1, 4}, {2, 2}, {3, 8}, {4, 5}};
  check_signal(readings | std::views::transform([](const Reading& reading) { return reading.rate; }));
  check_signal(readings | std::views::transform(&Reading::rate));
  check_signal(std::views::iota(0, 5) | std::views::transform([&](int i) { return static_cast<float>(plain[i]); }));
#endif
}

TEST_CASE("Signals are analysed in double, those of long double in long double") {
  STATIC_CHECK(std::same_as<ScalarOfSignal<std::vector<float>>, double>);
  STATIC_CHECK(std::same_as<ScalarOfSignal<std::vector<int>>, double>);
  STATIC_CHECK(std::same_as<ScalarOfSignal<std::vector<long double>>, long double>);
  STATIC_CHECK(std::same_as<decltype(IntegratedSignal(std::vector<float>{1, 2, 3}, 1.0f)), IntegratedSignal<double>>);
  STATIC_CHECK(std::same_as<decltype(IntegratedSignal(std::vector<double>{1, 2, 3}, 1)), IntegratedSignal<double>>);
  STATIC_CHECK(
      std::same_as<decltype(IntegratedSignal(std::vector<long double>{1, 2, 3}, 1.0)), IntegratedSignal<long double>>);
  STATIC_CHECK(!Signal<int>);
  STATIC_CHECK(!Signal<std::vector<std::string>>);
}

TEMPLATE_TEST_CASE("Sums about the mean are exact to the last bit of what they sum", "", double, long double) {
  using Scalar = TestType;
  // Specific force in units of 1/1024: all values and sums are representable, and the mean is one of them.
  Integers integers = noisy_integers(300'000, 10'000, 3, 0.05);
  std::int64_t total = phase_of(integers).back(), count = std::ssize(integers);
  const std::int64_t mean = total / count;
  integers.push_back((count + 1) * mean - total);
  const auto exact = phase_of(integers);
  const IntegratedSignal<Scalar> signal(scaled(integers, Scalar(1) / 1024), 200);
  CHECK(signal.samples() == count + 1);
  CHECK(signal.mean() == static_cast<Scalar>(mean) / 1024);
  CHECK(signal.rate() == 200);
  CHECK_THAT(static_cast<double>(signal.duration()), WithinRel(static_cast<double>(count + 1) / 200, 1e-15));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const std::int64_t expected = exact[i] - static_cast<std::int64_t>(i) * mean;
    if (signal.sums()[i] * signal.unit() * 1024 != static_cast<Scalar>(expected)) ++wrong;
  }
  CHECK(wrong == 0);
}

TEMPLATE_TEST_CASE("An integral has the sums of its rates", "", double, long double) {
  using Scalar = TestType;
  const Integers integers = noisy_integers(1000, 5, 30, 0);
  for (Scalar rate : {Scalar(1), Scalar(200), Scalar(1) / 42}) {
    const IntegratedSignal<Scalar> of_rates(scaled(integers, Scalar(1)), rate);
    const auto angles = scaled(phase_of(integers), 1 / rate);
    auto shifted = angles;
    for (Scalar& angle : shifted) angle += 7;
    for (const auto& integral : {angles, shifted}) {
      const auto of_integral = IntegratedSignal<Scalar>::from_integral(integral, rate);
      REQUIRE(of_integral.samples() == 1000);
      CHECK(of_integral.rate() == rate);
      CHECK_THAT(static_cast<double>(of_integral.mean()), WithinRel(static_cast<double>(of_rates.mean()), 1e-12));
      for (std::size_t i = 0; i <= 1000; ++i) {
        const Scalar difference = of_integral.sums()[i] * of_integral.unit() - of_rates.sums()[i] * of_rates.unit();
        if (!(std::abs(difference) <= 1e-10)) FAIL_CHECK("sum " << i << " is off by " << difference);
      }
    }
  }
}

TEST_CASE("Signals of any magnitude have sums near 1") {
  for (double magnitude : {5e-324, 1e-310, 1e-300, 1e-9, 1.0, 1e9, 1e300, 8e307}) {
    INFO("magnitude " << magnitude);
    const std::vector<double> y{0, magnitude, magnitude, 0, magnitude, 0, 0, 0};
    const IntegratedSignal signal(y, 200.0);
    CHECK(std::isfinite(signal.unit()));
    CHECK(std::isfinite(signal.mean()));
    for (const double x : signal.sums()) CHECK(std::abs(x) <= 4);
    const double range = *std::max_element(signal.sums().begin(), signal.sums().end()) -
                         *std::min_element(signal.sums().begin(), signal.sums().end());
    CHECK(range >= (magnitude < 1e-308 ? 1e-17 : 0.5));
  }
}

TEST_CASE("What is no log is refused") {
  const std::vector<double> good{1, 2, 3};
  CHECK(refusal(good, 0) == "Allan analysis: rate is 0, expected a finite number > 0");
  CHECK(refusal(good, -200) == "Allan analysis: rate is -200, expected a finite number > 0");
  CHECK(refusal(good, not_a_number) == "Allan analysis: rate is nan, expected a finite number > 0");
  CHECK(refusal(good, infinity) == "Allan analysis: rate is inf, expected a finite number > 0");
  // At which identification would look for times up to infinity, for ever.
  CHECK(refusal(good, 1e-307) ==
        "Allan analysis: rate is 1e-307, expected one at which the times and frequencies of the signal are "
        "representable");
  CHECK(refusal(good, 1e-305) == "nothing thrown");
  CHECK(refusal(good, 1e307).find("rate is 1e+307, expected one at which the times and frequencies") !=
        std::string::npos);
  CHECK(refusal(good, 1e304) == "nothing thrown");
  CHECK(refusal(std::vector<double>{}) == "Allan analysis: 0 values, expected at least 3");
  CHECK(refusal(std::vector<double>{1, 2}) == "Allan analysis: 2 values, expected at least 3");
  CHECK(refusal(std::vector<double>{1, 2, not_a_number, 3, infinity}) ==
        "Allan analysis: value 2 is nan, expected a finite number");
  CHECK(refusal(std::vector<double>{1, 2, 3, -infinity}) ==
        "Allan analysis: value 3 is -inf, expected a finite number");
  CHECK(refusal(std::vector<float>{std::numeric_limits<float>::quiet_NaN(), 2, 3}) ==
        "Allan analysis: value 0 is nan, expected a finite number");
  CHECK(refusal(std::vector<double>(100, 9.81)) ==
        "Allan analysis: the signal is constant (9.81): a sensor that is stuck, or no noise at all");
  CHECK(refusal(std::vector<int>(100, 0)) ==
        "Allan analysis: the signal is constant (0): a sensor that is stuck, or no noise at all");
  CHECK(refusal(std::vector<double>{1, 1, 1 + 1e-15}) == "nothing thrown");
}

TEST_CASE("What is no integral of a log is refused") {
  const auto refusal_of = [](const std::vector<double>& x, double rate = 200) {
    return message_of([&] { return IntegratedSignal<double>::from_integral(x, rate); });
  };
  CHECK(refusal_of({0, 1, 2, 4}, 0) == "Allan analysis: rate is 0, expected a finite number > 0");
  CHECK(refusal_of({0, 1, 2}) == "Allan analysis: 3 values, expected at least 4");
  CHECK(refusal_of({0, 1, not_a_number, 2}) == "Allan analysis: value 2 is nan, expected a finite number");
  CHECK(refusal_of({0, 1, 2, 4}) == "nothing thrown");
  CHECK(refusal_of({0, 1e300, 2e300, 4e300}, 1e10) ==
        "Allan analysis: rate is 1e+10, expected one at which the rate signal does not overflow");
  std::vector<double> line;
  for (int i = 0; i < 1000; ++i) line.push_back(5 + 0.1 * i);
  CHECK(refusal_of(line, 10).starts_with("Allan analysis: the signal is constant (1"));
  CHECK(refusal_of(std::vector<double>(9, 3.0)).starts_with("Allan analysis: the signal is constant (0)"));
}
