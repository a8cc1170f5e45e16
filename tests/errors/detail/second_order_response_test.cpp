// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/errors/detail/second_order_response.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Matrix2 = Eigen::Matrix<long double, 2, 2>;
constexpr double damping_ratios[] = {1e-6, 0.01,        0.5,      0.7071, 0.9,    1 - 1e-9, 1 - 1e-15, 1.0,
                                     1.01, 1 + 0x1p-52, 1 + 1e-9, 1.2499, 1.2501, 10.0,     1e3,       1e6};

struct Reference {
  Matrix2 transition;
  long double step_response;
};

/// By the power series of the matrix exponential where that converges fast, else as the formula is in books.
Reference reference(long double a, long double zeta) {
  const Matrix2 A = (Matrix2() << 0, 1, -1, -2 * zeta).finished();
  if (a * (1 + 2 * zeta) < 1) {
    Matrix2 power = Matrix2::Identity(), rest = Matrix2::Zero();
    for (int k = 1; k < 30; ++k) {
      power = (power * A * (a / static_cast<long double>(k))).eval();
      rest += power;
    }
    return {Matrix2::Identity() + rest, -rest(0, 0)};
  }
  long double C = 0, S = 0;
  const long double root = std::sqrt(std::abs(1 - zeta) * (1 + zeta)), b = a * root;
  if (zeta < 1) {
    C = std::exp(-zeta * a) * std::cos(b);
    S = std::exp(-zeta * a) * std::sin(b) / b;
  } else if (b < 0.01L) {
    const long double b2 = b * b;
    C = std::exp(-zeta * a) * (1 + b2 / 2 * (1 + b2 / 12 * (1 + b2 / 30 * (1 + b2 / 56))));
    S = std::exp(-zeta * a) * (1 + b2 / 6 * (1 + b2 / 20 * (1 + b2 / 42 * (1 + b2 / 72))));
  } else {
    const long double slow = std::exp(-a / (zeta + root)), fast = std::exp(-a * (zeta + root));
    C = (slow + fast) / 2;
    S = (slow - fast) / (2 * b);
  }
  Reference r;
  r.transition << C + zeta * a * S, a * S, -a * S, C - zeta * a * S;
  r.step_response = 1 - r.transition(0, 0);
  return r;
}

}  // namespace

TEMPLATE_TEST_CASE("Transition and step response are right to a few eps from nothing to many turns", "", float,
                   double) {
  using Scalar = TestType;
  const long double eps = std::numeric_limits<Scalar>::epsilon();
  const long double reference_eps = 4 * std::numeric_limits<long double>::epsilon();
  for (const double damping_ratio : damping_ratios) {
    const auto zeta = static_cast<Scalar>(damping_ratio);
    for (double size = 1e-9; size < 2e9; size *= 3.7) {
      const auto a = static_cast<Scalar>(size);
      const Reference expected = reference(a, zeta);
      const Eigen::Matrix<Scalar, 2, 2> transition = oscillator_transition<Scalar>(a, zeta);
      const long double phase = eps / static_cast<long double>(zeta);  // of many turns, rounded
      INFO("a = " << a << ", damping ratio " << zeta);
      CHECK((transition.template cast<long double>() - expected.transition).cwiseAbs().maxCoeff() <= 4 * eps + phase);
      const Scalar response = oscillator_step_response<Scalar>(a, zeta);
      CHECK(std::abs(response - expected.step_response) <=
            std::min(4 * eps + phase, 8 * eps * static_cast<long double>(a / zeta)) + phase * (a > 1) + reference_eps);
    }
  }
}

TEST_CASE("Two steps are one of their sum, and areas shrink by exp(-2 zeta a)") {
  for (const double zeta : {0.01, 0.3, 1.0, 1.1, 5.0}) {
    for (const double a : {0.01, 0.7, 3.0}) {
      for (const double b : {0.2, 2.0}) {
        const Eigen::Matrix2d both = oscillator_transition(a + b, zeta);
        CHECK((oscillator_transition(a, zeta) * oscillator_transition(b, zeta) - both).norm() < 3e-15);
      }
      const Eigen::Matrix2d T = oscillator_transition(a, zeta);
      CHECK_THAT(T(0, 0) * T(1, 1) - T(0, 1) * T(1, 0), WithinAbs(std::exp(-2 * zeta * a), 1e-15));
    }
  }
}

TEST_CASE("Nothing happens in no time, and nothing is left after an age") {
  for (const double zeta : damping_ratios) {
    CHECK(oscillator_transition(0.0, zeta) == Eigen::Matrix2d::Identity());
    CHECK(oscillator_step_response(0.0, zeta) == 0);
    CHECK(oscillator_transition(1e18, zeta).norm() < 1e-300);
    CHECK_THAT(oscillator_step_response(1e18, zeta), WithinAbs(1, 1e-15));
  }
}

TEST_CASE("Critical damping is no seam") {
  for (const double a : {1e-6, 0.1, 1.0, 10.0, 100.0}) {
    const Eigen::Matrix2d at = oscillator_transition(a, 1.0);
    for (const double off : {-1e-8, -1e-12, -1e-16, 1e-15, 1e-12, 1e-8}) {
      CHECK((oscillator_transition(a, 1 + off) - at).norm() <= 2 * std::abs(off) + 1e-15);
    }
  }
}
