// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/output/spikes.hpp>

#include "errors/one_term.hpp"
#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

TEMPLATE_TEST_CASE("Each axis has spikes of its own, as many and as large as asked for", "", float, double) {
  using Scalar = TestType;
  const double p[] = {0.01, 0.1, 1}, deviation[] = {5, 1, 0.5};
  const ErrorModel model{Spikes{per_axis<Scalar>(p), per_axis<Scalar>(deviation)}};
  const Record errors = record<Scalar>(model, regular(200), 3);
  CHECK(errors.no_bias);
  std::size_t both = 0;
  for (std::size_t i = 0; i < million; ++i) both += errors.axes[0][i] != 0 && errors.axes[1][i] != 0;
  CHECK(std::abs(static_cast<double>(both) - 1000) < 4 * std::sqrt(1000.0));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double count = 0, squares = 0;
    for (const double x : errors.axes[axis]) {
      count += x != 0;
      squares += x * x;
    }
    const double expected = p[axis] * million;
    CHECK(std::abs(count - expected) <= 4 * std::sqrt(expected * (1 - p[axis])));
    CHECK(std::abs(squares / count / (deviation[axis] * deviation[axis]) - 1) < 4 * std::sqrt(2 / count));
  }
}

TEST_CASE("More spikes include the fewer; none change nothing") {
  const auto few = record<double>(ErrorModel{Spikes{0.01, 5}}, regular(200, 10'000), 1).axes[0];
  const auto many = record<double>(ErrorModel{Spikes{0.1, 5}}, regular(200, 10'000), 1).axes[0];
  for (std::size_t i = 0; i < few.size(); ++i) REQUIRE((few[i] == 0 || few[i] == many[i]));
  const auto none = record<double>(ErrorModel{Spikes{0, 5}}, regular(200, 10'000), 1).axes[0];
  CHECK(none == std::vector<double>(10'000, 0.0));
}

TEST_CASE("Spikes are described and checked") {
  CHECK(describe(Spikes{0.01, 5}, "m") == "spikes: probability 0.01, standard deviation 5 m");
  CHECK_THROWS_WITH((Spikes{1.5, 5}), "Spikes: probability is 1.5, expected a number >= 0 and <= 1");
  CHECK_THROWS_AS((Spikes{0.5, -5}), std::invalid_argument);
  CHECK_THROWS_AS((Spikes{testing::nan<double>, 5}), std::invalid_argument);
}
