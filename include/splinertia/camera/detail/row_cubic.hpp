// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace splinertia::detail {

/// The cubic with given values and slopes at x = 0 and 1, f = c₀ + c₁ x + c₂ x² + c₃ x³.
template <typename Scalar>
struct HermiteCubic {
  Scalar c0, c1, c2, c3;

  HermiteCubic(const Scalar& f0, const Scalar& slope0, const Scalar& f1, const Scalar& slope1) : c0(f0), c1(slope0) {
    const Scalar rise = f1 - f0;
    c2 = Scalar(3) * rise - Scalar(2) * slope0 - slope1;
    c3 = slope0 + slope1 - Scalar(2) * rise;
  }
  [[nodiscard]] Scalar value(const Scalar& x) const { return c0 + x * (c1 + x * (c2 + x * c3)); }
  [[nodiscard]] Scalar slope(const Scalar& x) const { return c1 + x * (Scalar(2) * c2 + x * Scalar(3) * c3); }
  /// The larger magnitude that the second derivative has at the ends.
  [[nodiscard]] Scalar curvature() const {
    using std::abs;
    return Scalar(2) * (std::max)(Scalar(abs(c2)), Scalar(abs(c2 + Scalar(3) * c3)));
  }

  struct Extrema {
    std::array<Scalar, 2> x;
    std::size_t count = 0;
    void add(const Scalar& at) {
      if (at > Scalar(0) && at < Scalar(1)) x[count++] = at;
    }
  };
  /// Where in (0, 1) the slope is zero, ascending. Where it only comes close to zero, that point.
  [[nodiscard]] Extrema extrema() const {
    using std::abs, std::sqrt;
    Extrema e;
    const Scalar a = Scalar(3) * c3, end = c1 + Scalar(2) * c2 + a, d = c2 * c2 - a * c1;
    if (d <= Scalar(0)) {
      const Scalar largest = (std::max)(Scalar(abs(c1)), Scalar(abs(end)));
      if (a != Scalar(0) && abs(d) < largest * abs(a) / Scalar(10)) e.add(-c2 / a);
      return e;
    }
    const Scalar q = c2 > Scalar(0) ? Scalar(-c2 - sqrt(d)) : Scalar(-c2 + sqrt(d));
    const Scalar one = c1 / q, two = a == Scalar(0) ? Scalar(-1) : Scalar(q / a);
    e.add((std::min)(one, two));
    e.add((std::max)(one, two));
    return e;
  }

  /// A root in [0, 1] of a cubic that changes its sign there, by three steps from the secant.
  [[nodiscard]] Scalar root() const {
    const Scalar f1 = c0 + c1 + c2 + c3;
    Scalar x = c0 / (c0 - f1), low(0), high(1);
    for (int i = 0; i < 3; ++i) {
      const Scalar f = value(x), next = x - f / slope(x);
      ((f < Scalar(0)) == (c0 < Scalar(0)) ? low : high) = x;
      x = next >= low && next <= high ? next : Scalar((low + high) / Scalar(2));
    }
    return x;
  }
};

}  // namespace splinertia::detail
