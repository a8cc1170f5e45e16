// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <limits>
#include <splinertia/camera/detail/bisect.hpp>

namespace splinertia::detail {

/// The x in [low, high] with f(x) = y, for f that increases there and is right at both ends: f(low) ≤ y ≤ f(high).
/// evaluate(x, slope) returns f(x) and sets its derivative. Newton's method; a step that leaves the interval that is
/// left, or does not halve often enough, is replaced by a bisection. It ends where the residual or the step is that of rounding. docs/cameras.md has the number of steps.
template <typename Scalar>
[[nodiscard]] Scalar increasing_inverse(const auto& evaluate, const Scalar& y, Scalar low, Scalar high, Scalar start) {
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  Scalar x = start;
  Scalar last_step = high - low;
  for (int i = 0; i < 40000; ++i) {  // bisection of any interval ends before
    Scalar slope;
    const Scalar excess = evaluate(x, slope) - y;
    // The last step gives the derivatives of a Jet.
    if (excess == Scalar(0)) return slope > Scalar(0) ? Scalar(x - excess / slope) : x;
    (excess < Scalar(0) ? low : high) = x;  // NaN: f overflows
    Scalar next = x - excess / slope;
    const Scalar step = next > x ? next - x : x - next, residual = excess < Scalar(0) ? -excess : excess;
    const bool inside = low < next && next < high;
    const bool slow = step > last_step / Scalar(2);
    if (residual <= Scalar(inside && !slow ? 2 : 16) * epsilon * y) {
      return inside || !std::floating_point<Scalar> ? next : x;
    }
    if (!inside || (i > 3 && slow)) {
      const Scalar rounding = Scalar(1024) * epsilon;  // of f
      if (inside && last_step <= rounding * x && residual <= rounding * y) return x;
      next = middle_of(low, high);
      if (!(low < next && next < high)) return x;  // neighbouring numbers
    }
    last_step = next > x ? next - x : x - next;
    if (last_step <= epsilon / Scalar(2) * x) return next;
    x = next;
  }
  return x;
}

}  // namespace splinertia::detail
