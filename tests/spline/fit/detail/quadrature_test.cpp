// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/spline/fit/detail/quadrature.hpp>
#include <utility>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

template <typename Scalar>
Scalar power(Scalar x, int exponent) {
  Scalar result(1);
  for (int i = 0; i < exponent; ++i) result *= x;
  return result;
}

template <typename Scalar, int n>
void check_quadrature() {
  INFO(n << " nodes");
  constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  const Quadrature<Scalar, n> quadrature;
  const auto integral = [&](int degree) {
    Scalar sum(0);
    for (std::size_t i = 0; i < n; ++i) sum += quadrature.weight[i] * power(quadrature.node[i], degree);
    return sum;
  };
  for (int degree = 0; degree <= 2 * n - 1; ++degree) {
    INFO("degree " << degree);
    CHECK(std::abs(integral(degree) - Scalar(1) / Scalar(degree + 1)) <= 4 * epsilon);
  }
  // The first that it misses, by (n!)⁴/((2n + 1) (2n)!²), which tells Gauss's nodes from any others.
  Scalar miss = Scalar(1) / Scalar(2 * n + 1);
  for (int i = 1; i <= n; ++i) miss *= power(Scalar(i) / Scalar(n + i), 2);
  CHECK(std::abs(Scalar(1) / Scalar(2 * n + 1) - integral(2 * n) - miss) <= 4 * epsilon);

  for (std::size_t i = 0; i < n; ++i) {
    CHECK(quadrature.node[i] > (i == 0 ? Scalar(0) : quadrature.node[i - 1]));
    CHECK(quadrature.node[i] < 1);
    CHECK(quadrature.weight[i] > 0);
  }
  for (int degree = 0; degree < n; ++degree) {
    INFO("degree " << degree);
    std::array<Scalar, n> values;
    for (std::size_t i = 0; i < n; ++i) values[i] = power(quadrature.node[i], degree);
    const auto slope = quadrature.differentiated(values);
    // Entries of the matrix reach 1/(distance of nodes) ~ n².
    const Scalar rounding = 16 * n * n * epsilon;
    for (std::size_t i = 0; i < n; ++i) {
      const Scalar expected = degree == 0 ? Scalar(0) : Scalar(degree) * power(quadrature.node[i], degree - 1);
      CHECK(std::abs(slope[i] - expected) <= rounding);
    }
    for (const Scalar x : {Scalar(0), Scalar(0.3f), Scalar(1)}) {
      CHECK(std::abs(quadrature.value_at(x, values) - power(x, degree)) <= rounding);
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("n nodes integrate polynomials up to degree 2n - 1 and differentiate up to n - 1", "", float, double,
                   long double) {
  [&]<int... i>(std::integer_sequence<int, i...>) {
    (check_quadrature<TestType, i + 1>(), ...);
  }(std::make_integer_sequence<int, 7>());
}

TEST_CASE("A share of a length of time") {
  CHECK(fraction_of(8.0, 0.25) == 2);
  CHECK(fraction_of(8.0f, 0.25L) == 2);
  CHECK(fraction_of(nanoseconds{1001}, 0.5) == nanoseconds{500});
  CHECK(fraction_of(nanoseconds{1001}, 1.0f) == nanoseconds{1001});
  CHECK(fraction_of(nanoseconds{10}, 0.0L) == nanoseconds{0});
}
