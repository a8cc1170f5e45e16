// SPDX-License-Identifier: MIT
#include <splinertia/adapters/ceres_manifold.hpp>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;

// What Ceres' documentation asks of a manifold.
TEMPLATE_TEST_CASE("The manifold's invariants", "", Eigen::Vector3d, Sophus::SO2d, Sophus::SO3d, Sophus::SE2d,
                   Sophus::SE3d, SO3xR3<double>) {
  using G = TestType;
  const CeresManifold<G> manifold;
  const int n = manifold.AmbientSize(), d = manifold.TangentSize();
  CHECK(n == parameter_count<G>);
  CHECK(d == DofOf<G>);
  testing::Random random(1);
  const double eps = std::numeric_limits<double>::epsilon();
  for (const double size : {0.0, 1e-300, 1e-12, 1e-8, 1e-3, 1.0, 1.8}) {
    for (const G& element : random.walk<G>(3)) {
      Eigen::VectorXd x(n), y(n), again(n), back(d);
      write_parameters<G>(element, x.data());
      const Eigen::VectorXd delta = random.tangent<G>(size);
      REQUIRE(manifold.Plus(x.data(), delta.data(), y.data()));
      REQUIRE(manifold.Minus(y.data(), x.data(), back.data()));
      // Rounding of y, of size 3 with its translation, limits how well a step is found again.
      CHECK((back - delta).cwiseAbs().maxCoeff() <= 16 * eps * 4);
      REQUIRE(manifold.Plus(x.data(), back.data(), again.data()));
      CHECK((again - y).cwiseAbs().maxCoeff() <= 16 * eps * 4);
      if (size == 0) {
        CHECK(y == x);
        CHECK(back == delta);
      }

      testing::RowMajorMatrix plus(n, d), minus(d, n);
      REQUIRE(manifold.PlusJacobian(x.data(), plus.data()));
      REQUIRE(manifold.MinusJacobian(x.data(), minus.data()));
      CHECK((minus * plus - Eigen::MatrixXd::Identity(d, d)).cwiseAbs().maxCoeff() <= 8 * eps);
      const double h = 1e-5;  // central differences err by h² and eps/h
      for (int i = 0; i < d; ++i) {
        const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(d, i), opposite = -step;
        Eigen::VectorXd forward(n), backward(n);
        REQUIRE(manifold.Plus(x.data(), step.data(), forward.data()));
        REQUIRE(manifold.Plus(x.data(), opposite.data(), backward.data()));
        CHECK(((forward - backward) / (2 * h) - plus.col(i)).cwiseAbs().maxCoeff() < 1e-9);
      }
      for (int i = 0; i < n; ++i) {
        const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, i);
        const Eigen::VectorXd ahead = x + step, behind = x - step;
        Eigen::VectorXd forward(d), backward(d);
        REQUIRE(manifold.Minus(ahead.data(), x.data(), forward.data()));
        REQUIRE(manifold.Minus(behind.data(), x.data(), backward.data()));
        CHECK(((forward - backward) / (2 * h) - minus.col(i)).cwiseAbs().maxCoeff() < 1e-9);
      }
    }
  }
}

TEST_CASE("Plus may overwrite its argument") {
  testing::Random random(2);
  const CeresManifold<Sophus::SE3d> manifold;
  const Eigen::Matrix<double, 6, 1> delta = random.tangent<Sophus::SE3d>();
  for (Sophus::SE3d T : random.walk<Sophus::SE3d>(3)) {
    const Sophus::SE3d expected = GroupTraits<Sophus::SE3d>::compose(T, GroupTraits<Sophus::SE3d>::exp(delta));
    REQUIRE(manifold.Plus(T.data(), delta.data(), T.data()));
    CHECK(increment(T, expected).isZero(0));
  }
}
