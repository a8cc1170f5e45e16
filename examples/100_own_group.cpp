// SPDX-License-Identifier: MIT
// A group of your own takes one specialisation of GroupTraits. This is Sim(2), the similarities of the plane,
// z -> a z + b with complex a and b. docs/own_group.md explains it. With two Jacobians it can also be fitted.

#include <complex>
#include <cstdio>
#include <splinertia/spline/spline.hpp>
#include <vector>

using Complex = std::complex<double>;

struct Similarity {
  Complex a{1}, b{0};  // |a| is the scale, arg a the angle, b the translation
};

template <>
struct splinertia::GroupTraits<Similarity> {
  using Scalar = double;
  using Vector = Eigen::Vector4d;  // tangents: [rho; s], both complex; s is the logarithm of the scale, and the angle
  static constexpr int Dof = 4;

  static Similarity identity() { return {}; }
  static Similarity compose(const Similarity& x, const Similarity& y) { return {x.a * y.a, x.a * y.b + x.b}; }
  static Similarity inverse(const Similarity& x) { return {1.0 / x.a, -x.b / x.a}; }
  static Similarity exp(const Vector& tau) { return {std::exp(s(tau)), shift(s(tau)) * rho(tau)}; }
  static Vector log(const Similarity& x) { return tangent(x.b / shift(std::log(x.a)), std::log(x.a)); }
  static Vector adjoint(const Similarity& x, const Vector& t) { return tangent(x.a * rho(t) - s(t) * x.b, s(t)); }
  static Vector bracket(const Vector& t, const Vector& u) { return tangent(s(t) * rho(u) - s(u) * rho(t), 0); }

 private:
  static Complex rho(const Vector& tau) { return {tau[0], tau[1]}; }
  static Complex s(const Vector& tau) { return {tau[2], tau[3]}; }
  static Vector tangent(Complex rho, Complex s) { return {rho.real(), rho.imag(), s.real(), s.imag()}; }
  /// (e^s - 1)/s, without cancellation at small s.
  static Complex shift(Complex s) { return s == 0.0 ? 1.0 : std::exp(s / 2.0) * std::sinh(s / 2.0) / (s / 2.0); }
};
static_assert(splinertia::LieGroup<Similarity>);

int main() {
  // Control points along one twist: the curve is exactly that motion.
  const Eigen::Vector4d twist(1, 0.5, 0.1, 0.4);  // per second
  std::vector<Similarity> points;
  for (int i = 0; i < 6; ++i) points.push_back(splinertia::GroupTraits<Similarity>::exp(0.5 * i * twist));
  const splinertia::Spline<Similarity, 4> curve({.start = 0.5, .interval = 0.5}, points);
  const auto m = curve.at<1>(1.3);
  std::printf("scale %.4f, angle %.4f rad, at (%.4f, %.4f)\n", std::abs(m.value.a), std::arg(m.value.a),
              m.value.b.real(), m.value.b.imag());
  std::printf("velocity %.4f %.4f %.4f %.4f\n", m.velocity[0], m.velocity[1], m.velocity[2], m.velocity[3]);
}

// prints
// scale 1.1388, angle 0.5200 rad, at (1.1444, 1.0227)
// velocity 1.0000 0.5000 0.1000 0.4000
