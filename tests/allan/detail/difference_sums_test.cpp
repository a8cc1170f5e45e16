// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <splinertia/allan/averaging_factors.hpp>
#include <splinertia/allan/detail/difference_sums.hpp>
#include <vector>

#include "allan/reference.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

/// The running sums of integers below 2³⁰ are exact in double, so that all error is of the sums of squares.
constexpr long double limit = 1e-13L;

template <typename Scalar>
void check_equal(Scalar value, Wide exact, long double tolerance = limit) {
  const auto expected = static_cast<long double>(exact);
  const long double error = std::abs(static_cast<long double>(value) - expected);
  if (!(error <= tolerance * expected)) FAIL_CHECK(value << " instead of " << expected);
}

template <int Order, typename Scalar>
void check_overlapping(const Integers& phase, const std::vector<std::int64_t>& factors) {
  const auto sums = overlapping_difference_sums<Order>(scaled(phase, Scalar(1)), factors);
  REQUIRE(sums.size() == factors.size());
  for (std::size_t j = 0; j < factors.size(); ++j) {
    INFO("order " << Order << ", " << phase.size() << " points, m = " << factors[j]);
    check_equal(sums[j], sum_of_squares(phase, factors[j], Order, 1));
  }
}

}  // namespace

TEST_CASE("Factors that double make chains") {
  const auto chains = doubling_chains({1, 2, 3, 4, 5, 6, 8, 12, 16, 32}, 4);
  REQUIRE(chains.size() == 4);
  CHECK(chains[0].first == 1);
  CHECK(chains[0].indices == std::vector<std::size_t>{0, 1, 3, 6});
  CHECK(chains[1].first == 3);
  CHECK(chains[1].indices == std::vector<std::size_t>{2, 5, 7});
  CHECK(chains[2].first == 5);
  CHECK(chains[2].indices == std::vector<std::size_t>{4});
  CHECK(chains[3].first == 16);
  CHECK(chains[3].indices == std::vector<std::size_t>{8, 9});
  CHECK(doubling_chains({1, 2, 4}, 1).size() == 3);
  CHECK(doubling_chains({}, 4).empty());
}

TEMPLATE_TEST_CASE("Overlapping sums are exact for logs of any length and all factors", "", double, long double) {
  // Lengths about the width of vectors (16) and tiles (1024), and where chains of 2, 3 and 4 factors end.
  for (std::size_t n : {3U, 4U, 5U, 15U, 16U, 17U, 31U, 33U, 64U, 100U, 333U}) {
    const Integers phase = phase_of(noisy_integers(n, 3, 100, 0));
    const auto length = static_cast<std::int64_t>(n);
    check_overlapping<2, TestType>(phase, AveragingFactors::all().up_to(length / 2));
    check_overlapping<3, TestType>(phase, AveragingFactors::all().up_to(length / 3));
  }
  for (std::size_t n : {1023U, 1024U, 1040U, 2047U, 2048U, 2064U, 5000U}) {
    const Integers phase = phase_of(noisy_integers(n, 3, 100, 0));
    const auto length = static_cast<std::int64_t>(n);
    for (const auto& grid : {AveragingFactors::octave(), AveragingFactors::decade(), AveragingFactors::logarithmic(),
                             AveragingFactors::given({length / 3, length / 7})}) {
      check_overlapping<2, TestType>(phase, grid.up_to(length / 2));
      check_overlapping<3, TestType>(phase, grid.up_to(length / 3));
    }
    check_overlapping<2, TestType>(phase, {length / 2});
    check_overlapping<3, TestType>(phase, {length / 3});
    check_overlapping<2, TestType>(phase, {});
  }
}

TEMPLATE_TEST_CASE("Sums of differences that do not overlap, of averaged and of reflected ones are exact", "", double,
                   long double) {
  for (std::size_t n : {3U, 4U, 5U, 6U, 16U, 100U, 333U, 1500U}) {
    const Integers phase = phase_of(noisy_integers(n, 3, 100, 0));
    const auto x = scaled(phase, TestType(1));
    const auto length = static_cast<std::int64_t>(n);
    for (std::int64_t m = 1; m <= length / 2; m += n > 400 ? 7 : 1) {
      INFO(n << " rates, m = " << m);
      check_equal(separate_difference_sum<2>(x, m), sum_of_squares(phase, m, 2, m));
      if (m <= length / 3) check_equal(separate_difference_sum<3>(x, m), sum_of_squares(phase, m, 3, m));
      if (m <= (length + 1) / 3) check_equal(modified_difference_sum(x, m), modified_sum_of_squares(phase, m));
      check_equal(reflected_difference_sum(x, m) + overlapping_difference_sums<2>(x, {m})[0],
                  total_sum_of_squares(phase, m));
    }
  }
}

TEST_CASE("Averaged differences are found anew before rounding has gathered") {
  // 8 m steps are carried, at least 1024.
  const Integers phase = phase_of(noisy_integers(200'000, 0, 10, 0.01));
  const auto x = scaled(phase, 0.1);
  for (std::int64_t m : {1, 2, 3, 100, 128, 129, 1000, 24'000, 24'999, 25'000, 60'000, 66'666, 66'667}) {
    INFO("m = " << m);
    check_equal(modified_difference_sum(x, m) * 100, modified_sum_of_squares(phase, m), 1e-12L);
  }
}
