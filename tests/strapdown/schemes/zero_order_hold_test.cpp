// SPDX-License-Identifier: MIT
#include <array>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("The zero-order hold converges with order 1") {
  testing::check_order<ZeroOrderHold>(1, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<ZeroOrderHold>(1);
  CHECK(testing::aggressive_error<ZeroOrderHold>(testing::regular_stamps(200)) < 7.2);
}

TEST_CASE("Readings that are held are integrated exactly, whatever the intervals") {
  using Sample = ImuSample<>;
  const Eigen::Vector3d w(1, -2, 3), f(4, 5, -6), u(-3, 1, 1), a(0, 9, 2);
  const std::array<Sample, 3> coarse{Sample{0, w, f}, Sample{0.75, u, a}, Sample{1, w, f}};
  const std::array<Sample, 5> fine{Sample{0, w, f}, Sample{0.5, w, f}, Sample{0.625, w, f}, Sample{0.75, u, a},
                                   Sample{1, u, a}};
  const NavState<double> initial{{}, {1, 2, 3}, {4, 5, 6}, 0};
  const auto x = integrate<ZeroOrderHold>(initial, coarse).back(), y = integrate<ZeroOrderHold>(initial, fine).back();
  CHECK((x.p_WB - y.p_WB).norm() < 1e-14);
  CHECK((x.v_WB - y.v_WB).norm() < 1e-14);
  CHECK((x.R_WB.inverse() * y.R_WB).log().norm() < 1e-15);
}
