// SPDX-License-Identifier: MIT
#include <splinertia/group/detail/economized_series.hpp>
#include <splinertia/group/detail/stumpff.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// Σ (−x)^m/(2m + n)! to the precision of long double.
long double series(int n, long double x) {
  long double term = 1, sum = 0;
  for (int i = 2; i <= n; ++i) term /= i;
  for (int m = 0; m < 40; ++m) {
    sum += term;
    term *= -x / static_cast<long double>((2 * m + n + 1) * (2 * m + n + 2));
  }
  return sum;
}

template <int n, int terms>
long double largest_error(long double length) {
  constexpr auto a = economized_series<long double, terms>(n, 2.4675L);
  long double largest = 0;
  for (int i = 0; i <= 1000; ++i) {
    const long double x = length * static_cast<long double>(i) / 1000;
    long double sum = 0;
    for (int m = terms; m-- > 0;) sum = sum * x + a[static_cast<std::size_t>(m)];
    largest = std::max(largest, std::abs(sum - series(n, x)));
  }
  return largest;
}

}  // namespace

TEST_CASE("an economized series is as near as it says, and not much nearer") {
  // 2 (length/4)^Terms/(2 Terms + n)! is the term that was left out last; what was left out before is less than a
  // tenth.
  const auto bound = [](int n, int terms) {
    long double x = 2;
    for (int i = 0; i < terms; ++i) x *= 2.4675L / 4;
    for (int i = 2; i <= 2 * terms + n; ++i) x /= i;
    return x;
  };
  CHECK(largest_error<0, 3>(2.4675L) < 1.1L * bound(0, 3));
  CHECK(largest_error<0, 3>(2.4675L) > 0.8L * bound(0, 3));
  CHECK(largest_error<2, 5>(2.4675L) < 1.1L * bound(2, 5));
  CHECK(largest_error<2, 5>(2.4675L) > 0.8L * bound(2, 5));
  CHECK(largest_error<3, 7>(2.4675L) < 1.1L * bound(3, 7));
  CHECK(largest_error<3, 7>(2.4675L) > 0.8L * bound(3, 7));
}

TEST_CASE("economizing spares terms") {
  constexpr long double eps = std::numeric_limits<double>::epsilon(), eps_float = std::numeric_limits<float>::epsilon();
  for (const int n : {2, 3, 4, 5, 6, 7}) {
    CAPTURE(n);
    CHECK(economized_terms(n, stumpff_reach, eps / 8) < stumpff_terms(n, 53));
    CHECK(economized_terms(n, stumpff_reach, eps_float / 8) <= stumpff_terms(n, 24));
  }
  // What the arithmetic of dense sampling is counted with.
  CHECK(economized_terms(2, stumpff_reach, eps / 8) == 8);
  CHECK(economized_terms(3, stumpff_reach, eps / 8) == 8);
}
