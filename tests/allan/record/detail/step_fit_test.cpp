// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <splinertia/allan/record/detail/step_fit.hpp>
#include <splinertia/random/normal.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::allan;
using namespace splinertia::allan::detail;

namespace {

/// White noise with deviation 1, a change of some height and duration that begins at a sample, and a line.
std::vector<double> change(std::int64_t begin, double height, std::int64_t duration = 0, double slope = 0,
                           std::uint64_t seed = 0) {
  NormalStream<> normal(StreamKey(seed) / 1);
  std::vector<double> window(8000);
  for (std::size_t i = 0; i < window.size(); ++i) {
    const double share =
        static_cast<double>(static_cast<std::int64_t>(i) - begin + 1) / static_cast<double>(duration + 1);
    window[i] = normal() + slope * static_cast<double>(i) + height * std::clamp(share, 0.0, 1.0);
  }
  return window;
}

}  // namespace

TEST_CASE("a sudden step is fitted, with its error") {
  double squares = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto window = change(4321, 5, 0, 0, seed);
    const auto fit = StepFitter(window).fit(4000, 2000);
    REQUIRE(fit.has_value());
    CHECK(std::abs(fit->begin - 4321) <= 1);
    CHECK(fit->duration == 0);
    CHECK_FALSE(fit->is_knock);
    CHECK_THAT(fit->scatter, WithinAbs(std::sqrt(2.0 / 3679), 0.025));
    CHECK(fit->standard_error >= fit->scatter);
    squares += std::pow((fit->height - 5) / fit->standard_error, 2);
  }
  CHECK_THAT(std::sqrt(squares / 40), WithinAbs(1, 0.3));
}

TEST_CASE("a change that takes its time is fitted, with its duration") {
  const auto window = change(3500, 20, 800);
  const auto fit = StepFitter(window).fit(4000, 2000);
  REQUIRE(fit.has_value());
  CHECK_THAT(static_cast<double>(fit->begin), WithinAbs(3500, 10));
  CHECK_THAT(static_cast<double>(fit->duration), WithinAbs(800, 20));
  CHECK_THAT(fit->height, WithinAbs(20, 0.2));
}

TEST_CASE("a drift is not part of the height") {
  const auto window = change(4100, 3, 0, 2e-3);
  const auto fit = StepFitter(window).fit(4000, 2000);
  REQUIRE(fit.has_value());
  CHECK(std::abs(fit->begin - 4100) <= 5);
  CHECK_THAT(fit->height, WithinAbs(3, 4 * fit->standard_error));
  CHECK(fit->difference > 5);
  CHECK(fit->standard_error < 0.15);
}

TEST_CASE("two steps are not one that takes long") {
  auto window = change(3500, 8);
  for (std::size_t i = 4500; i < window.size(); ++i) window[i] += 6;
  const auto fit = StepFitter(window).fit(4000, 2000);
  REQUIRE(fit.has_value());
  CHECK(std::abs(fit->begin - 3500) <= 5);
  CHECK(fit->duration == 0);
  CHECK_THAT(fit->height, WithinAbs(8, 0.4));
}

TEST_CASE("a level that is left again at once is no step") {
  auto window = change(4000, 8);
  window.resize(4800);
  for (std::size_t i = 4100; i < window.size(); ++i) window[i] -= 8;
  window.erase(window.begin(), window.begin() + 3400);
  const auto fit = StepFitter(window).fit(620, 350);
  REQUIRE(fit.has_value());
  CHECK(fit->is_knock);
  CHECK(std::abs(fit->begin - 600) <= 1);
  CHECK(std::abs(fit->duration - 100) <= 1);
}

TEST_CASE("noise alone and windows without levels give nothing to believe") {
  const auto noise = change(0, 0);
  const auto fit = StepFitter(noise).fit(4000, 2000);
  REQUIRE(fit.has_value());
  CHECK(std::abs(fit->height) < 5 * fit->standard_error);
  const std::vector<double> short_window(31, 1.0);
  CHECK_FALSE(StepFitter(short_window).fit(15, 10).has_value());
}
