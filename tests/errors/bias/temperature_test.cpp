// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/errors/bias/temperature.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("A profile is any callable that turns seconds into degrees") {
  STATIC_CHECK(TemperatureProfile<WarmUp<double>, double>);
  STATIC_CHECK(TemperatureProfile<double (*)(double), double>);
  const auto lambda = [](double elapsed) { return 20 + elapsed; };
  STATIC_CHECK(TemperatureProfile<decltype(lambda), double>);
  STATIC_CHECK(!TemperatureProfile<double, double>);
  const auto changes = [n = 0](double) mutable { return ++n; };  // one model serves many runs and threads
  STATIC_CHECK(!TemperatureProfile<decltype(changes), double>);
}

TEMPLATE_TEST_CASE("A sensor warms up from the initial to the final temperature", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const WarmUp<Scalar> profile{20, 60, 300};
  CHECK(profile(Scalar(0)) == 20);
  CHECK(profile(Scalar(1e9)) == 60);
  for (const Scalar& t : {Scalar(1e-3), Scalar(1), Scalar(300), Scalar(2000)}) {
    CHECK(std::abs(profile(t) - (60 - 40 * std::exp(-t / 300))) <= 4 * eps * 60);
    CHECK(std::abs(WarmUp<Scalar>{60, 20, 300}(t) - (20 + 40 * std::exp(-t / 300))) <= 4 * eps * 60);
  }
}

TEST_CASE("A warm-up is as good in whole numbers, and while compiling") {
  STATIC_CHECK(std::is_same_v<decltype(WarmUp{20, 60, 300}), WarmUp<double>>);
  STATIC_CHECK(std::is_same_v<decltype(WarmUp{20.0, 60, 300.0F}), WarmUp<double>>);
  STATIC_CHECK(std::is_same_v<decltype(WarmUp{20.0F, 60.0F, 300.0F}), WarmUp<float>>);
  CHECK_THAT((WarmUp{20, 60, 300}(300.0)), WithinAbs(60 - 40 / std::exp(1.0), 1e-13));
  constexpr WarmUp constant{20, 60, 300};
  STATIC_CHECK(constant.time_constant == 300.0);
}

TEST_CASE("A warm-up that cannot be is refused") {
  CHECK_THROWS_WITH((WarmUp{testing::nan<double>, 1.0, 1.0}),
                    "WarmUp: initial temperature is nan, expected a finite number");
  CHECK_THROWS_WITH((WarmUp{1.0, -testing::infinity<double>, 1.0}),
                    "WarmUp: final temperature is -inf, expected a finite number");
  CHECK_THROWS_WITH((WarmUp{1, 1, 0}), "WarmUp: time constant is 0, expected a finite number > 0");
  CHECK_THROWS_WITH((WarmUp{1, 1, -3}), "WarmUp: time constant is -3, expected a finite number > 0");
  CHECK_THROWS_AS((WarmUp{1.0, 1.0, testing::infinity<double>}), std::invalid_argument);
}
