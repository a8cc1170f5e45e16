// SPDX-License-Identifier: MIT
/// Increments of exactly π, where there are two ways to turn and one has to be taken.
#include "angle_ladder.hpp"

using namespace splinertia;
using namespace extremes;

namespace {

/// A half turn about an axis, as a quaternion with w exactly zero, of either sign.
template <typename Scalar>
Sophus::SO3<Scalar> half_turn(const Eigen::Vector3<Scalar>& axis, Scalar w = 0) {
  return rotation_from_unit_quaternion<Scalar>({w, axis.x(), axis.y(), axis.z()});
}

template <typename Scalar>
Sophus::SO3<Scalar> about(const Eigen::Vector3<Scalar>& axis, Long angle) {
  const auto s = static_cast<Scalar>(std::sin(angle / 2));
  return rotation_from_unit_quaternion<Scalar>(
      {static_cast<Scalar>(std::cos(angle / 2)), s * axis.x(), s * axis.y(), s * axis.z()});
}

}  // namespace

TEMPLATE_TEST_CASE("Exactly pi: the axis is that of the quaternion as it is written", "", float, double, long double) {
  using Scalar = TestType;
  using Traits = GroupTraits<Sophus::SO3<Scalar>>;
  const Eigen::Vector3<Scalar> axis(Scalar(0.6L), 0, Scalar(-0.8L));
  const auto half_circle = static_cast<Scalar>(pi);
  const Sophus::SO3<Scalar> identity;
  const Scalar tolerance = 8 * std::numeric_limits<Scalar>::epsilon();  // of π: axis and product each rounded twice
  for (const Scalar w : {Scalar(0), -Scalar(0)}) {
    CHECK((Traits::log(half_turn<Scalar>(axis, w)) - half_circle * axis).norm() < tolerance);
    CHECK((Traits::increment(identity, half_turn<Scalar>(axis, w)) - half_circle * axis).norm() < tolerance);
    // q and −q are one rotation, but two ways to turn by π: the sign decides which is taken.
    CHECK((Traits::increment(identity, half_turn<Scalar>(-axis, w)) + half_circle * axis).norm() < tolerance);
  }
  // The limit from below about the same axis; from above it is the other way round, by less than π.
  const Long step = std::is_same_v<Scalar, float> ? 1e-5L : 1e-8L;
  CHECK((Traits::log(about<Scalar>(axis, pi - step)) - Scalar(pi - step) * axis).norm() < tolerance);
  CHECK((Traits::log(about<Scalar>(axis, pi + step)) + Scalar(pi - step) * axis).norm() < tolerance);
}

TEMPLATE_TEST_CASE("A curve over half turns is valid, and the limit of those over a little less", "", float, double,
                   long double) {
  using Scalar = TestType;
  using G = Sophus::SO3<Scalar>;
  const UniformKnots knots{0.0, 0.1};
  const Eigen::Vector3<Scalar> axis(Scalar(0.6L), 0, Scalar(-0.8L));
  const Long step = std::is_same_v<Scalar, float> ? 1e-5L : 1e-8L;
  // Back and forth: identity, half turn, identity, …
  std::vector<G> exactly, nearly;
  for (int i = 0; i < 6; ++i) {
    exactly.push_back(i % 2 == 0 ? G{} : half_turn<Scalar>(axis));
    nearly.push_back(i % 2 == 0 ? G{} : about<Scalar>(axis, pi - step));
  }
  const Spline<G, 4> at_pi(knots, exactly), below_pi(knots, nearly);
  for (int i = 0; i <= 30; ++i) {
    const double t = at_pi.end() * i / 30;
    const auto m = at_pi.template evaluate<3>(t);
    const auto below = below_pi.template evaluate<3>(t);
    CHECK(std::abs(Long(m.value.unit_quaternion().norm()) - 1) < limit * eps<Scalar>);
    REQUIRE((m.velocity.allFinite() && m.acceleration.allFinite() && m.jerk.allFinite()));
    // Increments differ by `step`; the derivatives multiply that by the basis' (largest: 1/interval^m).
    const auto close = [&](const Eigen::Vector3<Scalar>& a, const Eigen::Vector3<Scalar>& b, Long factor) {
      CHECK((a - b).norm() < static_cast<Scalar>(factor * (4 * step + 40 * eps<Scalar>)));
    };
    close(increment<G>(m.value, below.value), Eigen::Vector3<Scalar>::Zero(), 1);
    close(m.velocity, below.velocity, 10);
    close(m.acceleration, below.acceleration, 100);
    close(m.jerk, below.jerk, 1000);
  }
}

TEMPLATE_TEST_CASE("Half turns about any axes: either way is taken, and kept", "", Sophus::SO3f, Sophus::SO3d,
                   SO3xR3<double>) {
  // Rounded, π from an ordinary base is a little less or a little more: the increment is one of the two ways, each of
  // which leads from control point to control point, and the curve is that of the increments.
  using G = TestType;
  using Scalar = ScalarOf<G>;
  Worst worst;
  const auto points = turning_walk<G>(false, pi, 12);
  const Spline<G, 4> curve({.start = 0, .interval = 0.1}, points);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Tangent<G> d = curve.increments()[i];
    CHECK(std::abs(Long(d.template head<3>().norm()) - pi) < 8 * eps<Scalar>);
    const auto reached = GroupTraits<G>::compose(points[i], GroupTraits<G>::exp(d));
    CHECK(increment<G>(points[i + 1], reached).norm() < 16 * std::numeric_limits<Scalar>::epsilon());
  }
  for (int i = 0; i <= 30; ++i) {
    const double t = curve.end() * i / 30;
    const auto [first, basis] = curve.knots().template basis<Long, 4, 3>(t, points.size());
    std::array<Tangent<Wide<G>>, 3> increments;
    for (std::size_t j = 0; j < 3; ++j) increments[j] = curve.increments()[first + j].template cast<Long>();
    const auto reference = reference_from<4>(Layout<G>::widen(points[first]), increments, basis);
    compare<Wide<G>>(worst, widen<G>(curve.template evaluate<3>(t)), reference, eps<Scalar>, underflow<Scalar>);
  }
  worst.require(std::string("angle pi, ") + Layout<G>::name + " " + scalar_name<Scalar>);
}
