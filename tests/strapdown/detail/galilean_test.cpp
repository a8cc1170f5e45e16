// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <random>
#include <splinertia/strapdown/detail/galilean.hpp>

#include "strapdown/matrix_exponential.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using testing::galilean_matrix;
using testing::matrix_exponential;

namespace {

class RandomVector {
 public:
  template <typename Scalar>
  Eigen::Vector3<Scalar> next() {
    const auto number = [&] { return static_cast<Scalar>(normal_(bits_)); };
    const Scalar x = number(), y = number(), z = number();
    return {x, y, z};
  }
  template <typename Scalar>
  GalileanVector<Scalar> galilean() {
    const auto phi = next<Scalar>(), nu = next<Scalar>(), rho = next<Scalar>();
    return {phi, nu, rho, static_cast<Scalar>(normal_(bits_))};
  }

 private:
  std::mt19937 bits_{1};
  std::normal_distribution<double> normal_;
};

}  // namespace

TEST_CASE("The bracket is the commutator of matrices") {
  RandomVector random;
  for (int i = 0; i < 20; ++i) {
    const auto a = random.galilean<double>(), b = random.galilean<double>();
    const auto A = galilean_matrix(a), B = galilean_matrix(b);
    CHECK((galilean_matrix(bracket(a, b)) - (A * B - B * A)).norm() < 1e-14L);
    CHECK((galilean_matrix(a + b) - (A + B)).norm() < 1e-15L);
    CHECK((galilean_matrix(a - b) - (A - B)).norm() < 1e-15L);
    CHECK((galilean_matrix(a * 0.5) - A / 2).norm() == 0);
  }
}

TEMPLATE_TEST_CASE("The exponential is that of the matrix, for angles from 0 to past π", "", float, double) {
  using Scalar = TestType;
  RandomVector random;
  const long double eps = std::numeric_limits<Scalar>::epsilon();
  for (const double angle : {0.0, 1e-300, 1e-20, 1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 2.0, 3.0,
                             3.1415926, 3.2, 6.0, 7.0, 20.0}) {
    for (int i = 0; i < 10; ++i) {
      auto a = random.galilean<Scalar>();
      a.phi = a.phi.normalized() * static_cast<Scalar>(angle);
      const auto truth = matrix_exponential(galilean_matrix(a));
      const auto got = galilean_matrix(galilean_exp(a));
      const long double tolerance = 8 * eps * std::max(1.0L, static_cast<long double>(angle));
      CAPTURE(angle);
      CHECK((got - truth).template topLeftCorner<3, 3>().norm() < tolerance);
      CHECK((got - truth).col(3).norm() < tolerance * static_cast<long double>(a.nu.norm()));
      CHECK((got - truth).col(4).norm() <
            tolerance * static_cast<long double>(a.rho.norm() + std::abs(a.tau) * a.nu.norm()));
    }
  }
}

TEST_CASE("Small parts of the exponential keep their relative accuracy") {
  for (const double size : {1e-12, 1e-6, 1e-2, 1.0}) {
    const GalileanVector<double> a{{size, -size, 2 * size}, {3, 1, -2}, {0, 0, 0}, size};
    const auto truth = matrix_exponential(galilean_matrix(a));
    const auto got = galilean_exp(a);
    CHECK((got.position.cast<long double>() - truth.block<3, 1>(0, 4)).norm() <
          1e-15L * truth.block<3, 1>(0, 4).norm());
    const long double sine = std::sin(a.phi.cast<long double>().norm() / 2);
    CHECK(std::abs(got.rotation.vec().cast<long double>().norm() - sine) < 1e-15L * sine);
  }
}

TEST_CASE("The left Jacobian times a vector is the matrix times the vector") {
  RandomVector random;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d phi = random.next<double>(), a = random.next<double>();
    const Eigen::Vector3d expected = rotation_left_jacobian<double>(phi) * a;
    CHECK((times_left_jacobian(stumpff<5>(phi.squaredNorm()), phi, a) - expected).norm() < 1e-14);
  }
}
