// SPDX-License-Identifier: MIT
#include <splinertia/group/detail/dual_matrix.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

TEST_CASE("Dual matrices calculate as the matrices that they stand for") {
  const auto make = [](double seed) {
    DualMatrix3<double> m;
    for (int i = 0; i < 9; ++i) {
      m.real(i) = std::sin(seed + i);
      m.dual(i) = std::cos(3 * seed - i);
    }
    return m;
  };
  const auto a = make(0.3), b = make(1.7);
  CHECK((Matrix6(a * b) - Matrix6(a) * Matrix6(b)).norm() < 1e-14);
  CHECK((Matrix6(a + b) - (Matrix6(a) + Matrix6(b))).norm() < 1e-15);
  CHECK((Matrix6(a - b) - (Matrix6(a) - Matrix6(b))).norm() < 1e-15);
  CHECK((Matrix6(2.0 * a) - 2 * Matrix6(a)).norm() < 1e-15);
  CHECK(Matrix6(DualMatrix3<double>::identity()).isIdentity(0));
  CHECK(Matrix6(a).block<3, 3>(3, 0).isZero(0));
}
