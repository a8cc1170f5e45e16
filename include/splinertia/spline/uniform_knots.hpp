// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <splinertia/group/detail/stumpff.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/spline/knots.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>

namespace splinertia {

/// Equally spaced knots. n control points of order k give n − k + 1 segments from `start` on:
///
///   control points   X_0      X_1      X_2      X_3      X_4      X_5          order 4
///   time                     start   +1·int   +2·int    (end)
///   segments                   |-- 0 ---|-- 1 ---|-- 2 ---|
///
/// Segment s uses X_s … X_{s+k−1}. Control point i belongs to the time start + (i − k/2 + 1)·interval, for odd k
/// halfway between two knots.
template <TimePoint T = double>
struct UniformKnots {
  using Time = T;

  Time start;     ///< where the curve begins, s for a floating-point Time
  Time interval;  ///< > 0

  /// Throws std::invalid_argument unless start is finite, interval is positive and finite, Time can represent the end
  /// and tell the knots apart, and Scalar, the scalar of the curve, can represent the interval and its reciprocal.
  template <typename Scalar = typename detail::UsualScalar<Time>::type>
  void check(std::size_t control_points, int order) const {
    const auto number = detail::seconds_or_ticks(interval);
    if (!(number > 0) || !detail::is_finite(interval)) {
      detail::refuse<std::invalid_argument>("UniformKnots: interval is ", number,
                                            ", expected a positive finite number");
    }
    if (!detail::is_finite(start)) {
      detail::refuse<std::invalid_argument>("UniformKnots: start is ", detail::seconds_or_ticks(start),
                                            ", expected a finite number");
    }
    const std::size_t segments = control_points - static_cast<std::size_t>(order) + 1;
    bool reached;
    if constexpr (std::floating_point<Time>) {
      reached = detail::is_finite(domain(control_points, order).end);
    } else {
      reached = segments <= static_cast<std::size_t>((Time::max)() / interval) &&
                start <= (Time::max)() - static_cast<typename Time::rep>(segments) * interval;
    }
    if (!reached) {
      detail::refuse<std::invalid_argument>("UniformKnots: ", segments, " segments of ", number, " starting at ",
                                            detail::seconds_or_ticks(start), " exceed the largest representable time");
    }
    if constexpr (std::floating_point<Time>) {
      const Time end = domain(control_points, order).end, last = (std::max)(std::abs(start), std::abs(end));
      detail::check_lengths<Scalar>("UniformKnots", interval, end - start);
      const Time resolution = std::numeric_limits<Time>::epsilon() * last;
      if (interval < 4 * resolution) {
        detail::refuse<std::invalid_argument>("UniformKnots: interval is ", interval, " s, but times near ", last,
                                              " s have a resolution of ", resolution,
                                              " s; expected a longer interval or an integer time type");
      }
    }
  }

  [[nodiscard]] detail::Domain<Time> domain(std::size_t control_points, int order) const {
    return {start, knot(control_points - static_cast<std::size_t>(order) + 1, order)};
  }

  /// The knot where segment s begins and segment s − 1 ends.
  [[nodiscard]] Time knot(std::size_t s, [[maybe_unused]] int order) const {
    if constexpr (std::floating_point<Time>) {
      return start + static_cast<Time>(s) * interval;
    } else {
      return start + static_cast<typename Time::rep>(s) * interval;
    }
  }

  /// The time that control point i belongs to, which may be outside the domain.
  [[nodiscard]] Time control_point_time(std::size_t i, int order) const {
    return after(start, (static_cast<double>(i) + 1 - 0.5 * order) * to_seconds<double>(interval));
  }

  /// The index of the segment that contains t. A knot belongs to the segment that it begins, the end of the domain to
  /// the last segment. Outside the domain (asserted): the first or last segment.
  [[nodiscard]] std::size_t segment(Time t, std::size_t control_points, int order) const {
    detail::assert_inside(domain(control_points, order), t);
    const std::size_t last = control_points - static_cast<std::size_t>(order);
    if constexpr (std::floating_point<Time>) {
      // The quotient may round up to the next integer. The sign of the remainder, which fma gives exactly, shows it.
      const Time quotient = (t - start) / interval;
      const Time clamped = quotient > Time(0) ? quotient : Time(0);
      const std::size_t s =
          clamped < static_cast<Time>(last) ? static_cast<std::size_t>(static_cast<std::ptrdiff_t>(clamped)) : last;
      return s > 0 && since_knot(s, t) < 0 ? s - 1 : s;
    } else {
      const Time since = detail::time_between(start, t);
      return since < Time::zero() ? 0 : (std::min)(static_cast<std::size_t>(since / interval), last);
    }
  }

  template <typename Scalar, int Order, int D>
  [[nodiscard]] detail::BasisAt<Scalar, Order, D> basis(Time t, std::size_t control_points) const {
    using Real = detail::Constant<Scalar>;
    const std::size_t s = segment(t, control_points, Order);
    Real u;
    if constexpr (!std::floating_point<Time>) {
      // A difference of two times since the start, because t − knot may overflow Time.
      const Time since_knot = detail::time_between(start, t) - (knot(s, Order) - start);
      u = static_cast<Real>(since_knot.count()) / static_cast<Real>(interval.count());
    } else if constexpr (std::numeric_limits<Real>::digits > std::numeric_limits<Time>::digits) {
      u = Real(since_knot(s, t)) / Real(interval);
    } else {
      u = static_cast<Real>(normal_powers<Real>(since_knot(s, t) / interval));
    }
    return {s, uniform_basis<Order, D, Real, Scalar>(u, to_seconds<Real>(interval))};
  }

  /// Segment s of a curve, prepared for evaluating its basis at many times.
  template <int Order>
  class Segment {
   public:
    Segment(const UniformKnots& knots, std::size_t s)
        : interval_(knots.interval), start_(knots.start), begin_(knots.knot(s, Order)) {
      if constexpr (std::floating_point<Time>) {
        offset_ = static_cast<Time>(s) * interval_;
        offset_error_ = std::fma(static_cast<Time>(s), interval_, -offset_);
      }
    }
    /// Start of the segment; rounded for a floating-point Time.
    [[nodiscard]] Time begin() const { return begin_; }
    [[nodiscard]] Time end() const { return begin_ + interval_; }

    /// The basis at several times, bitwise equal to basis(). t is in seconds if Time is double, in ticks since begin()
    /// if it is an integer duration.
    template <int D, typename Real, int N, int Bytes>
    [[nodiscard]] CumulativeBasis<detail::SimdPack<Real, N, Bytes>, Order, D> basis(
        const detail::SimdPack<double, N, Bytes>& t) const {
      using L = detail::SimdPack<Real, N, Bytes>;
      using Wide = detail::SimdPack<double, N, Bytes>;
      if constexpr (std::floating_point<Time>) {
        // Subtracting offset_ is exact (Sterbenz), so subtracting offset_error_ rounds as the fma in since_knot() does.
        const Wide rest = ((t - Wide(start_)) - Wide(offset_)) - Wide(offset_error_);
        const L u = detail::simd_pack_cast<Real>(normal_powers<Real>(rest / Wide(interval_)));
        return uniform_basis<Order, D, L>(u, L(static_cast<Real>(interval_)));
      } else {
        const L u = detail::simd_pack_cast<Real>(t) / L(static_cast<Real>(interval_.count()));
        return uniform_basis<Order, D, L>(u, L(to_seconds<Real>(interval_)));
      }
    }

   private:
    Time interval_, start_, begin_;
    Time offset_{}, offset_error_{};  // the segment begins at start_ + offset_ + offset_error_
  };

 private:
  // Rounds u ∈ [0, 1] from double to a multiple of 2⁻⁴¹ before it becomes a float. The result is exact to float's last
  // digit unless u < 1e-5, and then to 2e-13 of the segment. Without it, a time that misses its knot by rounding would
  // have subnormal powers of u, which take a processor a hundred times as long.
  template <typename Real, typename U>
  [[nodiscard]] static U normal_powers(const U& u) {
    if constexpr (std::is_same_v<Real, float> && std::is_same_v<Time, double>) {
      return (u + U(2048.0)) - U(2048.0);
    } else {
      return u;
    }
  }

  // (t − start) − s·interval, where fma rounds once. A template, because clang 14 also instantiates members for integer
  // times.
  template <std::floating_point Seconds>
  [[nodiscard]] Seconds since_knot(std::size_t s, Seconds t) const {
    return std::fma(-static_cast<Seconds>(s), interval, t - start);
  }
};

template <typename T>
UniformKnots(T, T) -> UniformKnots<T>;

}  // namespace splinertia
