// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <splinertia/allan/expected_accuracy.hpp>
#include <stdexcept>
#include <string>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia::allan;
using splinertia::testing::message_of;

namespace {

/// From the Fisher information of q = K²/rate and r = N²·rate, term by term.
ExpectedAccuracy<long double> exact(long double rate, std::int64_t n, long double N, long double K) {
  const long double q = K * K / rate, r = N * N * rate, pi = std::acos(-1.0L);
  long double qq = 0, qr = 0, rr = 0;
  for (std::int64_t k = 1; k < n; ++k) {
    const long double sine = std::sin(pi * static_cast<long double>(k) / (2 * static_cast<long double>(n)));
    const long double s = 4 * sine * sine, power = q + r * s;
    qq += 1 / (2 * power * power);
    qr += s / (2 * power * power);
    rr += s * s / (2 * power * power);
  }
  // The relative error of a root is half that of its square.
  return {1 / std::sqrt(rr - qr * (qr / qq)) / (2 * r), 1 / std::sqrt(qq - qr * (qr / rr)) / (2 * q)};
}

}  // namespace

TEMPLATE_TEST_CASE("Accuracies are the bound of Cramer and Rao", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar rate = 100;
  for (std::int64_t n : {3, 4, 5, 10, 100, 129, 130, 131, 140, 200, 1000, 30'000}) {
    for (double share : {1e-9, 1e-6, 1e-3, 1e-2, 0.1, 0.5, 1.0, 3.0, 10.0, 1e3, 1e6, 1e9}) {
      const auto ratio = static_cast<Scalar>(share);
      INFO(n << " samples, K/N " << ratio * rate);
      const auto accuracy = expected_accuracy(rate, static_cast<Scalar>(n) / rate, 2, 2 * ratio * rate);
      const auto expected = exact(100, n, 2, 2 * static_cast<long double>(ratio) * 100);
      const double tolerance = std::same_as<Scalar, float> ? 2e-5 : 4e-6;
      CHECK_THAT(static_cast<double>(accuracy.N / expected.N), WithinRel(1.0, tolerance));
      CHECK_THAT(static_cast<double>(accuracy.K / expected.K), WithinRel(1.0, tolerance));
    }
  }
}

TEST_CASE("Accuracies of two hours at 200 Hz") {
  CHECK_THAT(expected_accuracy(200.0, 7200, 0.015, 5e-5).K, WithinAbs(0.302, 5e-4));
  CHECK_THAT(expected_accuracy(200.0, 7200, 0.015, 1e-5).K, WithinAbs(0.844, 5e-4));
  CHECK_THAT(expected_accuracy(200.0, 7200, 0.019, 1e-4).K, WithinAbs(0.236, 5e-4));
  CHECK_THAT(expected_accuracy(200.0, 7200, 0.019, 1e-4).N, WithinAbs(0.0006, 5e-5));
}

TEST_CASE("What accuracies tend to, and where") {
  for (double x : {5.0, 7.0, 10.0, 30.0, 100.0, 1e4}) {
    for (double corner : {50.0, 300.0, 1e5}) {  // N·rate/K
      INFO("K·duration/N " << x << ", N·rate/K " << corner);
      const double rate = 123, N = 0.3, K = N * rate / corner, n = std::round(x * corner);
      const auto accuracy = expected_accuracy(rate, n / rate, N, K);
      CHECK_THAT(accuracy.N, WithinRel(1 / std::sqrt(2 * n), 1.3e-2));
      CHECK_THAT(accuracy.K, WithinRel(std::sqrt(2 / (x - 2)), 1e-2));
    }
  }
}

TEST_CASE("Accuracies of extreme sensors are numbers or infinite") {
  for (double rate : {1e-10, 1.0, 1e10}) {
    for (double N : {5e-324, 1e-300, 1.0, 1e300}) {
      for (double K : {5e-324, 1e-300, 1.0, 1e300}) {
        for (double samples : {3.0, 1e3, 1e18}) {
          const auto accuracy = expected_accuracy(rate, samples / rate, N, K);
          if (!(accuracy.N > 0 && accuracy.K > 0)) FAIL_CHECK(accuracy.N << " and " << accuracy.K);
        }
      }
    }
  }
}

TEST_CASE("How long to record") {
  for (double error : {2.0, 0.8, 0.3, 0.1, 0.001}) {
    const double duration = duration_for_random_walk(200.0, 0.015, 5e-5, error);
    CHECK_THAT(expected_accuracy(200.0, duration, 0.015, 5e-5).K, WithinRel(error, 1e-4));
    if (error < 0.9) CHECK_THAT(duration, WithinRel((2 + 2 / (error * error)) * 300, 0.02));
  }
  CHECK(duration_for_random_walk(200.0, 1e-9, 1.0, 10.0) <= 3.01 / 200);  // as short as a log can be
  CHECK_THAT(duration_for_random_walk(1.0, 1e8, 1e-8, 1.0), WithinRel(4e16, 0.2));
  CHECK(std::isinf(duration_for_random_walk(200.0, 1e200, 1e-200, 0.1)));
  CHECK_THAT(duration_for_random_walk(200.0f, 0.015f, 5e-5f, 0.3f), WithinRel(7267.0f, 1e-3f));
}

TEST_CASE("Accuracies of what is no log are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](double rate, double duration, double N, double K) {
    return message_of([&] { return expected_accuracy(rate, duration, N, K); });
  };
  CHECK(refusal(0, 1, 1, 1) == "expected_accuracy: rate is 0, expected a finite number > 0");
  CHECK(refusal(nan, 1, 1, 1) == "expected_accuracy: rate is nan, expected a finite number > 0");
  CHECK(refusal(200, -1, 1, 1) == "expected_accuracy: duration is -1, expected a finite number > 0");
  CHECK(refusal(200, 0.01, 1, 1) == "expected_accuracy: duration is 0.01, expected 3 to 2^62 samples");
  CHECK(refusal(1e200, 1e200, 1, 1) == "expected_accuracy: duration is 1e+200, expected 3 to 2^62 samples");
  CHECK(refusal(200, 1, 0, 1) == "expected_accuracy: N is 0, expected a finite number > 0");
  CHECK(refusal(200, 1, 1, 0) == "expected_accuracy: K is 0, expected a finite number > 0");
  CHECK(refusal(200, 1, 1, nan) == "expected_accuracy: K is nan, expected a finite number > 0");
  CHECK(message_of([] { return duration_for_random_walk(200.0, 1, 1, 0); }) ==
        "duration_for_random_walk: relative_error is 0, expected a finite number > 0");
  CHECK_THROWS_AS(duration_for_random_walk(-200.0, 1, 1, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(duration_for_random_walk(200.0, 0, 1, 0.1), std::invalid_argument);
}
