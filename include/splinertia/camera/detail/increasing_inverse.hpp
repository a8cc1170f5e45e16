// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <splinertia/camera/detail/bisect.hpp>

namespace splinertia::detail {

/// The x in [low, high] with f(x) = y, for f that increases there and is right at both ends: f(low) ≤ y ≤ f(high).
/// evaluate(x, slope) returns f(x) and sets its derivative. Newton's method; a step that leaves the interval that is
/// left, or does not halve often enough, is replaced by a bisection. It ends where another step would not change x, by
/// the quadratic convergence of the last two steps, or where the residual is of the size of rounding. The derivatives of
/// a Jet are one step behind its value, so it takes that step. docs/cameras.md has the number of steps.
template <typename Scalar>
[[nodiscard]] Scalar increasing_inverse(const auto& evaluate, const Scalar& y, Scalar low, Scalar high, Scalar start) {
  using std::abs;
  constexpr auto epsilon = std::numeric_limits<Scalar>::epsilon;
  Scalar x = start;
  Scalar last = high - low;
  bool newton = false;
  for (int i = 0; i < 200; ++i) {
    Scalar slope;
    const Scalar excess = evaluate(x, slope) - y;
    if (excess == Scalar(0)) return slope > Scalar(0) ? Scalar(x - excess / slope) : x;  // has the derivatives of a Jet
    (excess < Scalar(0) ? low : high) = x;                                               // NaN: f overflows
    Scalar step = excess / slope;
    Scalar next = x - step;
    const Scalar size = abs(x);
    if (abs(step) <= epsilon() / Scalar(2) * size) return next;
    const bool inside = low < next && next < high, slow = !(abs(step) < last / Scalar(2));
    if ((slow || !inside) && abs(excess) <= Scalar(2) * epsilon() * abs(y)) {  // rounding
      return inside || !std::floating_point<Scalar> ? next : x;
    }
    const bool was_newton = newton;
    newton = inside && (i < 4 || !slow);
    if (!newton) {
      next = middle_of(low, high);
      if (!(low < next && next < high)) return x;  // neighbouring numbers
      step = x - next;
    }
    const Scalar moved = abs(step);
    x = next;
    if (std::floating_point<Scalar> && was_newton && newton && moved < last &&
        !(moved * (moved / last) > epsilon() / Scalar(4) * size)) {
      return x;
    }
    last = moved;
  }
  return x;
}

}  // namespace splinertia::detail
