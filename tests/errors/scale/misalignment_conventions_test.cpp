// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/errors/scale/misalignment_conventions.hpp>
#include <splinertia/group/sophus.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

namespace {

template <typename Scalar>
Eigen::Matrix3<Scalar> lower(Scalar sx, Scalar yx, Scalar sy, Scalar zx, Scalar zy, Scalar sz) {
  return (Eigen::Matrix3<Scalar>() << sx, 0, 0, yx, sy, 0, zx, zy, sz).finished();
}

}  // namespace

TEMPLATE_TEST_CASE("What Kalibr writes comes back after composing and splitting", "", float, double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  testing::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const auto near = [&](double x) { return static_cast<Scalar>(x + 0.05 * random.symmetric()); };
    const Eigen::Matrix3<Scalar> M = lower(near(1), near(0), near(1), near(0), near(0), near(i % 2 == 0 ? 1 : -1));
    const Eigen::Matrix3<Scalar> C = Sophus::SO3<Scalar>::exp(random.tangent<Sophus::SO3<Scalar>>(3)).matrix();
    const Misalignment<Scalar> composed = misalignment_from_kalibr(M, C);
    CHECK((composed.matrix - M * C).norm() <= 8 * eps);
    const auto [scale_and_shear, rotation] = split_misalignment(composed);
    CHECK((scale_and_shear - M).norm() < 32 * eps);
    CHECK((rotation - C).norm() < 32 * eps);
  }
}

TEMPLATE_TEST_CASE("Any misalignment splits into a lower triangle and a proper rotation", "", float, double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  testing::Random random(2);
  int mirrors = 0;
  for (int i = 0; i < 100; ++i) {
    Eigen::Matrix3<Scalar> m =
        Eigen::Matrix3<Scalar>::NullaryExpr([&] { return static_cast<Scalar>(random.symmetric()); });
    m.diagonal().array() += Scalar(i % 2 == 0 ? 2 : -2);
    const auto [M, C] = split_misalignment(Misalignment{m});
    CHECK((M * C - m).norm() < 32 * eps * m.norm());
    CHECK((C * C.transpose() - Eigen::Matrix3<Scalar>::Identity()).norm() < 32 * eps);
    CHECK(C.determinant() > 0);
    CHECK(M.template triangularView<Eigen::StrictlyUpper>().toDenseMatrix().isZero(0));
    CHECK(M(0, 0) > 0);
    CHECK(M(1, 1) > 0);
    CHECK((M(2, 2) > 0) == (m.determinant() > 0));
    mirrors += M(2, 2) < 0;
  }
  CHECK(mirrors == 50);
}

TEST_CASE("An accelerometer of Kalibr's has no rotation of its own") {
  const Eigen::Matrix3d M = lower(1.01, 0.02, 0.99, -0.03, 0.04, 1.02);
  CHECK(misalignment_from_kalibr(M).matrix == M);
  const auto parts = split_misalignment(misalignment_from_kalibr(M));
  CHECK((parts.scale_and_shear - M).norm() < 1e-15);
  CHECK((parts.rotation - Eigen::Matrix3d::Identity()).norm() < 1e-15);
}

TEST_CASE("Percent: scale factors on the diagonal, cross-axis sensitivities off it") {
  const Eigen::Matrix3d percent = (Eigen::Matrix3d() << 1, 2, 0, -0.5, -3, 0, 0, 0, 0).finished();
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 1.01, 0.02, 0, -0.005, 0.97, 0, 0, 0, 1).finished();
  const auto misalignment = misalignment_from_percent(percent);
  CHECK((misalignment.matrix - expected).norm() < 1e-16);
  CHECK((misalignment_percent(misalignment) - percent).norm() < 1e-13);
}
