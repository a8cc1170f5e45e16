// SPDX-License-Identifier: MIT
/// Control points that are a given angle apart, for every angle from 0 to next to π.
#pragma once

#include <splinertia/detail/pi.hpp>
#include <string>

#include "extremes.hpp"

namespace extremes {

inline constexpr Long pi = splinertia::detail::pi_of<Long>();

/// The angles that a scalar can tell apart from 0 and from π.
template <typename Scalar>
std::vector<Long> angles() {
  std::vector<Long> ladder{0,     1e-30L, 1e-20L, 1e-12L, 1e-8L, 1e-7L, 1e-4L,     1e-3L,
                           1e-2L, 0.1L,   0.5L,   1,      2,     3,     pi - 1e-3L};
  if (std::is_same_v<Scalar, float>) {
    ladder.push_back(pi - 1e-5L);
  } else {
    for (const Long angle : {1e-300L, 1e-160L, 1e-100L, pi - 1e-6L, pi - 1e-8L}) ladder.push_back(angle);
  }
  return ladder;
}

/// Control points `angle` and a translation of size 1 apart, from the identity or an ordinary element on.
template <typename G>
std::vector<G> turning_walk(bool from_identity, Long angle, std::size_t count = 8) {
  using L = Layout<G>;
  splinertia::testing::Random random(11);
  using Traits = splinertia::GroupTraits<G>;
  std::vector<G> points{from_identity ? Traits::identity() : Traits::exp(random.tangent<G>(2))};
  while (points.size() < count) {
    splinertia::Tangent<G> tau = random.tangent<G>();
    const auto axis = tau.template segment<L::rotations>(L::rotation).template cast<Long>().normalized().eval();
    tau.template segment<L::rotations>(L::rotation) = (angle * axis).template cast<splinertia::ScalarOf<G>>();
    points.push_back(Traits::compose(points.back(), Traits::exp(tau)));
  }
  return points;
}

/// Every angle of the ladder and every order.
template <typename G>
void check_every_angle() {
  Worst worst;
  for (const Long angle : angles<splinertia::ScalarOf<G>>()) {
    for (const bool from_identity : {true, false}) {
      const auto points = turning_walk<G>(from_identity, angle);
      for_orders([&]<int Order>() { compare_segments<Order>(worst, 0.1L, points); });
    }
  }
  worst.require(std::string("angle 0 ... pi, ") + Layout<G>::name + " " + scalar_name<splinertia::ScalarOf<G>>);
}

}  // namespace extremes
