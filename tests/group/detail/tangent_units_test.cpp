// SPDX-License-Identifier: MIT
#include <splinertia/group/detail/tangent_units.hpp>
#include <splinertia/group/pose.hpp>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Runs = std::vector<std::pair<int, int>>;

template <typename G>
Runs runs_of() {
  Runs runs;
  TangentUnits<G>::for_each([&](int first, int rows) { runs.emplace_back(first, rows); });
  return runs;
}

}  // namespace

TEST_CASE("A tangent vector falls into runs of one unit") {
  CHECK(runs_of<Eigen::Vector3d>() == Runs{{0, 3}});
  CHECK(runs_of<Sophus::SO2d>() == Runs{{0, 1}});
  CHECK(runs_of<Sophus::SO3d>() == Runs{{0, 3}});
  CHECK(runs_of<Sophus::SE2d>() == Runs{{0, 2}, {2, 1}});
  CHECK(runs_of<Sophus::SE3d>() == Runs{{0, 3}, {3, 3}});
  CHECK(runs_of<SO3xR3<double>>() == Runs{{0, 3}, {3, 3}});
  CHECK(runs_of<Product<Eigen::Vector2d, Sophus::SE3d>>() == Runs{{0, 2}, {2, 3}, {5, 3}});
}
