// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/detail/cpp20.hpp>

namespace splinertia::detail {

/// The x in [low, high] with f(x) = y, for f that increases there and is right at both ends: f(low) ≤ y ≤ f(high).
/// evaluate(x, slope) returns f(x) and sets its derivative. Newton's method; a step that leaves the interval that is
/// left, or does not halve often enough, is replaced by one to its middle, or by doubling x where `high` is far away. It
/// ends where steps are of the size of rounding, which takes at most 8 steps except close to an end at which the slope is
/// zero.
template <typename Scalar>
[[nodiscard]] Scalar increasing_inverse(const auto& evaluate, const Scalar& y, Scalar low, Scalar high, Scalar start) {
  constexpr auto epsilon = std::numeric_limits<Scalar>::epsilon;
  Scalar x = start;
  Scalar last_step = high - low;
  for (int i = 0; i < 200; ++i) {
    Scalar slope;
    const Scalar excess = evaluate(x, slope) - y;
    if (excess == Scalar(0)) return slope > Scalar(0) ? Scalar(x - excess / slope) : x;  // has the derivatives of a Jet
    (excess < Scalar(0) ? low : high) = x;                                               // NaN: f overflows
    Scalar next = x - excess / slope;
    const Scalar size = x > Scalar(0) ? x : Scalar(-x), step = next > x ? next - x : x - next;
    if (!(step > epsilon() / Scalar(2) * size)) return next;
    if (step > last_step / Scalar(2) && !(last_step > Scalar(8) * epsilon() * size)) {  // rounding
      return low < next && next < high ? next : x;
    }
    if (!(low < next && next < high) || (i > 3 && step > last_step / Scalar(2))) {
      next = Scalar(0) < low && low < high / Scalar(8) ? low + low : low + (high - low) / Scalar(2);
      if (!(low < next && next < high)) return x;  // neighbouring numbers
    }
    last_step = next > x ? next - x : x - next;
    x = next;
  }
  return x;
}

}  // namespace splinertia::detail
