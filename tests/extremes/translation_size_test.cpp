// SPDX-License-Identifier: MIT
/// Translations from 1e-12 to 1e9 m, with ordinary rotations.
#include <string>

#include "extremes.hpp"

using namespace splinertia;
using namespace extremes;

namespace {

/// Control points with coordinates of size `size` around `offset`.
template <typename G>
std::vector<G> places(double size, double offset) {
  using L = Layout<G>;
  using Scalar = ScalarOf<G>;
  testing::Random random(13);
  std::vector<G> points;
  for (int i = 0; i < 8; ++i) {
    const Tangent<G> tau = random.tangent<G>(1);
    G x = GroupTraits<G>::exp(tau);
    const Eigen::Vector3<double> direction = random.tangent<Eigen::Vector3<double>>();
    const Eigen::Vector3<Scalar> p =
        (direction * size + Eigen::Vector3<double>(1, -2, 3) * offset).template cast<Scalar>();
    if constexpr (L::translations == 2) {
      x.translation() = p.template head<2>();
    } else {
      x = make_pose<G>(rotation(x), p);
    }
    points.push_back(x);
  }
  return points;
}

}  // namespace

TEMPLATE_TEST_CASE("Every size of translation", "", Sophus::SE2d, Sophus::SE3f, Sophus::SE3d, SO3xR3<float>,
                   SO3xR3<double>) {
  using G = TestType;
  Worst same, far;
  for (const double size : {1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9}) {
    const auto points = places<G>(size, 0);
    // Steps of a metre, `size` away: what is left of them after rounding is exact from there on.
    const auto offset = places<G>(1, size);
    for_orders([&]<int Order>() {
      compare_segments<Order>(same, 0.1L, points);
      compare_segments<Order>(far, 0.1L, offset);
    });
  }
  const auto group = std::string(Layout<G>::name) + " " + scalar_name<ScalarOf<G>>;
  same.require("steps and places 1e-12 ... 1e9 m, " + group);
  far.require("steps 1 m, places to 1e9 m, " + group);
}
