// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/finite.hpp>
#include <splinertia/group/stumpff.hpp>
#include <splinertia/message.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/spline/knots.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia {

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

  /// Throws std::invalid_argument unless start is finite, interval is positive and finite, and Time reaches to the
  /// end and tells the knots apart.
  void check(std::size_t control_points, int order) const {
    const auto number = printable(interval);
    if (!(number > 0) || !is_finite(interval)) {
      throw std::invalid_argument(message("UniformKnots: interval is ", number, ", expected a positive finite number"));
    }
    if (!is_finite(start)) {
      throw std::invalid_argument(message("UniformKnots: start is ", printable(start), ", expected a finite number"));
    }
    const std::size_t segments = control_points - static_cast<std::size_t>(order) + 1;
    bool reached;
    if constexpr (std::floating_point<Time>) {
      reached = is_finite(domain(control_points, order).end);
    } else {
      reached = segments <= static_cast<std::size_t>(Time::max() / interval) &&
                start <= Time::max() - static_cast<typename Time::rep>(segments) * interval;
    }
    if (!reached) {
      throw std::invalid_argument(message("UniformKnots: ", segments, " segments of ", number, " from ",
                                          printable(start), " on end later than any time that there is"));
    }
    if constexpr (std::floating_point<Time>) {
      const Time last = std::max(std::abs(start), std::abs(domain(control_points, order).end));
      const Time resolution = std::numeric_limits<Time>::epsilon() * last;
      if (interval < 4 * resolution) {
        throw std::invalid_argument(message("UniformKnots: interval is ", interval, " s, but times of ", last,
                                            " s are told apart by ", resolution,
                                            " s only; expected a longer interval, or time as integers"));
      }
    }
  }

  [[nodiscard]] Domain<Time> domain(std::size_t control_points, int order) const {
    return {start, knot(control_points - static_cast<std::size_t>(order) + 1, order)};
  }

  /// The knot where segment s begins, and segment s − 1 ends.
  [[nodiscard]] Time knot(std::size_t s, [[maybe_unused]] int order) const {
    if constexpr (std::floating_point<Time>) {
      return start + static_cast<Time>(s) * interval;
    } else {
      return start + static_cast<typename Time::rep>(s) * interval;
    }
  }

  /// The time that control point i belongs to, which may be outside the domain.
  [[nodiscard]] Time control_point_time(std::size_t i, int order) const {
    return after(start, (static_cast<double>(i) + 1 - 0.5 * order) * seconds<double>(interval));
  }

  template <typename Scalar, int Order, int D>
  [[nodiscard]] BasisAt<Scalar, Order, D> basis(Time t, std::size_t control_points) const {
    using Real = Constant<Scalar>;
    assert(t >= start && t <= domain(control_points, Order).end);
    const std::size_t last = control_points - static_cast<std::size_t>(Order);
    std::size_t s;
    Real u;
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
      if constexpr (std::numeric_limits<Real>::digits > std::numeric_limits<Time>::digits) {
        u = Real(remainder) / Real(interval);
      } else {
        u = static_cast<Real>(remainder / interval);
      }
    } else {
      const auto elapsed = (t - start).count();
      s = static_cast<std::size_t>(elapsed / interval.count());
      if (s > last) s = last;
      const auto remainder = elapsed - static_cast<typename Time::rep>(s) * interval.count();
      u = static_cast<Real>(remainder) / static_cast<Real>(interval.count());
    }
    return {s, uniform_basis<Order, D, Real, Scalar>(u, seconds<Real>(interval))};
  }
};

template <typename T>
UniformKnots(T, T) -> UniformKnots<T>;

}  // namespace splinertia
