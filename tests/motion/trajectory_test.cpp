// SPDX-License-Identifier: MIT
#include <splinertia/group/euclidean.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <string>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

// The least that a user's own motion has to be.
struct Falling {
  using Group = Eigen::Vector3d;
  using Time = double;
  double start() const { return 0; }
  double end() const { return 1; }
  template <int D>
    requires(D <= 1)
  Motion<Group, D> evaluate(double t) const {
    Motion<Group, D> m;
    m.value = {0, 0, -4.9 * t * t};
    if constexpr (D >= 1) m.velocity = {0, 0, -9.8 * t};
    return m;
  }
};

struct NoEnd {
  using Group = Eigen::Vector3d;
  using Time = double;
  double start() const;
  template <int D>
  Motion<Group, D> evaluate(double) const;
};

}  // namespace

TEST_CASE("A user's own type is a trajectory as far as it can be asked") {
  STATIC_CHECK(Trajectory<Falling, 0>);
  STATIC_CHECK(Trajectory<Falling, 1>);
  STATIC_CHECK(!Trajectory<Falling, 2>);  // no acceleration
  STATIC_CHECK(!Trajectory<NoEnd, 0>);
  STATIC_CHECK(Trajectory<Ellipse<>, 2>);
  STATIC_CHECK(!Trajectory<Ellipse<>, 3>);
}
