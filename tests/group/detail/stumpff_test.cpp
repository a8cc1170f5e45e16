// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <random>
#include <splinertia/detail/pi.hpp>
#include <splinertia/group/detail/stumpff.hpp>
#include <vector>

#include "support/catch.hpp"

using splinertia::detail::stumpff;

namespace {

using namespace splinertia::detail;

using Real = long double;
constexpr Real pi = splinertia::detail::pi_of<Real>();

/// c_n(X) by its definition. Loses two digits of long double's nineteen at θ = 2π.
[[nodiscard]] Real series(int n, Real X) {
  Real term = 1;
  for (int i = 2; i <= n; ++i) term /= static_cast<Real>(i);
  Real sum = 0;
  for (int m = 0; m < 40; ++m) {
    sum += term;
    term *= -X / static_cast<Real>((2 * m + n + 1) * (2 * m + n + 2));
  }
  return sum;
}

/// Angles from 1e-12 on in even steps of their logarithm, then in even steps, up to `end`; as Scalars.
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> scan(Real begin, Real end) {
  std::vector<Scalar> angles;
  for (Real a = 1e-12L; a < std::min(1.0L, end); a *= 1.03L) {
    if (a >= begin) angles.push_back(static_cast<Scalar>(a));
  }
  std::mt19937_64 engine(5);
  for (int i = 0; i < 4000; ++i) {
    const Real a = begin + (end - begin) * static_cast<Real>(engine() >> 11) * 0x1p-53L;
    angles.push_back(static_cast<Scalar>(a));
  }
  return angles;
}

/// The largest |got − truth| / size over the angles, in eps of Scalar.
template <typename Scalar>
[[nodiscard]] double worst_error(Real begin, Real end, const auto& got, const auto& truth, const auto& size) {
  Real worst = 0;
  for (const Scalar theta : scan<Scalar>(begin, end)) {
    const Scalar X = theta * theta;
    const Real wide = static_cast<Real>(X);
    worst = std::max(worst, std::abs(static_cast<Real>(got(X)) - truth(wide)) / std::abs(size(wide)));
  }
  return static_cast<double>(worst / static_cast<Real>(std::numeric_limits<Scalar>::epsilon()));
}

[[nodiscard]] Real one(Real) { return 1; }

}  // namespace

// long double has no better reference here; tests/golden has it.
TEMPLATE_TEST_CASE("the coefficients keep full relative accuracy up to π", "[group]", float, double) {
  using Scalar = TestType;
  for (int n = 0; n <= 7; ++n) {
    INFO("c" << n);
    const auto i = static_cast<std::size_t>(n);
    const auto full = [&](Scalar X) { return stumpff<7>(X).full[i]; };
    const auto half = [&](Scalar X) { return stumpff<7>(X).half[i]; };
    const auto truth = [&](Real X) { return series(n, X); };
    const auto truth_half = [&](Real X) { return series(n, X / 4); };
    if (n < 2) {  // zero at π/2 and π: relative to the unit circle and, at half the angle, to sin(θ/2)/(θ/2)
      CHECK(worst_error<Scalar>(0, pi, full, truth, one) < 2.5);
    } else {
      CHECK(worst_error<Scalar>(0, pi, full, truth, truth) < 2.5);
    }
    if (n == 0) {
      CHECK(worst_error<Scalar>(0, pi, half, truth_half, one) < 1.5);
    } else {
      CHECK(worst_error<Scalar>(0, pi, half, truth_half, truth_half) < 1.5);
    }
  }
}

// What exp of a rotation takes, by a shorter way: cos(θ/2) in units of the unit circle, sin(θ/2)/(θ/2) in its own.
TEMPLATE_TEST_CASE("sine and cosine of the half angle err by less than 2 ulp", "[group]", float, double) {
  using Scalar = TestType;
  const auto half = [](std::size_t n) { return [n](Scalar X) { return stumpff<1>(X).half[n]; }; };
  const auto truth = [](int n) { return [n](Real X) { return series(n, X / 4); }; };
  CHECK(worst_error<Scalar>(0, pi, half(0), truth(0), one) < 1.2);
  CHECK(worst_error<Scalar>(0, pi, half(1), truth(1), truth(1)) < 1.2);
}

TEMPLATE_TEST_CASE("fewer coefficients are the same coefficients", "[group]", float, double, long double) {
  using Scalar = TestType;
  for (const Real angle : {0.0L, 1e-5L, 0.3L, 1.5L, 3.0L, 4.0L, 7.0L}) {
    const Scalar X = static_cast<Scalar>(angle * angle);
    const auto c1 = stumpff<1>(X);
    const auto c3 = stumpff<3>(X);
    const auto c5 = stumpff<5>(X);
    const auto c7 = stumpff<7>(X);
    const Scalar tolerance = 4 * std::numeric_limits<Scalar>::epsilon();
    CHECK(std::abs(c1.full[1] - c7.full[1]) <= tolerance);
    CHECK(std::abs(c3.full[3] - c7.full[3]) <= tolerance);
    CHECK(std::abs(c5.full[5] - c7.full[5]) <= tolerance);
    CHECK(c1.full.size() == 2);
  }
}

TEMPLATE_TEST_CASE("from π to 2π and beyond", "[group]", float, double) {
  using Scalar = TestType;
  for (int n = 0; n <= 7; ++n) {
    INFO("c" << n);
    const auto i = static_cast<std::size_t>(n);
    const auto full = [&](Scalar X) { return stumpff<7>(X).full[i]; };
    const auto truth = [&](Real X) { return series(n, X); };
    // c₀, c₁, c₂ have zeros there. Doubling twice costs twice the rounding of doubling once; c₀ = cos θ gets the
    // rounding of θ² as well, θ eps/2 up to 2π.
    if (n == 0) {
      CHECK(worst_error<Scalar>(pi, 2 * pi, full, truth, one) < 8);
    } else if (n <= 2) {
      CHECK(worst_error<Scalar>(pi, 2 * pi, full, truth, one) < 4);
    } else {
      CHECK(worst_error<Scalar>(pi, 2 * pi, full, truth, truth) < 5);
    }
    // Closed forms: sine and cosine of √X, whose rounding is θ eps/2 in the angle.
    if (n <= 1) CHECK(worst_error<Scalar>(2 * pi, 3 * pi, full, truth, one) < 8);
  }
}

TEMPLATE_TEST_CASE("at zero the coefficients are 1/n!", "[group]", float, double, long double) {
  const auto c = stumpff<7>(TestType(0));
  TestType factorial(1);
  for (std::size_t n = 0; n <= 7; ++n) {
    if (n > 1) factorial *= static_cast<TestType>(n);
    CHECK(std::abs(c.full[n] * factorial - 1) <= std::numeric_limits<TestType>::epsilon());
    CHECK(std::abs(c.half[n] * factorial - 1) <= std::numeric_limits<TestType>::epsilon());
  }
  CHECK(std::abs(splinertia::detail::inverse_jacobian_coefficient(c) * 12 - 1) <=
        std::numeric_limits<TestType>::epsilon());
}

TEMPLATE_TEST_CASE("c_n + X c_(n+2) = 1/n!", "[group]", float, double, long double) {
  const TestType eps = std::numeric_limits<TestType>::epsilon();
  for (const TestType theta : scan<TestType>(0, 7)) {
    const auto c = stumpff<7>(TestType(theta * theta)).full;
    TestType factorial(1);
    for (std::size_t n = 0; n <= 5; ++n) {
      if (n > 1) factorial *= static_cast<TestType>(n);
      const TestType second = theta * theta * c[n + 2];
      if (!(std::abs(c[n] + second - 1 / factorial) <= 8 * eps * (std::abs(c[n]) + second))) {
        FAIL("c" << n << " at " << theta);
      }
    }
  }
}

TEMPLATE_TEST_CASE("E = (1 - (t/2) cot(t/2))/t²", "[group]", float, double) {
  const auto E = [](auto X) { return splinertia::detail::inverse_jacobian_coefficient(stumpff<3>(X)); };
  const auto truth = [](Real X) { return (series(2, X / 4) - series(3, X / 4)) / (4 * series(1, X / 4)); };
  CHECK(worst_error<TestType>(0, pi, E, truth, truth) < 2.5);
  // Against the closed form, where that has digits left.
  for (const Real theta : {1.0L, 2.0L, 3.0L, pi, 4.0L, 6.0L}) {
    const Real cot = std::cos(theta / 2) / std::sin(theta / 2);
    CHECK(std::abs(E(theta * theta) - (1 - theta / 2 * cot) / (theta * theta)) < 1e-17L);
  }
}

TEST_CASE("derivatives of the coefficients against central differences", "[group]") {
  for (const Real theta : {0.1L, 1.0L, 2.0L, 3.0L, pi}) {
    const Real h = 1e-6L;
    const auto at = [](Real t) { return stumpff<7>(t * t); };
    const auto c = at(theta), forward = at(theta + h), backward = at(theta - h);
    const auto slope = [&](Real f, Real b) { return (f - b) / (2 * h * theta); };
    const Real tolerance = 1e-11L;  // h² and eps/h
    CHECK(std::abs(splinertia::detail::stumpff_derivative<1>(c) - slope(forward.full[1], backward.full[1])) <
          tolerance);
    CHECK(std::abs(splinertia::detail::stumpff_derivative<2>(c) - slope(forward.full[2], backward.full[2])) <
          tolerance);
    CHECK(std::abs(splinertia::detail::stumpff_derivative<3>(c) - slope(forward.full[3], backward.full[3])) <
          tolerance);
    CHECK(std::abs(splinertia::detail::stumpff_derivative<4>(c) - slope(forward.full[4], backward.full[4])) <
          tolerance);
    CHECK(std::abs(splinertia::detail::stumpff_derivative<5>(c) - slope(forward.full[5], backward.full[5])) <
          tolerance);
    const auto E = [](const auto& x) { return splinertia::detail::inverse_jacobian_coefficient(x); };
    CHECK(std::abs(splinertia::detail::inverse_jacobian_coefficient_derivative(c) - slope(E(forward), E(backward))) <
          tolerance);
  }
}

TEST_CASE("the number of terms follows from the type", "[group]") {
  // One term fewer costs 25 eps in E (double, measured); one more costs time.
  STATIC_CHECK(splinertia::detail::stumpff_terms(4, 24) >= 5);
  STATIC_CHECK(splinertia::detail::stumpff_terms(4, 53) >= 9);
  STATIC_CHECK(splinertia::detail::stumpff_terms(4, 64) >= 10);
  STATIC_CHECK(splinertia::detail::stumpff_terms(6, 53) >= 8);
  STATIC_CHECK(splinertia::detail::stumpff_terms(4, 53) <= 10);
}
