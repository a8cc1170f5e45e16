// SPDX-License-Identifier: MIT
/// The adapter: that it means the same by its names as Sophus does. The laws of the groups are tested beside their
/// mathematics, in rotation_test.cpp, rigid_motion_test.cpp and planar_motion_test.cpp.
#include <splinertia/group/sophus.hpp>

#include "group/sophus_laws.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename G>
[[nodiscard]] Tangent<G> ordinary_tangent(laws::Draws& draw) {
  Tangent<G> tau;
  for (int i = 0; i < DofOf<G>; ++i) tau[i] = static_cast<ScalarOf<G>>(draw());
  return tau;
}

template <typename G>
[[nodiscard]] auto dense(const G& x) {
  return x.matrix().eval();
}

}  // namespace

TEMPLATE_TEST_CASE("functions mean what they mean in Sophus", "[group]", Sophus::SO2d, Sophus::SO3d, Sophus::SE2d,
                   Sophus::SE3f, Sophus::SE3d) {
  using G = TestType;
  using T = GroupTraits<G>;
  using Scalar = ScalarOf<G>;
  // Sophus' own log and products are the less accurate side: a few eps of numbers of size 3, away from 0 and π.
  const Scalar tolerance = 64 * std::numeric_limits<Scalar>::epsilon();
  STATIC_CHECK(DofOf<G> == G::DoF);
  laws::Draws draw(51);
  for (int i = 0; i < 50; ++i) {
    const Tangent<G> tau = ordinary_tangent<G>(draw), sigma = ordinary_tangent<G>(draw);
    const auto narrow = [](const Tangent<G>& v) {
      if constexpr (DofOf<G> == 1) {
        return v[0];
      } else {
        return v;
      }
    };
    const auto column = [](const auto& v) {
      if constexpr (DofOf<G> == 1) {
        return Tangent<G>(Tangent<G>::Constant(v));
      } else {
        return Tangent<G>(v);
      }
    };
    const G x = G::exp(narrow(tau)), y = G::exp(narrow(sigma));
    CHECK((dense(T::exp(tau)) - dense(x)).norm() <= tolerance);
    // Sophus' log of SE(2) divides by cos θ − 1, which cancels like eps/θ².
    const Scalar cancelled = std::is_same_v<G, Sophus::SE2<Scalar>> ? 1 + 1 / (tau.tail(1).squaredNorm()) : Scalar(1);
    CHECK((T::log(x) - column(x.log())).norm() <= tolerance * cancelled);
    CHECK((dense(T::compose(x, y)) - dense(x * y)).norm() <= tolerance);
    CHECK((dense(T::inverse(x)) - dense(x.inverse())).norm() <= tolerance);
    CHECK((dense(T::identity()) - dense(G())).norm() == 0);
    if constexpr (DofOf < G >> 1) {
      CHECK((T::adjoint(x, sigma) - x.Adj() * sigma).norm() <= tolerance);
      CHECK((T::bracket(tau, sigma) - column(G::lieBracket(tau, sigma))).norm() <= tolerance);
    }
  }
}

TEMPLATE_TEST_CASE("a rotation is taken as it is", "[group]", float, double, long double) {
  using Scalar = TestType;
  const Eigen::Quaternion<Scalar> q(Scalar(0.5), Scalar(0.5), Scalar(0.5), Scalar(0.25));  // not normalised
  CHECK(rotation_from_unit_quaternion<Scalar>(q).unit_quaternion().coeffs() == q.coeffs());
  const auto R = rotation_from_unit_complex<Scalar>(Scalar(0.5), Scalar(0.25));
  CHECK(R.unit_complex().x() == Scalar(0.5));
  CHECK(R.unit_complex().y() == Scalar(0.25));
}

TEMPLATE_TEST_CASE("large positions cost an increment nothing", "[group]", float, double, long double) {
  using Scalar = TestType;
  using G = Sophus::SE3<Scalar>;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  // 2^20 m and a step of 2^−3 m: exact in float, too. Through x⁻¹ y the error would be eps 2^20.
  const Eigen::Vector3<Scalar> p(Scalar(1 << 20), Scalar(-(1 << 20)), Scalar(1 << 19)),
      step(Scalar(0.125), Scalar(-0.25), Scalar(0.125));
  laws::Draws draw(52);
  for (int i = 0; i < 50; ++i) {
    G x = GroupTraits<G>::exp(ordinary_tangent<G>(draw));
    x.translation() = p;
    G y = x;
    y.translation() = p + step;
    const Tangent<G> d = increment<G>(x, y);
    const Eigen::Vector3<Scalar> expected = x.so3().unit_quaternion().toRotationMatrix().transpose() * step;
    CHECK((d.template head<3>() - expected).norm() <= 8 * eps * step.norm());
    CHECK(d.template tail<3>() == Eigen::Vector3<Scalar>::Zero());
  }
}

TEMPLATE_TEST_CASE("chains of products stay unit to rounding", "[group]", float, double) {
  using Scalar = TestType;
  using T = GroupTraits<Sophus::SO3<Scalar>>;
  const auto step = T::exp({Scalar(0.1), Scalar(-0.2), Scalar(0.3)});
  auto x = T::identity();
  for (int i = 0; i < 1000; ++i) x = T::compose(x, step);
  // Nothing is normalised: each product may add an eps.
  CHECK(std::abs(x.unit_quaternion().norm() - 1) <= 1000 * std::numeric_limits<Scalar>::epsilon());
}

TEST_CASE("which of Sophus' groups are commutative", "[group]") {
  STATIC_CHECK(is_commutative<Sophus::SO2d>);
  STATIC_CHECK_FALSE(is_commutative<Sophus::SO3d>);
  STATIC_CHECK_FALSE(is_commutative<Sophus::SE2d>);
  STATIC_CHECK_FALSE(is_commutative<Sophus::SE3d>);
}
