// SPDX-License-Identifier: MIT
#include <limits>
#include <random>
#include <splinertia/errors/detail/correlation_factor.hpp>
#include <stdexcept>

#include "support/catch.hpp"

using namespace splinertia::detail;

namespace {

constexpr int axes = 6;
template <typename Scalar>
using Matrix = Eigen::Matrix<Scalar, axes, axes>;

template <typename Scalar, typename Random>
Matrix<Scalar> random_columns(int rank, Random& random) {
  std::normal_distribution<double> normal;
  Matrix<Scalar> A = Matrix<Scalar>::Zero();
  for (int column = 0; column < rank; ++column) {
    for (int row = 0; row < axes; ++row) A(row, column) = static_cast<Scalar>(normal(random));
  }
  return A;
}

/// The largest coefficient of L·Lᵀ − R.
template <typename Scalar>
Scalar factored(const Matrix<Scalar>& R) {
  const Matrix<Scalar> part = correlation_part("test", R), L = correlation_factor("test", part);
  return (L * L.transpose() - part).cwiseAbs().maxCoeff();
}

}  // namespace

TEMPLATE_TEST_CASE("The correlations of any covariance are accepted, singular or not", "", float, double, long double) {
  using Scalar = TestType;
  std::mt19937_64 random(1);
  // Where an axis depends on those before it, the factorisation leaves out what rounding makes of zero: up to √(8N eps).
  const Scalar most = std::sqrt(correlation_rounding<Scalar, axes>);
  for (int run = 0; run < 600; ++run) {
    const Matrix<Scalar> A = random_columns<Scalar>(1 + run % axes, random), S = A * A.transpose();
    const Eigen::Matrix<Scalar, axes, 1> deviation = S.diagonal().cwiseSqrt(), scale = deviation.cwiseInverse();
    CHECK(factored<Scalar>(scale.asDiagonal() * S * scale.asDiagonal()) < most);
    CHECK(factored<Scalar>(S.cwiseQuotient(deviation * deviation.transpose())) < most);
    CHECK(factored<Scalar>(S.cwiseQuotient((S.diagonal() * S.diagonal().transpose()).cwiseSqrt())) < most);
    Matrix<Scalar> directions = A;
    for (int i = 0; i < axes; ++i) directions.row(i).normalize();
    CHECK(factored<Scalar>(directions * directions.transpose()) < most);
  }
}

TEMPLATE_TEST_CASE("A negative eigenvalue of a few rounding units is refused", "", float, double) {
  using Scalar = TestType;
  std::mt19937_64 random(2);
  const Scalar least = -Scalar(3 * axes) * correlation_rounding<Scalar, axes>;
  for (int run = 0; run < 600; ++run) {
    Matrix<Scalar> A = random_columns<Scalar>(axes - 1, random);
    for (int i = 0; i < axes; ++i) A.row(i).normalize();
    const Matrix<Scalar> R = correlation_part<Scalar, axes>("test", A * A.transpose());
    Matrix<Scalar> values = R;
    const Matrix<Scalar> vectors = diagonalize(values);
    int smallest = 0;
    values.diagonal().minCoeff(&smallest);
    const Eigen::Matrix<Scalar, axes, 1> v = vectors.col(smallest);
    Matrix<Scalar> negative = R + v * v.transpose() * least;
    const Eigen::Matrix<Scalar, axes, 1> scale = negative.diagonal().cwiseSqrt().cwiseInverse();
    negative = (scale.asDiagonal() * negative * scale.asDiagonal()).eval();
    CHECK_THROWS_AS(factored<Scalar>(negative), std::invalid_argument);
  }
  // Cholesky's factorisation alone would not see this one.
  const Scalar small = std::sqrt(std::numeric_limits<Scalar>::epsilon());
  const Eigen::Matrix<Scalar, 3, 3> R{{1, 1, 1}, {1, 1, 1 - small}, {1, 1 - small, 1}};
  CHECK_THROWS_AS(correlation_factor("test", R), std::invalid_argument);
}

TEST_CASE("Where Cholesky's factorisation succeeds, the factor is lower triangular") {
  const Eigen::Matrix3d R{{1, 0.5, -0.25}, {0.5, 1, 0}, {-0.25, 0, 1}};
  const Eigen::Matrix3d L = correlation_factor("test", R);
  CHECK(L.isLowerTriangular(0));
  CHECK(L(1, 0) == 0.5);
  CHECK(L(1, 1) == std::sqrt(0.75));
  CHECK((L * L.transpose() - R).norm() < 1e-15);
}

TEST_CASE("The symmetric part has ones on its diagonal") {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const Eigen::Matrix2d part =
      correlation_part<double, 2>("test", Eigen::Matrix2d{{1 + 2 * eps, 0.5}, {0.5 + 2 * eps, 1 - eps}});
  CHECK(part == Eigen::Matrix2d{{1, 0.5 + eps}, {0.5 + eps, 1}});
}

TEMPLATE_TEST_CASE("Eigenvalues and eigenvectors", "", float, double, long double) {
  using Scalar = TestType;
  std::mt19937_64 random(3);
  for (int run = 0; run < 100; ++run) {
    const Matrix<Scalar> A = random_columns<Scalar>(axes, random), R = A + A.transpose();
    Matrix<Scalar> values = R;
    const Matrix<Scalar> vectors = diagonalize(values);
    const Scalar rounding = Scalar(100) * std::numeric_limits<Scalar>::epsilon();
    CHECK((vectors * vectors.transpose() - Matrix<Scalar>::Identity()).norm() < rounding);
    CHECK((vectors * values.diagonal().asDiagonal() * vectors.transpose() - R).norm() < rounding * R.norm());
  }
}
