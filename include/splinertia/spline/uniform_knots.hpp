// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/message.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia {

/// Where a time falls: the first of the Order control points that shape the curve there, and the basis.
template <typename Scalar, int Order, int D>
struct BasisAt {
  std::size_t first;
  CumulativeBasis<Scalar, Order, D> basis;
};

/// Equally spaced knots. n control points of order k give n − k + 1 segments from `start` on:
///
///   control points   X_0      X_1      X_2      X_3      X_4      X_5          order 4
///   time                     start   +1·int   +2·int    (end)
///   segments                   |--- 0 ---|--- 1 ---|--- 2 ---|
///
/// Segment s uses X_s … X_{s+k−1}. For even orders control point i belongs to start + (i − k/2 + 1)·interval.
template <TimePoint T = double>
struct UniformKnots {
  using Time = T;

  Time start;     ///< where the curve begins, s for a floating-point Time
  Time interval;  ///< > 0

  /// Throws std::invalid_argument unless start is finite and interval is positive and finite.
  void check() const {
    const auto number = printable(interval);
    if (!(number > 0) || !is_finite(interval)) {
      throw std::invalid_argument(message("UniformKnots: interval is ", number, ", expected a positive finite number"));
    }
    if (!is_finite(start)) {
      throw std::invalid_argument(message("UniformKnots: start is ", printable(start), ", expected a finite number"));
    }
  }

  /// Where a curve of `segments` segments ends.
  [[nodiscard]] Time end(std::size_t segments) const {
    if constexpr (std::floating_point<Time>) {
      return start + static_cast<Time>(segments) * interval;
    } else {
      return start + static_cast<typename Time::rep>(segments) * interval;
    }
  }

  /// The basis at t. Requires start <= t <= end(segments).
  template <typename Scalar, int Order, int D>
  [[nodiscard]] BasisAt<Scalar, Order, D> basis(Time t, std::size_t segments) const {
    assert(t >= start && t <= end(segments));
    const std::size_t last = segments - 1;
    std::size_t s;
    Scalar u;
    if constexpr (std::floating_point<Time>) {
      // The quotient may round up to the next integer; the remainder, which fma gives exactly, tells.
      const Time elapsed = t - start;
      const Time quotient = elapsed / interval;
      s = quotient < static_cast<Time>(last) ? static_cast<std::size_t>(quotient) : last;
      Time remainder = std::fma(-static_cast<Time>(s), interval, elapsed);
      if (remainder < 0 && s > 0) {
        --s;
        remainder = std::fma(-static_cast<Time>(s), interval, elapsed);
      }
      if constexpr (std::numeric_limits<Scalar>::digits > std::numeric_limits<Time>::digits) {
        u = Scalar(remainder) / Scalar(interval);
      } else {
        u = static_cast<Scalar>(remainder / interval);
      }
    } else {
      const auto elapsed = (t - start).count();
      s = static_cast<std::size_t>(elapsed / interval.count());
      if (s > last) s = last;
      const auto remainder = elapsed - static_cast<typename Time::rep>(s) * interval.count();
      u = static_cast<Scalar>(remainder) / static_cast<Scalar>(interval.count());
    }
    return {s, uniform_basis<Order, D, Scalar>(u, seconds<Scalar>(interval))};
  }

 private:
  static bool is_finite(Time t) {
    if constexpr (std::floating_point<Time>) {
      return std::isfinite(t);
    } else {
      return true;
    }
  }
};

template <typename T>
UniformKnots(T, T) -> UniformKnots<T>;

}  // namespace splinertia
