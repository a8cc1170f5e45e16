// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <splinertia/group/parameters.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Nested = Product<Sophus::SE2d, Product<Sophus::SO2d, Eigen::Vector2d>>;

template <typename G>
double largest(const G& m) {
  return static_cast<double>(m.cwiseAbs().maxCoeff());
}

}  // namespace

TEMPLATE_TEST_CASE("Elements are written and read back to the bit, aligned or not", "", Eigen::Vector3d, Sophus::SO2d,
                   Sophus::SO3d, Sophus::SE2d, Sophus::SE3d, SO3xR3<double>, Nested, Sophus::SE3f,
                   Sophus::SO3<long double>) {
  using G = TestType;
  using Scalar = ScalarOf<G>;
  constexpr auto n = static_cast<std::size_t>(parameter_count<G>);
  testing::Random random(1);
  for (const G& x : random.walk<G>(5)) {
    std::array<Scalar, n + 1> numbers, again;
    for (std::size_t shift : {0U, 1U}) {
      write_parameters<G>(x, numbers.data() + shift);
      const G y = read_parameters<G>(numbers.data() + shift);
      write_parameters<G>(y, again.data() + shift);
      for (std::size_t i = 0; i < n; ++i) CHECK(numbers[i + shift] == again[i + shift]);
      CHECK(increment<G>(x, y).isZero(0));
    }
  }
}

// The promise on which `x.data()` as a parameter block rests.
TEMPLATE_TEST_CASE("The numbers are those in a Sophus object's memory", "", Sophus::SO2d, Sophus::SO3d, Sophus::SE2d,
                   Sophus::SE3d, Sophus::SO3f, Sophus::SE3f, Sophus::SE3<long double>) {
  using G = TestType;
  STATIC_CHECK(parameter_count<G> == G::num_parameters);
  testing::Random random(2);
  for (const G& x : random.walk<G>(5)) {
    std::array<ScalarOf<G>, static_cast<std::size_t>(parameter_count<G>)> numbers;
    write_parameters<G>(x, numbers.data());
    for (std::size_t i = 0; i < numbers.size(); ++i) CHECK(numbers[i] == x.data()[i]);
  }
}

TEMPLATE_TEST_CASE("Jacobians between tangents and numbers", "", Eigen::Vector3d, Sophus::SO2d, Sophus::SO3d,
                   Sophus::SE2d, Sophus::SE3d, SO3xR3<double>, Nested) {
  using G = TestType;
  using Numbers = Eigen::Matrix<double, parameter_count<G>, 1>;
  testing::Random random(3);
  const double h = 1e-5;  // central differences err by h² and eps/h
  for (const G& x : random.walk<G>(5)) {
    const TangentToParameters<G> J = ParameterLayout<G>::tangent_to_parameters(x);
    const ParametersToTangent<G> K = ParameterLayout<G>::parameters_to_tangent(x);
    CHECK(largest(K * J - Jacobian<G>::Identity()) < 8 * std::numeric_limits<double>::epsilon());
    for (int i = 0; i < DofOf<G>; ++i) {
      Numbers forward, backward;
      const Tangent<G> step = h * Tangent<G>::Unit(i);
      write_parameters<G>(GroupTraits<G>::compose(x, GroupTraits<G>::exp(step)), forward.data());
      write_parameters<G>(GroupTraits<G>::compose(x, GroupTraits<G>::exp(-step)), backward.data());
      CHECK(largest(Numbers((forward - backward) / (2 * h)) - J.col(i)) < 1e-9);
    }
    for (int i = 0; i < parameter_count<G>; ++i) {
      Numbers numbers;
      write_parameters<G>(x, numbers.data());
      numbers[i] += h;
      const Tangent<G> forward = increment<G>(x, read_parameters<G>(numbers.data()));
      numbers[i] -= 2 * h;
      const Tangent<G> backward = increment<G>(x, read_parameters<G>(numbers.data()));
      CHECK(largest(Tangent<G>((forward - backward) / (2 * h)) - K.col(i)) < 1e-9);
    }
  }
}
