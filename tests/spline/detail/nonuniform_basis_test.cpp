// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <ratio>
#include <splinertia/spline/detail/nonuniform_basis.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <int Order, int D, typename Scalar = double, typename Time>
CumulativeBasis<Scalar, Order, D> basis_at(const std::vector<Time>& knots, std::size_t span, Time t) {
  constexpr std::size_t size = 2 * Order - 2;
  return nonuniform_basis<Order, D, Scalar>(std::span<const Time, size>(knots.data() + span + 2 - Order, size), t);
}

/// Clustered: spans of 1e-6 beside spans of 1. Mixed: 1e-3, 1 and 1e3, ratio 1e6.
const std::vector<double> mild{0, 0.9, 2, 3.1, 3.9, 5.2, 6.1, 6.8, 8, 9.3, 10, 11.2, 12.1, 13.3, 14, 15.2};
const std::vector<double> clustered{0, 1, 1 + 1e-6, 1 + 2e-6, 2, 3, 3 + 1e-6, 4, 5, 6, 6 + 1e-6, 6 + 2e-6, 7, 8, 9, 10};
const std::vector<double> mixed{0,    1e-3,     1,        1e3,   1001,      1001.001, 1001.002, 2001,
                                2002, 2002.001, 3002.001, 3003., 3003.0005, 3003.001, 4003.,    5003.};

/// The largest disagreement, in eps of the larger side or of `size`, of derivative d on both sides of a knot that is
/// there `multiplicity` times up to index `last`. Λ_j of a control point left of those that the span knows is 1, right
/// of them 0.
template <int Order, int D>
double jump(const std::vector<double>& knots, std::size_t last, std::size_t multiplicity, std::size_t d) {
  const std::size_t first = last + 1 - multiplicity;
  const double t = knots[last];
  const auto left = basis_at<Order, D>(knots, first - 1, t).lambda[d];
  const auto right = basis_at<Order, D>(knots, last, t).lambda[d];
  const double one = d == 0 ? 1 : 0;
  double largest = 0, size = one;
  for (const auto& side : {left, right}) {
    for (const double x : side) size = std::max(size, std::abs(x));
  }
  for (std::size_t j = 0; j < left.size() + multiplicity; ++j) {
    const double before = j < left.size() ? left[j] : 0;
    const double after = j >= multiplicity ? right[j - multiplicity] : one;
    largest = std::max(largest, std::abs(before - after));
  }
  return largest / size;
}

template <int Order>
void check_continuity(const std::vector<double>& knots) {
  for (std::size_t i = Order; i + Order < knots.size(); ++i) {
    for (std::size_t d = 0; d <= 3; ++d) {
      INFO("order " << Order << ", knot " << i << ", derivative " << d);
      if (d <= Order - 2) {
        CHECK(jump<Order, 3>(knots, i, 1, d) < 1e-14);
      } else if (d == Order - 1) {
        CHECK(jump<Order, 3>(knots, i, 1, d) > 1e-3);
      }
    }
  }
}

template <int Order, typename Scalar>
void check_uniform() {
  INFO("order " << Order);
  std::vector<double> knots;  // exact in every Scalar
  for (int i = 0; i < 2 * Order; ++i) knots.push_back(-7 + 0.25 * i);
  const std::size_t span = Order - 1;
  for (const double u : {0.0, 0.125, 0.4, 0.75, 1.0}) {
    const double t = knots[span] + 0.25 * u;
    const auto same_u = static_cast<Scalar>((t - knots[span]) / 0.25);
    const auto expected = uniform_basis<Order, 3>(same_u, Scalar(0.25));
    const auto got = basis_at<Order, 3, Scalar>(knots, span, t);
    for (std::size_t m = 0; m <= 3; ++m) {
      Scalar size = 1;
      for (const Scalar x : expected.lambda[m]) size = std::max(size, std::abs(x));
      for (std::size_t j = 0; j + 1 < Order; ++j) {
        CHECK(std::abs(got.lambda[m][j] - expected.lambda[m][j]) <= 5 * std::numeric_limits<Scalar>::epsilon() * size);
      }
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Knots at equal distances give the uniform basis", "", float, double, long double) {
  check_uniform<2, TestType>();
  check_uniform<3, TestType>();
  check_uniform<4, TestType>();
  check_uniform<5, TestType>();
  check_uniform<6, TestType>();
  check_uniform<7, TestType>();
  check_uniform<8, TestType>();
}

TEST_CASE("Between knots that all coincide the basis is that of Bernstein") {
  const std::vector<double> knots{2, 2, 2, 4, 4, 4};
  const double u = 0.3, v = 0.7, t = 2.6;
  const auto basis = nonuniform_basis<4, 3, double>(std::span<const double, 6>(knots), t);
  const double expected[4][3] = {{1 - v * v * v, u * u * (3 - 2 * u), u * u * u},
                                 {3 * v * v / 2, 6 * u * v / 2, 3 * u * u / 2},
                                 {-6 * v / 4, 6 * (1 - 2 * u) / 4, 6 * u / 4},
                                 {6.0 / 8, -12.0 / 8, 6.0 / 8}};
  for (std::size_t m = 0; m <= 3; ++m) {
    for (std::size_t j = 0; j < 3; ++j) CHECK_THAT(basis.lambda[m][j], WithinAbs(expected[m][j], 2e-15));
  }
}

TEST_CASE("The basis is as smooth as the order, however unequal the spans") {
  for (const auto* knots : {&mild, &clustered, &mixed}) {
    check_continuity<2>(*knots);
    check_continuity<3>(*knots);
    check_continuity<4>(*knots);
    check_continuity<5>(*knots);
    check_continuity<6>(*knots);
  }
}

TEST_CASE("Each knot more at the same place costs one derivative") {
  const std::vector<double> knots{0, 1, 2, 3, 4, 5, 5, 5, 6, 7, 8, 9, 10};  // 5 three times, the last at 7
  CHECK(jump<4, 3>(knots, 7, 3, 0) < 1e-15);
  CHECK(jump<4, 3>(knots, 7, 3, 1) > 0.1);
  CHECK(jump<5, 3>(knots, 7, 3, 1) < 1e-15);
  CHECK(jump<5, 3>(knots, 7, 3, 2) > 0.1);
  CHECK(jump<6, 3>(knots, 7, 3, 2) < 1e-15);
  CHECK(jump<6, 3>(knots, 7, 3, 3) > 0.1);
  const std::vector<double> twice{0, 1, 2, 3, 4, 5, 5, 6, 7, 8, 9};
  CHECK(jump<3, 3>(twice, 6, 2, 0) < 1e-15);
  CHECK(jump<3, 3>(twice, 6, 2, 1) > 0.1);
  CHECK(jump<4, 3>(twice, 6, 2, 1) < 1e-15);
  CHECK(jump<4, 3>(twice, 6, 2, 2) > 0.1);
}

TEST_CASE("Weights fall from 1 to 0: those of the plain basis are positive and sum to 1") {
  for (const auto* knots : {&mild, &clustered, &mixed}) {
    for (std::size_t span = 5; span < 10; ++span) {
      const double a = (*knots)[span], b = (*knots)[span + 1];
      for (const double t : {a, a + (b - a) / 3, b}) {
        double above = 1;
        const auto basis = basis_at<6, 0>(*knots, span, t);
        for (const double x : basis.lambda[0]) {
          CHECK(x >= 0);
          CHECK(x <= above + 4e-16);
          above = x;
        }
      }
    }
  }
}

TEST_CASE("Derivatives of a basis of any knots are those of its values") {
  const std::size_t span = 7;
  const double t = 7.3, h = 0.02;
  const auto at = [&](double shift) { return basis_at<6, 3>(mild, span, t + shift).lambda; };
  for (std::size_t m = 1; m <= 3; ++m) {
    for (std::size_t j = 0; j < 5; ++j) {  // exact for polynomials of degree 5 but for rounding
      const double difference =
          (45 * (at(h)[m - 1][j] - at(-h)[m - 1][j]) - 9 * (at(2 * h)[m - 1][j] - at(-2 * h)[m - 1][j]) +
           (at(3 * h)[m - 1][j] - at(-3 * h)[m - 1][j])) /
          (60 * h);
      CHECK_THAT(at(0)[m][j], WithinAbs(difference, 1e-12));
    }
  }
}

TEST_CASE("Derivatives above the degree are zero") {
  const auto basis = basis_at<2, 3>(mild, 6, 6.5);
  CHECK_THAT(basis.lambda[1][0], WithinRel(1 / 0.7, 1e-14));
  CHECK(basis.lambda[2][0] == 0);
  CHECK(basis.lambda[3][0] == 0);
  CHECK(basis_at<3, 3>(mild, 6, 6.5).lambda[3] == std::array<double, 2>{0, 0});
}

TEST_CASE("Asking for fewer derivatives gives the same numbers") {
  const auto three = basis_at<5, 3>(clustered, 6, 3.25);
  const auto two = basis_at<5, 2>(clustered, 6, 3.25);
  const auto none = basis_at<5, 0>(clustered, 6, 3.25);
  CHECK(three.lambda[0] == none.lambda[0]);
  CHECK(three.lambda[1] == two.lambda[1]);
  CHECK(three.lambda[2] == two.lambda[2]);
}

TEST_CASE("Derivatives are per second, whatever the ticks of time") {
  using Frame = std::chrono::duration<std::int64_t, std::ratio<1001, 30000>>;
  const int frames[] = {0, 30, 45, 90, 150, 165};
  std::vector<Frame> ticks;
  std::vector<double> seconds;
  for (const int frame : frames) {
    ticks.emplace_back(frame);
    seconds.push_back(frame * 1001.0 / 30000.0);
  }
  const auto a = basis_at<4, 3>(ticks, 2, Frame{60});
  const auto b = basis_at<4, 3>(seconds, 2, 60 * 1001.0 / 30000.0);
  for (std::size_t m = 0; m <= 3; ++m) {
    for (std::size_t j = 0; j < 3; ++j) CHECK_THAT(a.lambda[m][j], WithinAbs(b.lambda[m][j], 1e-14));
  }
}
