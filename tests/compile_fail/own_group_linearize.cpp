// expect: LieGroupWithJacobians
// Jacobians of a curve on a group without Jacobians.
#include <splinertia/spline/spline.hpp>

#include "../support/own_groups.hpp"

auto jacobians(const splinertia::Spline<test::PlainGain, 4>& curve) { return curve.linearize<1>(0.5); }
