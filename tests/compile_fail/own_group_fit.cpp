// expect: LieGroupWithJacobians
// A fit on a group without Jacobians.
#include <splinertia/spline/fit/fit.hpp>

#include "../support/own_groups.hpp"

auto fitted(const std::vector<splinertia::Stamped<test::PlainGain, double>>& poses) {
  return splinertia::fit<splinertia::Spline<test::PlainGain, 4>>(poses, {.knot_interval = 0.1});
}
