// SPDX-License-Identifier: MIT
#include <splinertia/group/euclidean.hpp>
#include <splinertia/motion/motion.hpp>

#include "support/catch.hpp"

using namespace splinertia;

template <typename M>
concept HasVelocity = requires(M m) { m.velocity; };
template <typename M>
concept HasAcceleration = requires(M m) { m.acceleration; };
template <typename M>
concept HasJerk = requires(M m) { m.jerk; };

TEST_CASE("A motion has exactly the derivatives that were asked for") {
  using G = Eigen::Vector3d;
  STATIC_CHECK(!HasVelocity<Motion<G, 0>>);
  STATIC_CHECK(HasVelocity<Motion<G, 1>>);
  STATIC_CHECK(!HasAcceleration<Motion<G, 1>>);
  STATIC_CHECK(HasAcceleration<Motion<G, 2>>);
  STATIC_CHECK(!HasJerk<Motion<G, 2>>);
  STATIC_CHECK(HasJerk<Motion<G, 3>>);
}

TEST_CASE("What was not asked for takes no room") {
  using G = Eigen::Vector3d;
  STATIC_CHECK(sizeof(Motion<G, 0>) == 1 * sizeof(G));
  STATIC_CHECK(sizeof(Motion<G, 1>) == 2 * sizeof(G));
  STATIC_CHECK(sizeof(Motion<G, 2>) == 3 * sizeof(G));
  STATIC_CHECK(sizeof(Motion<G, 3>) == 4 * sizeof(G));
}
