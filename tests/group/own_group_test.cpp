// SPDX-License-Identifier: MIT
// A group that the library does not know, with Jacobians, as docs/own_group.md describes it. It is Sim(2), the rotations,
// scalings and translations of the plane: z -> a z + b with complex a and b.
#include <algorithm>
#include <cmath>
#include <complex>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"

using Complex = std::complex<double>;

struct Similarity {
  Complex a{1};  // scale and rotation: |a|, arg a
  Complex b{0};  // translation
};

// f = (e^s - 1)/s and g = (e^s - 1 - s)/s^2, as series where the closed forms lose digits by cancellation.
struct Coefficients {
  Complex f, g;

  explicit Coefficients(Complex s) {
    if (std::abs(s) > 1) {
      f = (std::exp(s) - 1.0) / s;
      g = (f - 1.0) / s;
    } else {
      Complex term = 0.5;  // s^n/(n + 2)!
      for (int n = 0; n < 18; ++n) {
        g += term;
        term *= s / double(n + 3);
      }
      f = 1.0 + s * g;
    }
  }
};

// Tangents are [rho; s], both complex: the translation, then the logarithm of scale and the angle.
template <>
struct splinertia::GroupTraits<Similarity> {
  using Scalar = double;
  using Vector = Eigen::Vector4d;
  using Square = Eigen::Matrix4d;
  static constexpr int Dof = 4;

  // Needed by a curve.
  static Similarity identity() { return {}; }
  static Similarity compose(const Similarity& x, const Similarity& y) { return {x.a * y.a, x.a * y.b + x.b}; }
  static Similarity inverse(const Similarity& x) { return {1.0 / x.a, -x.b / x.a}; }
  static Similarity exp(const Vector& tau) { return {std::exp(s(tau)), Coefficients(s(tau)).f * rho(tau)}; }
  static Vector log(const Similarity& x) {
    const Complex s = std::log(x.a);
    return tangent(x.b / Coefficients(s).f, s);
  }
  static Vector adjoint(const Similarity& x, const Vector& tau) {
    return tangent(x.a * rho(tau) - s(tau) * x.b, s(tau));
  }
  static Vector bracket(const Vector& a, const Vector& b) { return tangent(s(a) * rho(b) - s(b) * rho(a), 0); }

  // Also needed by its Jacobians.
  static Square left_jacobian(const Vector& tau) {
    const Coefficients c(s(tau));
    return matrix(c.f, -rho(tau) * c.g);
  }
  static Square left_jacobian_inverse(const Vector& tau) {
    const Coefficients c(s(tau));
    return matrix(1.0 / c.f, rho(tau) * c.g / c.f);
  }

 private:
  static Complex rho(const Vector& tau) { return {tau[0], tau[1]}; }
  static Complex s(const Vector& tau) { return {tau[2], tau[3]}; }
  static Vector tangent(Complex rho, Complex s) { return {rho.real(), rho.imag(), s.real(), s.imag()}; }
  // [p q; 0 1], each complex number written as a real 2 x 2 matrix
  static Square matrix(Complex p, Complex q) {
    Square m = Square::Identity();
    m.topLeftCorner<2, 2>() << p.real(), -p.imag(), p.imag(), p.real();
    m.topRightCorner<2, 2>() << q.real(), -q.imag(), q.imag(), q.real();
    return m;
  }
};

using splinertia::increment;
using Sim2 = splinertia::GroupTraits<Similarity>;
static_assert(splinertia::LieGroupWithJacobians<Similarity>);

namespace {

using namespace splinertia::detail;

const Eigen::Vector4d twist(1, 0.5, 0.1, 0.4);  // per second

// Control points every 0.5 s along a constant twist.
std::vector<Similarity> along_twist() {
  std::vector<Similarity> points;
  for (int i = 0; i < 6; ++i) points.push_back(Sim2::exp(0.5 * i * twist));
  return points;
}

}  // namespace

TEST_CASE("A curve over control points of one twist is that motion, on a group of one's own") {
  const splinertia::Spline<Similarity, 4> curve({.start = 0.5, .interval = 0.5}, along_twist());
  const auto m = curve.at<2>(1.3);
  CHECK(std::abs(m.value.a) == Approx(std::exp(0.13)));
  CHECK(std::arg(m.value.a) == Approx(0.52));
  CHECK(increment(Sim2::exp(1.3 * twist), m.value).norm() < 1e-13);
  CHECK((m.velocity - twist).norm() < 1e-13);
  CHECK(m.acceleration.norm() < 1e-13);
}

// The differences have a truncation error of 1e-10 and rounding of 1e-11, times derivatives of up to 100.
TEST_CASE("Derivatives and Jacobians on a group of one's own agree with central differences") {
  auto points = along_twist();
  points[2] = Sim2::compose(points[2], Sim2::exp({0.3, -0.2, 0.1, -0.5}));
  splinertia::Spline<Similarity, 4> curve({.start = 0.5, .interval = 0.5}, points);
  const double t = 1.3, h = 1e-5;
  const auto before = curve.at<1>(t - h), after = curve.at<1>(t + h);
  const auto here = curve.linearize<2>(t);
  CHECK((increment(before.value, after.value) / (2 * h) - here.velocity).norm() < 1e-8);
  CHECK(((after.velocity - before.velocity) / (2 * h) - here.acceleration).norm() < 1e-8);

  for (std::size_t j = 0; j < 4; ++j) {  // the control points that shape the curve here, from here.first on
    const std::size_t i = here.first + j;
    for (int k = 0; k < 4; ++k) {
      const auto velocity_with = [&](double step) -> Eigen::Vector4d {
        curve.set_control_point(i, Sim2::compose(points[i], Sim2::exp(step * Eigen::Vector4d::Unit(k))));
        return curve.at<1>(t).velocity;
      };
      const Eigen::Vector4d column = (velocity_with(h) - velocity_with(-h)) / (2 * h);
      CHECK((here.velocity_jacobian[j].col(k) - column).norm() < 1e-8);
    }
    curve.set_control_point(i, points[i]);
  }
}
