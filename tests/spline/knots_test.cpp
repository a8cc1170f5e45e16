// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/spline/knots.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/uniform_knots.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

struct WithoutDomain {
  using Time = double;
  void check(std::size_t, int) const;
  template <typename Scalar, int Order, int D>
  BasisAt<Scalar, Order, D> basis(Time, std::size_t) const;
};

struct OfNoTime : UniformKnots<double> {
  using Time = const char*;
};

}  // namespace

static_assert(Knots<UniformKnots<double>> && Knots<UniformKnots<float>> && Knots<UniformKnots<nanoseconds>>);
static_assert(Knots<NonUniformKnots<double>> && Knots<NonUniformKnots<long double>>);
static_assert(Knots<NonUniformKnots<nanoseconds>> && Knots<NonUniformKnots<std::chrono::milliseconds>>);
static_assert(!Knots<double>);
static_assert(!Knots<WithoutDomain>);  // a curve could not say where it is
static_assert(!Knots<OfNoTime>);

TEST_CASE("Integers are finite, floating-point numbers may be") {
  CHECK(is_finite(nanoseconds::max()));
  CHECK(is_finite(1.0));
  CHECK_FALSE(is_finite(std::numeric_limits<double>::infinity()));
  CHECK_FALSE(is_finite(std::numeric_limits<float>::quiet_NaN()));
}
