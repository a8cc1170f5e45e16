// SPDX-License-Identifier: MIT
// Evaluation on control points that somebody else owns.
#include <span>
#include <splinertia/group/sophus.hpp>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/spline/uniform_knots.hpp>

using namespace splinertia;

Motion<Sophus::SO3d, 2> evaluate_at(std::span<const Sophus::SO3d, 4> points, const Basis<double, 4, 2>& basis) {
  return evaluate<2>(points, basis);
}
