// SPDX-License-Identifier: MIT
#include "subjects.hpp"

namespace study {

template std::vector<Subject> subjects<6>(const Poses&, double, std::span<const Truth>);

splinertia::Spline<splinertia::SO3xR3<double>, 6> smooth_curve(const Poses& poses, double knot_interval) {
  using Curve = splinertia::Spline<splinertia::SO3xR3<double>, 6>;
  return splinertia::fit<Curve>(poses, {.knot_interval = knot_interval}).spline;
}

}  // namespace study
