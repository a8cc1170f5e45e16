// SPDX-License-Identifier: MIT
#include <splinertia/detail/pi.hpp>
#include <splinertia/group/detail/rotation.hpp>

#include "group/sophus_laws.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename Scalar>
using Quaternion = Eigen::Quaternion<Scalar>;

template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> random_vector(laws::Draws& draw) {
  const double x = draw(), y = draw(), z = draw();
  return Eigen::Vector3d(x, y, z).cast<Scalar>();
}

template <typename Scalar>
[[nodiscard]] Quaternion<Scalar> random_rotation(laws::Draws& draw) {
  return rotation_exp<Scalar>(Scalar(3) * random_vector<Scalar>(draw));
}

template <typename Scalar>
constexpr Scalar eps = std::numeric_limits<Scalar>::epsilon();
template <typename Scalar>
constexpr Scalar pi = splinertia::detail::pi_of<Scalar>();

}  // namespace

TEMPLATE_TEST_CASE("SO(3) is a Lie group", "[group]", float, double, long double) {
  laws::hold_for<Sophus::SO3<TestType>>();
}

TEMPLATE_TEST_CASE("log of quaternions at the edges", "[group]", float, double, long double) {
  using Scalar = TestType;
  using V = Eigen::Vector3<Scalar>;
  const auto log = [](Scalar w, Scalar x, Scalar y, Scalar z) {
    return rotation_log<Scalar>(Quaternion<Scalar>(w, x, y, z));
  };
  const Scalar tiny = std::numeric_limits<Scalar>::denorm_min();

  CHECK(log(1, 0, 0, 0) == V::Zero());
  CHECK(log(-1, 0, 0, 0) == V::Zero());
  // At π the sign of the vector part is kept, whatever the sign of the zero.
  CHECK(log(0, 0, 0, 1) == V(0, 0, pi<Scalar>));
  CHECK(log(Scalar(-0.0), 0, 0, 1) == V(0, 0, pi<Scalar>));
  CHECK(log(0, 0, 0, -1) == V(0, 0, -pi<Scalar>));
  // A negative w, however small, is folded.
  CHECK(log(-tiny, 0, 0, 1) == V(0, 0, -pi<Scalar>));
  CHECK(log(tiny, 0, 0, 1) == V(0, 0, pi<Scalar>));
  // The smallest numbers there are.
  CHECK(log(1, tiny, 0, 0) == V(2 * tiny, 0, 0));
  CHECK(log(-1, tiny, 0, 0) == V(-2 * tiny, 0, 0));
}

TEMPLATE_TEST_CASE("log does not depend on the length of the quaternion", "[group]", float, double, long double) {
  using Scalar = TestType;
  laws::Draws draw(21);
  for (const double length : {1e-6, 0.5, 1.01, 1e6}) {
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3<Scalar> phi = random_vector<Scalar>(draw);
      Quaternion<Scalar> q = rotation_exp<Scalar>(phi);
      q.coeffs() *= Scalar(length);
      // exp, the product with length and log: one rounding of every component each.
      CHECK((rotation_log<Scalar>(q) - phi).norm() <= 4 * eps<Scalar> * phi.norm());
    }
  }
}

TEMPLATE_TEST_CASE("log of quaternions of every finite length", "[group]", float, double, long double) {
  using Scalar = TestType;
  using Limits = std::numeric_limits<Scalar>;
  laws::Draws draw(25);
  const auto log = [](const Quaternion<Scalar>& q, int exponent) {
    const auto scaled = [&](Scalar x) { return std::ldexp(x, exponent); };
    return rotation_log<Scalar>(Quaternion<Scalar>(scaled(q.w()), scaled(q.x()), scaled(q.y()), scaled(q.z())));
  };
  std::vector<Quaternion<Scalar>> rotations{{1, 0, 0, 0},
                                            {0, 1, 0, 0},
                                            {0, 0, 0, -1},
                                            {Limits::epsilon(), 0, 1, 0},
                                            {1, 0, Limits::epsilon(), 0},
                                            {Scalar(0.5), Scalar(0.5), Scalar(-0.5), Scalar(0.5)}};
  for (int i = 0; i < 20; ++i) rotations.push_back(random_rotation<Scalar>(draw));
  for (const auto& q : rotations) {
    const Eigen::Vector3<Scalar> truth = log(q, 0);
    // Powers of two change no digit, down to where the smallest component of the quaternion becomes subnormal.
    for (int exponent = Limits::min_exponent + 2 * Limits::digits; exponent < Limits::max_exponent; ++exponent) {
      INFO(exponent);
      REQUIRE((log(q, exponent) - truth).norm() <= 2 * Limits::epsilon() * truth.norm());
    }
  }
  for (const Scalar tiny : {Limits::denorm_min(), Limits::min()}) {
    CHECK(rotation_log<Scalar>({tiny, 0, 0, 0}) == Eigen::Vector3<Scalar>::Zero());
    CHECK(rotation_log<Scalar>({0, tiny, 0, 0}) == Eigen::Vector3<Scalar>(pi<Scalar>, 0, 0));
    const Scalar quarter = rotation_log<Scalar>({tiny, 0, -tiny, 0}).y();
    CHECK(std::abs(quarter + pi<Scalar> / 2) <= 2 * Limits::epsilon());
  }
  const Scalar most = Limits::max();
  CHECK((rotation_log<Scalar>({most, most, most, most}).array() > 1).all());
  CHECK((rotation_log<Scalar>({-most, most, most, most}).array() < -1).all());
}

TEMPLATE_TEST_CASE("log of a quaternion that is none is not a number", "[group]", float, double, long double) {
  using Scalar = TestType;
  using Limits = std::numeric_limits<Scalar>;
  const auto is_nan = [](const Quaternion<Scalar>& q) { return rotation_log<Scalar>(q).array().isNaN().all(); };
  CHECK(is_nan({0, 0, 0, 0}));
  CHECK(is_nan({1, Limits::infinity(), 0, 0}));
  CHECK(is_nan({0, Limits::quiet_NaN(), 1, 0}));
  CHECK(is_nan({Limits::quiet_NaN(), 1, 0, 0}));
}

TEMPLATE_TEST_CASE("the increment of close rotations is exact to eps of itself", "[group]", float, double,
                   long double) {
  using Scalar = TestType;
  // q has 6 bits after the point, δ = (δ, 1) three bits at the end of what is left: q δ is exact, and with it the
  // truth, log(δ) = δ 2 atan|δ|/|δ|. q is not of unit length, nor need it be.
  laws::Draws draw(22);
  const Scalar unit = std::ldexp(Scalar(1), -(std::numeric_limits<Scalar>::digits - 8));
  const auto bits = [&](double scale) { return static_cast<Scalar>(std::round(draw() * scale)); };
  for (int i = 0; i < 1000; ++i) {
    const Scalar w = bits(63) / 64, x = bits(63) / 64, y = bits(63) / 64, z = bits(63) / 64;
    const Scalar a = bits(3) * unit, b = bits(3) * unit, c = bits(3) * unit;
    const Quaternion<Scalar> q(w, x, y, z);
    if (q.norm() < Scalar(0.1)) continue;
    const Quaternion<Scalar> r(w - x * a - y * b - z * c, x + w * a + y * c - z * b, y + w * b - x * c + z * a,
                               z + w * c + x * b - y * a);
    const Eigen::Vector3<Scalar> delta(a, b, c);
    const Scalar n = delta.norm();
    const Eigen::Vector3<Scalar> truth = n > 0 ? Eigen::Vector3<Scalar>(delta * (2 * std::atan(n) / n)) : delta;
    // Eight products of three bits each and log: 4 eps.
    CHECK((rotation_increment<Scalar>(q, r) - truth).norm() <= 4 * eps<Scalar> * n);
    // The same rotation with the other sign.
    const Quaternion<Scalar> minus(-r.w(), -r.x(), -r.y(), -r.z());
    CHECK((rotation_increment<Scalar>(q, minus) - truth).norm() <= 4 * eps<Scalar> * n);
  }
}

TEMPLATE_TEST_CASE("equal rotations have no increment", "[group]", float, double, long double) {
  using Scalar = TestType;
  laws::Draws draw(23);
  for (int i = 0; i < 100; ++i) {
    const Quaternion<Scalar> q = random_rotation<Scalar>(draw);
    const Quaternion<Scalar> minus(-q.w(), -q.x(), -q.y(), -q.z());
    CHECK(rotation_increment<Scalar>(q, q) == Eigen::Vector3<Scalar>::Zero());
    CHECK(rotation_increment<Scalar>(q, minus) == Eigen::Vector3<Scalar>::Zero());
    CHECK(rotation_increment<Scalar>(minus, q) == Eigen::Vector3<Scalar>::Zero());
  }
}

TEMPLATE_TEST_CASE("increments of exactly a half turn", "[group]", float, double, long double) {
  using Scalar = TestType;
  const Quaternion<Scalar> one(1, 0, 0, 0), i(0, 1, 0, 0), k(0, 0, 0, 1);
  CHECK(rotation_increment<Scalar>(one, i) == Eigen::Vector3<Scalar>(pi<Scalar>, 0, 0));
  CHECK(rotation_increment<Scalar>(i, k) == Eigen::Vector3<Scalar>(0, pi<Scalar>, 0));  // −i k = j
  CHECK(rotation_increment<Scalar>(i, one) == Eigen::Vector3<Scalar>(-pi<Scalar>, 0, 0));
}

TEMPLATE_TEST_CASE("rotate and its inverse are those of the matrix", "[group]", float, double, long double) {
  using Scalar = TestType;
  laws::Draws draw(24);
  for (int i = 0; i < 100; ++i) {
    const Quaternion<Scalar> q = random_rotation<Scalar>(draw);
    const Eigen::Vector3<Scalar> v = random_vector<Scalar>(draw);
    CHECK((rotate<Scalar>(q, v) - q.toRotationMatrix() * v).norm() <= 8 * eps<Scalar>);
    CHECK((rotate_inverse<Scalar>(q, v) - q.toRotationMatrix().transpose() * v).norm() <= 8 * eps<Scalar>);
  }
  // Turning about z by a right angle: x goes to y.
  const Quaternion<Scalar> quarter = rotation_exp<Scalar>({0, 0, pi<Scalar> / 2});
  CHECK((rotate<Scalar>(quarter, Eigen::Vector3<Scalar>::UnitX()) - Eigen::Vector3<Scalar>::UnitY()).norm() <=
        4 * eps<Scalar>);
}

TEST_CASE("hat is the cross product", "[group]") {
  const Eigen::Vector3d a(1, 2, 3), b(-4, 5, 7);
  CHECK(hat<double>(a) * b == a.cross(b));
  const Eigen::Matrix3d expected =
      2 * Eigen::Matrix3d::Identity() + 3 * hat<double>(a) + 5 * hat<double>(a) * hat<double>(a);
  CHECK(hat_polynomial<double>(2, 3, 5, a) == expected);
}

TEMPLATE_TEST_CASE("Jacobians at π have no singularity", "[group]", float, double, long double) {
  using Scalar = TestType;
  // About z by π: J_l = [0 −2/π; 2/π 0], J_l⁻¹ = [0 π/2; −π/2 0] in the plane, 1 along z.
  const Eigen::Vector3<Scalar> phi(0, 0, pi<Scalar>);
  Eigen::Matrix3<Scalar> J, J_inverse;
  J << 0, -2 / pi<Scalar>, 0, 2 / pi<Scalar>, 0, 0, 0, 0, 1;
  J_inverse << 0, pi<Scalar> / 2, 0, -pi<Scalar> / 2, 0, 0, 0, 0, 1;
  CHECK((rotation_left_jacobian<Scalar>(phi) - J).norm() <= 4 * eps<Scalar>);
  CHECK((rotation_left_jacobian_inverse<Scalar>(phi) - J_inverse).norm() <= 4 * eps<Scalar>);
}
