// SPDX-License-Identifier: MIT
#include <array>
#include <splinertia/spline/parameter_blocks.hpp>
#include <splinertia/spline/uniform_knots.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// The numbers of control points, one block each for each part, at odd addresses.
template <LieGroup G, int Order>
struct Blocks {
  std::vector<std::vector<ScalarOf<G>>> memory;
  std::vector<const ScalarOf<G>*> pointers;

  explicit Blocks(const std::vector<G>& points) {
    for_each_part<G>([&]<std::size_t I>() {
      for (const G& x : points) {
        const auto& part = ControlPointParts<G>::template part<I>(x);
        using Part = std::remove_cvref_t<decltype(part)>;
        memory.emplace_back(1 + parameter_count<Part>);
        write_parameters<Part>(part, memory.back().data() + 1);
      }
    });
    for (const auto& block : memory) pointers.push_back(block.data() + 1);
  }
};

template <int Order, typename G>
void check_order() {
  using Scalar = ScalarOf<G>;
  testing::Random random(Order);
  const std::vector<G> points = random.walk<G>(Order);
  const Blocks<G, Order> blocks(points);
  const std::span<const G, Order> span(points);
  const auto basis = uniform_basis<Order, 3>(Scalar(3) / Scalar(10), Scalar(1) / Scalar(2));
  CHECK(blocks.pointers.size() == Order * ControlPointParts<G>::count);

  const auto expected = evaluate<3>(span, basis);
  const auto m = evaluate<3, G>(blocks.pointers.data(), basis);
  CHECK(increment<G>(m.value, expected.value).isZero(0));
  CHECK(m.velocity == expected.velocity);
  CHECK(m.acceleration == expected.acceleration);
  CHECK(m.jerk == expected.jerk);

  const auto basis2 = uniform_basis<Order, 2>(Scalar(3) / Scalar(10), Scalar(1) / Scalar(2));
  const auto expected_l = linearize<2>(span, basis2);
  const auto l = linearize<2, G>(blocks.pointers.data(), basis2);
  CHECK(l.acceleration == expected_l.acceleration);
  for (std::size_t j = 0; j < Order; ++j) {
    CHECK(l.value_jacobian[j] == expected_l.value_jacobian[j]);
    CHECK(l.velocity_jacobian[j] == expected_l.velocity_jacobian[j]);
    CHECK(l.acceleration_jacobian[j] == expected_l.acceleration_jacobian[j]);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Blocks of numbers give the curve of the control points that they hold", "", Eigen::Vector3d,
                   Sophus::SO3d, Sophus::SE2d, Sophus::SE3d, SO3xR3<double>, Sophus::SE3f) {
  check_order<2, TestType>();
  check_order<4, TestType>();
  check_order<5, TestType>();
}

TEST_CASE("The memory of Sophus objects is a block as it is") {
  testing::Random random(4);
  const std::vector<Sophus::SE3d> T = random.walk<Sophus::SE3d>(4);
  const double* blocks[] = {T[0].data(), T[1].data(), T[2].data(), T[3].data()};
  const auto basis = uniform_basis<4, 1>(0.25, 0.1);
  CHECK(evaluate<1, Sophus::SE3d>(blocks, basis).velocity ==
        evaluate<1>(std::span<const Sophus::SE3d, 4>(T), basis).velocity);
}
