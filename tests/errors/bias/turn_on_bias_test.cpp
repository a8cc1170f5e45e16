// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/bias/turn_on_bias.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

TEMPLATE_TEST_CASE("The bias of a million runs is normal with the given standard deviation", "", float, double) {
  using Scalar = TestType;
  const double deviation[] = {0.3, 2, 1e-3};
  const ErrorModel model{TurnOnBias(per_axis<Scalar>(deviation))};
  std::array<std::vector<double>, 3> numbers;
  for (std::uint64_t seed = 0; seed < million; ++seed) {
    const Record errors = record<Scalar>(model, regular(200, 1), seed);
    for (std::size_t axis = 0; axis < 3; ++axis) numbers[axis].push_back(errors.axes[axis][0] / deviation[axis]);
  }
  const std::vector<double> ones(million, 1.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    INFO("axis " << axis);
    const std::vector<double>& z = numbers[axis];
    CHECK(off(mean_product(z, ones)) < 4);
    for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(z, lag)) < 4);
    double fourth = 0;
    for (const double x : z) fourth += x * x * x * x / million;
    CHECK(off({fourth, 3, std::sqrt(96.0 / million)}) < 4);  // variance of x⁴: 105 − 9
  }
  CHECK(off(mean_product(numbers[0], numbers[1])) < 4);
  CHECK(off(mean_product(numbers[1], numbers[2])) < 4);
  CHECK(off(mean_product(numbers[2], numbers[0])) < 4);
}

TEST_CASE("The bias is the same throughout a run, and at any rate") {
  const ErrorModel model{TurnOnBias{Eigen::Vector3d(1, 2, 0)}};
  const Record slow = record<double>(model, regular(50, 100), 3),
               other = record<double>(model, irregular(1000, 100), 3);
  CHECK(slow.all_bias);
  CHECK(slow.axes == other.axes);
  for (const auto& x : slow.axes) CHECK(x == std::vector<double>(100, x[0]));
  CHECK(slow.axes[0][0] != 0);
  CHECK(slow.axes[2][0] == 0);
}

TEST_CASE("A deviation is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(TurnOnBias{0.1F}), TurnOnBias<float>>);
  STATIC_CHECK(std::is_same_v<decltype(TurnOnBias{1}), TurnOnBias<double>>);
  STATIC_CHECK(std::is_same_v<decltype(TurnOnBias{PerAxis<float>(1, 2, 3)}), TurnOnBias<float, 3>>);
  CHECK(TurnOnBias{Eigen::Vector3d(1, 2, 3)}.standard_deviation[1] == 2);
}

TEST_CASE("A deviation that is none is refused") {
  CHECK_THROWS_WITH(TurnOnBias{-1.0}, "TurnOnBias: standard deviation is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(TurnOnBias{std::nan("")}, "TurnOnBias: standard deviation is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(TurnOnBias{std::numeric_limits<double>::infinity()},
                    "TurnOnBias: standard deviation is inf, expected a finite number >= 0");
}
