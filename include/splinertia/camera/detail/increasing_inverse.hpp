// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/detail/cpp20.hpp>

namespace splinertia::detail {

/// The x in [low, high] with f(x) = y, for f that increases there and is right at both ends: f(low) ≤ y ≤ f(high).
/// evaluate(x, slope) returns f(x) and sets its derivative. Newton's method; a step that leaves the interval that is
/// left, or does not halve it often enough, is replaced by its middle. It ends where another step would not change x, by
/// the quadratic convergence of the last two steps.
template <typename Scalar>
[[nodiscard]] Scalar increasing_inverse(const auto& evaluate, const Scalar& y, Scalar low, Scalar high, Scalar start) {
  using std::abs;
  const Scalar rounding = std::numeric_limits<Scalar>::epsilon() / Scalar(4);
  Scalar x = start;
  Scalar last = high - low;
  bool newton = false;
  for (int i = 0; i < 200; ++i) {
    Scalar slope;
    const Scalar excess = evaluate(x, slope) - y;
    if (excess == Scalar(0)) return x;
    (excess > Scalar(0) ? high : low) = x;
    Scalar step = excess / slope;
    Scalar next = x - step;
    const bool was_newton = newton;
    newton = low < next && next < high && (i < 4 || abs(step) < last / Scalar(2));
    if (!newton) {
      next = low + (high - low) / Scalar(2);
      if (!(low < next && next < high)) return x;  // neighbouring numbers
      step = x - next;
    }
    const Scalar moved = abs(step);
    const Scalar predicted =
        was_newton && newton && moved < last ? Scalar(moved * (moved / last) * (moved / last)) : moved;
    x = next;
    if (!(predicted > rounding * abs(x))) return x;
    last = moved;
  }
  return x;
}

}  // namespace splinertia::detail
