// SPDX-License-Identifier: MIT
#include <concepts>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

namespace {

template <typename Scalar>
Eigen::Matrix3<Scalar> matrix(Scalar a, Scalar b, Scalar c, Scalar d, Scalar e, Scalar f, Scalar g, Scalar h,
                              Scalar i) {
  return (Eigen::Matrix3<Scalar>() << a, b, c, d, e, f, g, h, i).finished();
}

template <typename Scalar>
Eigen::Matrix3<Scalar> diagonal(Scalar x, Scalar y, Scalar z) {
  return Eigen::Vector3<Scalar>(x, y, z).asDiagonal();
}

template <typename Scalar>
Eigen::Matrix3<Scalar> random_matrix(testing::Random& random) {
  return Eigen::Matrix3<Scalar>::NullaryExpr([&] { return static_cast<Scalar>(random.symmetric()); });
}

}  // namespace

TEMPLATE_TEST_CASE("The reading is M times what it was, and so is the bias in it", "", float, double) {
  using Vector = Eigen::Vector3<TestType>;
  const Misalignment term{matrix<TestType>(1, 2, 0, 0, 1, -1, 3, 0, 2)};
  const auto sample = applied(term, sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6)));
  CHECK(sample.value == Vector(5, -1, 9));
  CHECK(sample.bias == Vector(14, -1, 24));
}

TEST_CASE("Misalignment acts on the bias before it and not on the one behind it") {
  const Eigen::Matrix3d M = matrix<double>(1, 2, 0, 0, 1, -1, 3, 0, 2);
  const ErrorModel model{ConstantBias{Eigen::Vector3d(1, 2, 3)}, Misalignment{M}, ConstantBias{10}};
  auto state = model.start(StreamKey(1));
  auto sample = sample_with<double>(Eigen::Vector3d(1, 1, 1));
  model.apply(sample, state);
  CHECK(sample.value == (M * Eigen::Vector3d(2, 3, 4)).array().matrix() + Eigen::Vector3d::Constant(10));
  CHECK(sample.bias == M * Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d::Constant(10));
}

TEST_CASE("A misalignment is given as a 3 by 3 matrix and nothing else") {
  STATIC_CHECK(std::is_same_v<decltype(Misalignment{Eigen::Matrix3f()}), Misalignment<float>>);
  CHECK(Misalignment{2 * Eigen::Matrix3d::Identity()}.matrix(1, 1) == 2);
  STATIC_CHECK(!std::convertible_to<double, Misalignment<double>>);
  STATIC_CHECK(!std::convertible_to<Eigen::Vector3d, Misalignment<double>>);
}

TEMPLATE_TEST_CASE("Every matrix that can be inverted passes, whatever its size", "", float, double) {
  using Scalar = TestType;
  const Scalar tiny = std::numeric_limits<Scalar>::min(), huge = detail::largest_factor<Scalar>();
  const Eigen::Matrix3<Scalar> I = Eigen::Matrix3<Scalar>::Identity();
  for (const Scalar& scale : {tiny, Scalar(1), huge, std::numeric_limits<Scalar>::denorm_min()})
    CHECK_NOTHROW(Misalignment{Eigen::Matrix3<Scalar>(scale * I)});
  CHECK_NOTHROW(Misalignment{diagonal<Scalar>(1, tiny, tiny)});
  CHECK_NOTHROW(Misalignment{diagonal<Scalar>(huge, 1, tiny)});
  CHECK_NOTHROW(Misalignment{diagonal<Scalar>(1, 1, -1)});
  CHECK_THROWS_AS(Misalignment{diagonal<Scalar>(1, 1, 2 * huge)}, std::invalid_argument);  // times two readings
  // Rows that are nearly parallel, but not by rounding.
  const Scalar small = Scalar(1000) * std::numeric_limits<Scalar>::epsilon();
  CHECK_NOTHROW(Misalignment{matrix<Scalar>(1, 0, 0, 1, small, 0, 0, 0, 1)});
  testing::Random random(1);
  for (int i = 0; i < 100; ++i) CHECK_NOTHROW(Misalignment{random_matrix<Scalar>(random)});
}

TEMPLATE_TEST_CASE("A matrix that is singular, but for rounding, is refused", "", float, double) {
  using Scalar = TestType;
  CHECK_THROWS_AS(Misalignment{matrix<Scalar>(1, 2, 3, 4, 5, 6, 7, 8, 9)}, std::invalid_argument);
  testing::Random random(2);
  for (const Scalar& scale : {Scalar(1e-20), Scalar(1), Scalar(1e20)}) {
    for (int i = 0; i < 100; ++i) {
      Eigen::Matrix3<Scalar> m = scale * random_matrix<Scalar>(random);
      m.row(i % 3) = static_cast<Scalar>(random.symmetric()) * m.row((i + 1) % 3) +
                     static_cast<Scalar>(random.symmetric()) * m.row((i + 2) % 3);
      CHECK_THROWS_AS(Misalignment{m}, std::invalid_argument);
    }
  }
}

TEST_CASE("A matrix that cannot be inverted is refused with its determinant") {
  CHECK_THROWS_WITH(
      (Misalignment{diagonal<double>(1, 0, 1)}),
      "Misalignment: determinant of the matrix with rows of unit length is 0, expected a matrix that can be "
      "inverted");
  CHECK_THROWS_WITH(
      (Misalignment{Eigen::Matrix3d::Zero()}),
      "Misalignment: determinant of the matrix with rows of unit length is 0, expected a matrix that can be "
      "inverted");
  CHECK_THROWS_WITH((Misalignment{diagonal<double>(1, testing::nan<double>, 1)}),
                    "Misalignment: matrix is nan, expected a finite number");
  CHECK_THROWS_WITH((Misalignment{matrix<double>(1, 0, testing::infinity<double>, 0, 1, 0, 0, 0, 1)}),
                    "Misalignment: matrix is inf, expected a finite number");
}

TEST_CASE("A misalignment in words") {
  CHECK(describe(Misalignment{matrix<double>(1.5, 2, 0, 0, 1, -1, 3, 0, 2)}, SensorKind::gyro) ==
        "misalignment: matrix (1.5 2 0; 0 1 -1; 3 0 2)");
}
