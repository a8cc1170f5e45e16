// SPDX-License-Identifier: MIT
// docs/own_group.md: what is done with curves on a group of one's own.
#include <cmath>
#include <splinertia/group/with_scalar.hpp>
#include <splinertia/spline/fit/adaptive_fit.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/fit/interpolate.hpp>
#include <splinertia/spline/parameter_blocks.hpp>
#include <splinertia/spline/sample.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/own_groups.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using test::Gain;
using test::PlainGain;
using test::Shift;

template <typename S>
struct splinertia::ParameterLayout<Shift<S>> {
  static constexpr int size = 1;
  static Shift<S> read(const S* numbers) { return {numbers[0]}; }
  static void write(const Shift<S>& x, S* numbers) { numbers[0] = x.by; }
  static Eigen::Matrix<S, 1, 1> tangent_to_parameters(const Shift<S>&) { return Eigen::Matrix<S, 1, 1>::Ones(); }
  static Eigen::Matrix<S, 1, 1> parameters_to_tangent(const Shift<S>&) { return Eigen::Matrix<S, 1, 1>::Ones(); }
};
template <typename From, typename S>
struct splinertia::WithScalarOf<Shift<From>, S> {
  using type = Shift<S>;
};

namespace {

double truth(double t) { return std::exp(std::sin(t)); }

std::vector<Stamped<Gain, double>> gains() {
  std::vector<Stamped<Gain, double>> made;
  for (int i = 0; i <= 60; ++i) made.push_back({0.05 * i, {truth(0.05 * i)}});
  return made;
}

}  // namespace

TEST_CASE("Curves on a group of one's own are fitted, interpolated and linearized") {
  using Uniform = Spline<Gain, 4>;
  using NonUniform = Spline<Gain, 4, NonUniformKnots<double>>;
  const auto fitted = fit<Uniform>(gains(), {.knot_interval = 0.1});
  CHECK_THAT(fitted.spline.evaluate<0>(1.23).value.factor, WithinRel(truth(1.23), 1e-5));
  CHECK_THAT(interpolate<NonUniform>(gains()).evaluate<0>(1.25).value.factor, WithinRel(truth(1.25), 1e-12));
  const auto adaptive = adaptive_fit<NonUniform>(gains(), Tangent<Gain>(1e-4));
  CHECK_THAT(adaptive.spline.evaluate<0>(1.23).value.factor, WithinRel(truth(1.23), 1e-3));
  CHECK_THAT(fitted.spline.linearize<1>(1.23).velocity[0], WithinAbs(std::cos(1.23), 1e-3));
}

TEMPLATE_TEST_CASE("Samples of a group of one's own are what evaluate() gives, one by one", "", Gain, PlainGain) {
  STATIC_CHECK_FALSE(HasParameterLayout<TestType>);
  const Spline<TestType, 4> curve({.start = 0, .interval = 0.1}, {{1}, {1.5}, {2}, {1.2}, {0.7}, {1}});
  const auto samples = sample<2>(curve, 0.0, 0.01, 30);
  CHECK(samples.size() == 30);
  std::size_t i = 0;
  for (const auto& motion : samples) {
    const auto expected = curve.template evaluate<2>(0.01 * static_cast<double>(i));
    CHECK(motion.value.factor == expected.value.factor);
    CHECK(motion.velocity == expected.velocity);
    CHECK(samples.acceleration().col(static_cast<Eigen::Index>(i)) == expected.acceleration);
    ++i;
  }
  CHECK(sample<0>(curve, 0.0, 0.01, 30)[7].value.factor == curve.template evaluate<0>(0.07).value.factor);
}

TEST_CASE("With ParameterLayout and WithScalarOf a group of one's own goes in lanes and parameter blocks") {
  using Curve = Spline<Shift<double>, 4>;
  STATIC_CHECK(PackedCurve<Curve>);
  STATIC_CHECK(HasParameterLayout<Product<Shift<double>, Eigen::Vector3d>>);
  STATIC_CHECK_FALSE(HasParameterLayout<Product<Gain, Eigen::Vector3d>>);
  const Curve curve({.start = 0, .interval = 0.1}, {{1}, {1.5}, {2}, {1.2}, {0.7}, {1}});
  const auto samples = sample<1>(curve, 0.0, 0.01, 30);
  CHECK_THAT(samples[17].velocity[0], WithinAbs(curve.evaluate<1>(0.17).velocity[0], 1e-12));
  CHECK(samples.value().row(0)[17] == samples[17].value.by);

  const double* blocks[] = {&curve.control_points()[1].by, &curve.control_points()[2].by, &curve.control_points()[3].by,
                            &curve.control_points()[4].by};
  const auto at = curve.knots().basis<double, 4, 1>(0.17, curve.control_points().size());
  CHECK(at.first == 1);
  CHECK_THAT((evaluate<1, Shift<double>>(blocks, at.basis).velocity[0]),
             WithinAbs(curve.evaluate<1>(0.17).velocity[0], 1e-12));
}
