// SPDX-License-Identifier: MIT
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/pose.hpp>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("Every factor of a product is visited once, in order, with its index and type") {
  using Factors = Product<Sophus::SO2d, Eigen::Vector3d, Sophus::SE3d>;
  std::vector<std::size_t> indices;
  std::vector<int> dofs;
  detail::for_each_factor<Factors>([&]<std::size_t Index, typename Factor>() {
    static_assert(std::is_same_v<Factor, Factors::Factor<Index>>);
    indices.push_back(Index);
    dofs.push_back(DofOf<Factor>);
  });
  CHECK(indices == std::vector<std::size_t>{0, 1, 2});
  CHECK(dofs == std::vector<int>{1, 3, 6});
}
