// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/camera/detail/increasing_inverse.hpp>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEMPLATE_TEST_CASE("the inverse of a radial function, in few steps", "", float, double, long double) {
  using Scalar = TestType;
  int calls = 0;
  // x − x³/3 increases up to x = 1.
  const auto f = [&](const Scalar& x, Scalar& slope) {
    ++calls;
    slope = 1 - x * x;
    return x * (1 - x * x / 3);
  };
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  int most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Scalar y = static_cast<Scalar>(i) * Scalar(2) / 3000;
    calls = 0;
    const Scalar x = increasing_inverse<Scalar>(f, y, 0, 1, y);
    most = (std::max)(most, calls);
    Scalar slope;
    CHECK(std::abs(f(x, slope) - y) <= 2 * eps * y);
  }
  CHECK(most <= 12);
}

TEST_CASE("an inverse where the function overflows on the way") {
  const auto f = [](const double& x, double& slope) {
    slope = 1 + 5 * x * x * x * x;
    return x + x * x * x * x * x;
  };
  const double most = std::numeric_limits<double>::max();
  const double x = increasing_inverse<double>(f, 1e200, 0, most, 1e200);
  CHECK(std::abs(x / 1e40 - 1) < 1e-15);
}

namespace {

/// The radius that a common lens makes of r. It increases everywhere, so the interval has no end to speak of.
template <typename Scalar>
Scalar lens(const Scalar& r, Scalar& slope) {
  const Scalar k1 = static_cast<Scalar>(-0.285L), k2 = static_cast<Scalar>(0.123L), s = r * r;
  slope = Scalar(1) + s * (Scalar(3) * k1 + s * Scalar(5) * k2);
  return r * (Scalar(1) + s * (k1 + s * k2));
}

}  // namespace

TEMPLATE_TEST_CASE("The inverse is right to rounding, however long the interval is", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  for (const Scalar high : {Scalar(10), std::sqrt((std::numeric_limits<Scalar>::max)())}) {
    for (int i = 1; i < 20000; ++i) {
      Scalar slope;
      const Scalar r = Scalar(i) / Scalar(10007), y = lens(r, slope);
      Scalar x = increasing_inverse<Scalar>(lens<Scalar>, y, Scalar(0), high, y);
      if (!(std::abs(x - r) <= 8 * epsilon * (r + y / slope))) FAIL(r << " " << x);
      x = increasing_inverse<Scalar>(lens<Scalar>, y, Scalar(0), high, Scalar(3));  // from elsewhere
      if (!(std::abs(x - r) <= 8 * epsilon * (r + y / slope))) FAIL(r << " " << x << " from 3");
    }
  }
}

TEST_CASE("Where the slope is zero at an end, the inverse is still found") {
  int evaluations = 0;
  const auto f = [&](double x, double& slope) {
    ++evaluations;
    slope = 1 - x * x;
    return x - x * x * x / 3;
  };
  for (const double y : {0.0, 0.1, 0.6, 0.66, 0.6666, 0.66666666, 2.0 / 3.0}) {
    evaluations = 0;
    const double x = increasing_inverse<double>(f, y, 0.0, 1.0, y);
    CAPTURE(y, evaluations);
    double slope;
    CHECK(std::abs(f(x, slope) - y) <= 2e-16);
    CHECK(evaluations < 64);
  }
}

TEST_CASE("A function that overflows in the interval is inverted where it does not") {
  const auto f = [](double x, double& slope) {
    slope = 1 + 5 * (1e308 * (x * x * x * x));  // infinite
    return x * (1 + 1e308 * (x * x * x * x));
  };
  double slope;
  for (const double y : {1e-100, 0.3, 1e10, 1e300}) {
    const double x = increasing_inverse<double>(f, y, 0.0, 3.0, y < 3 ? y : 1.5);
    CAPTURE(y, x);
    CHECK(std::abs(f(x, slope) - y) <= 2e-15 * y);
  }
}
