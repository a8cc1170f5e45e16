// SPDX-License-Identifier: MIT
/// Jacobians with respect to the control points at every angle, against those in long double, relative to the largest
/// entry of all control points. Each is a sum of a few products of up to three matrices, so that C is allowed to be
/// five times that of a value. golden/jac_so3.csv and jac_se3.csv hold long double to the same.
#pragma once

#include <splinertia/spline/linearize.hpp>

#include "angle_ladder.hpp"

namespace extremes {

using namespace splinertia;
using namespace splinertia::detail;

inline constexpr double jacobian_limit = 20;

struct WorstJacobians {
  double value = 0, velocity = 0, acceleration = 0;
};

/// The largest difference of two sets of Jacobians in eps of the largest entry.
template <typename Set, typename WideSet>
void add(double& worst, const Set& got, const WideSet& gold, Long scalar_eps, Long floor) {
  Long error = 0, size = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (!got[i].allFinite()) worst = std::numeric_limits<double>::infinity();
    error = std::max(error, (got[i].template cast<Long>() - gold[i]).template lpNorm<Eigen::Infinity>());
    size = std::max(size, gold[i].template lpNorm<Eigen::Infinity>());
  }
  if (error > floor) worst = std::max(worst, static_cast<double>((error - floor) / (scalar_eps * size)));
}

template <int Order, typename G>
void compare_jacobians(WorstJacobians& worst, const std::vector<G>& points, double u) {
  using Scalar = ScalarOf<G>;
  using W = Wide<G>;
  std::array<Tangent<W>, Order - 1> increments;
  for (std::size_t j = 0; j < increments.size(); ++j) {
    increments[j] = wide_increment<W>(Layout<G>::widen(points[j]), Layout<G>::widen(points[j + 1]));
  }
  const auto got =
      linearize<2>(std::span<const G, Order>(points.data(), Order), uniform_basis<Order, 2>(Scalar(u), Scalar(1)));
  const auto gold = linearize_increments<2>(
      unit(Layout<G>::widen(points[0])), [&](std::size_t j) { return increments[j]; },
      uniform_basis<Order, 2>(Long(Scalar(u)), Long(1)));
  add(worst.value, got.value_jacobian, gold.value_jacobian, eps<Scalar>, underflow<Scalar>);
  add(worst.velocity, got.velocity_jacobian, gold.velocity_jacobian, eps<Scalar>, underflow<Scalar>);
  add(worst.acceleration, got.acceleration_jacobian, gold.acceleration_jacobian, eps<Scalar>, underflow<Scalar>);
}

/// Every angle of the ladder, for these orders.
template <typename G, int... Orders>
void check_jacobians_at_every_angle() {
  WorstJacobians worst;
  for (const Long angle : angles<ScalarOf<G>>()) {
    for (const bool from_identity : {true, false}) {
      const auto points = turning_walk<G>(from_identity, angle, 6);
      for (const double u : {0.0, 0.3, 0.5, 1.0}) {
        (compare_jacobians<Orders>(worst, points, u), ...);
      }
    }
  }
  std::printf("Jacobians, angle 0 ... pi, %s %-6s            value %4.2f  velocity %4.2f  acceleration %4.2f\n",
              Layout<G>::name, scalar_name<ScalarOf<G>>, worst.value, worst.velocity, worst.acceleration);
  CHECK(worst.value <= jacobian_limit);
  CHECK(worst.velocity <= jacobian_limit);
  CHECK(worst.acceleration <= jacobian_limit);
}

}  // namespace extremes
