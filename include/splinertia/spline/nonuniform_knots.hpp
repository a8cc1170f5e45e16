// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <splinertia/spline/detail/nonuniform_basis.hpp>
#include <splinertia/spline/knots.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia {

/// Knots τ_0 ≤ τ_1 ≤ … at arbitrary times: n control points of order k need n + k knots. The curve is defined on
/// [τ_{k−1}, τ_n]. On the span [τ_i, τ_{i+1}] the control points X_{i−k+1} … X_i determine it:
///
///   control points          X_0  X_1  X_2  X_3  X_4  X_5               order 4
///   knots         τ_0  τ_1  τ_2  τ_3  τ_4  τ_5  τ_6  τ_7  τ_8  τ_9
///   domain                       |----|----|----|
///
/// Knots may coincide. At a knot of multiplicity m inside the domain the curve is k − 1 − m times continuously
/// differentiable. With m = k − 1 it is continuous, has a corner, and passes through a control point. Multiplicity k
/// would make the curve discontinuous and is rejected. At the ends of the domain it is allowed: with k knots there, the
/// curve begins (ends) at the first (last) control point. The first and the last knot have no influence on the curve;
/// they exist by convention (De Boor 1978).
///
///   Spline<SO3xR3<double>, 4, NonUniformKnots<double>> curve({.knots = {0, 0, 0, 0, 0.1, 0.5, 2, 2, 2, 2}}, points);
template <TimePoint T = double>
struct NonUniformKnots {
  using Time = T;

  std::vector<Time> knots;  ///< ascending, s for a floating-point Time

  /// Throws std::invalid_argument unless these are control_points + order finite numbers in ascending order, the domain
  /// is not empty, every knot inside it has a multiplicity below `order`, and Time and Scalar, the scalar of the curve,
  /// can represent the lengths of all spans and their reciprocals.
  template <typename Scalar = typename detail::UsualScalar<Time>::type>
  void check(std::size_t control_points, int order) const {
    const auto k = static_cast<std::size_t>(order);
    if (knots.size() != control_points + k) {
      detail::refuse<std::invalid_argument>("NonUniformKnots: ", knots.size(), " knots, expected ", control_points + k,
                                            ": ", control_points, " control points plus the order, ", order);
    }
    for (std::size_t i = 0; i < knots.size(); ++i) {
      if (!detail::is_finite(knots[i])) {
        detail::refuse<std::invalid_argument>("NonUniformKnots: knot ", i, " is ", detail::seconds_or_ticks(knots[i]),
                                              ", expected a finite number");
      }
      if (i > 0 && knots[i] < knots[i - 1]) {
        detail::refuse<std::invalid_argument>("NonUniformKnots: knot ", i, " is ", detail::seconds_or_ticks(knots[i]),
                                              ", expected at least ", detail::seconds_or_ticks(knots[i - 1]),
                                              ", the knot before it");
      }
    }
    const auto [start, end] = domain(control_points, order);
    if (!(start < end)) {
      detail::refuse<std::invalid_argument>("NonUniformKnots: knots ", k - 1, " and ", control_points, " are both ",
                                            detail::seconds_or_ticks(start),
                                            ", expected a non-empty domain between them");
    }
    check_multiplicity(control_points, k, start, end);
    detail::check_span("NonUniformKnots", "knots", knots.front(), knots.back());
    if constexpr (std::floating_point<Time>) {
      Time shortest = end - start;
      for (std::size_t i = k; i <= control_points; ++i) {
        const Time length = knots[i] - knots[i - 1];
        if (length > 0 && length < shortest) shortest = length;
      }
      detail::check_lengths<Scalar>("NonUniformKnots", shortest, knots.back() - knots.front());
    }
  }

  /// [τ_{k−1}, τ_n]: from knot order − 1 to knot control_points.
  [[nodiscard]] detail::Domain<Time> domain(std::size_t control_points, int order) const {
    return {knots[static_cast<std::size_t>(order) - 1], knots[control_points]};
  }

  /// The knot where span s begins and span s − 1 ends.
  [[nodiscard]] Time knot(std::size_t s, int order) const { return knots[s + static_cast<std::size_t>(order) - 1]; }

  /// The time that control point i belongs to: the mean of the knots inside its support (Greville's abscissa).
  [[nodiscard]] Time control_point_time(std::size_t i, int order) const {
    double sum = 0;
    for (std::size_t j = 1; j < static_cast<std::size_t>(order); ++j)
      sum += to_seconds<double>(knots[i + j] - knots[i + 1]);
    return after(knots[i + 1], sum / (order - 1));
  }

  /// The index of the span that contains t. A knot belongs to the span that it begins, the end of the domain to the
  /// last non-empty span. Outside the domain (asserted): the first or last non-empty span. Takes time logarithmic in
  /// the number of knots.
  [[nodiscard]] std::size_t segment(Time t, std::size_t control_points, int order) const {
    return locate(t, control_points, order).span;
  }

  /// The basis at t. Finding the span takes time logarithmic in the number of knots.
  template <typename Scalar, int Order, int D>
  [[nodiscard]] detail::BasisAt<Scalar, Order, D> basis(Time t, std::size_t control_points) const {
    const auto [s, time] = locate(t, control_points, Order);
    const std::span<const Time, 2 * static_cast<std::size_t>(Order) - 2> around(
        knots.data() + s + 1, 2 * static_cast<std::size_t>(Order) - 2);
    return {s, detail::nonuniform_basis<Order, D, Scalar>(around, time)};
  }

  /// Span s of a curve, prepared for evaluating its basis at many times.
  template <int Order>
  class Segment {
    static constexpr std::size_t k = Order;

   public:
    Segment(const NonUniformKnots& knots, std::size_t s) {
      std::copy_n(knots.knots.data() + s + 1, around_.size(), around_.begin());
    }
    [[nodiscard]] Time begin() const { return around_[k - 2]; }
    [[nodiscard]] Time end() const { return around_[k - 1]; }

    /// The basis at several times, bitwise equal to basis(). t is in seconds if Time is double, in ticks since begin()
    /// if it is an integer duration.
    template <int D, typename Real, int N, int Bytes>
    [[nodiscard]] CumulativeBasis<detail::SimdPack<Real, N, Bytes>, Order, D> basis(
        const detail::SimdPack<double, N, Bytes>& t) const {
      using L = detail::SimdPack<Real, N, Bytes>;
      using Wide = detail::SimdPack<double, N, Bytes>;
      std::array<L, k - 1> before, behind;
      for (std::size_t j = 0; j < k - 1; ++j) {
        before[j] = detail::simd_pack_cast<Real>(t - Wide(locate(around_[j])));
        behind[j] = detail::simd_pack_cast<Real>(Wide(locate(around_[k - 1 + j])) - t);
      }
      return detail::nonuniform_basis<Order, D, L>(std::span<const Time, 2 * k - 2>(around_), before, behind);
    }

   private:
    // The time of a knot, in the units and from the origin of t in basis().
    [[nodiscard]] double locate(Time knot) const {
      if constexpr (std::floating_point<Time>) {
        return static_cast<double>(knot);
      } else {
        return detail::units_between<double>(begin(), knot);
      }
    }
    std::array<Time, 2 * k - 2> around_;
  };

 private:
  void check_multiplicity(std::size_t control_points, std::size_t k, Time start, Time end) const {
    for (std::size_t i = k; i + k - 1 < control_points; ++i) {
      if (knots[i] > start && knots[i + k - 1] < end && knots[i] == knots[i + k - 1]) {
        detail::refuse<std::invalid_argument>("NonUniformKnots: knots ", i, k > 2 ? " to " : " and ", i + k - 1,
                                              k > 2 ? " are all " : " are both ", detail::seconds_or_ticks(knots[i]),
                                              ", which would make the curve discontinuous; expected at most ", k - 1,
                                              " equal knots inside the domain, the order minus one");
      }
    }
  }

  struct KnotLocation {
    std::size_t span;
    Time time;  // t, clamped so that Time can represent its differences from the knots
  };
  [[nodiscard]] KnotLocation locate(Time t, std::size_t control_points, int order) const {
    const auto k = static_cast<std::size_t>(order);
    assert(knots.size() == control_points + k);
    const Time* const begin = knots.data() + k;
    const Time* const end = knots.data() + control_points;
    if (!(t >= begin[-1] && t < *end)) [[unlikely]]
      return locate_at_end(t, control_points, order);
    return {static_cast<std::size_t>(std::upper_bound(begin, end, t) - begin), t};
  }
  // place() for t at the end of the domain or outside it.
  [[nodiscard]] SPLINERTIA_COLD KnotLocation locate_at_end(Time t, std::size_t control_points, int order) const {
    const detail::Domain<Time> curve = domain(control_points, order);
    detail::assert_inside(curve, t);
    const Time* const begin = knots.data() + order;
    const Time* const end = knots.data() + control_points;
    const bool behind = t >= curve.end;
    // The knot that ends the last (`behind`) or the first non-empty span.
    const Time* const next =
        behind ? std::lower_bound(begin, end, curve.end) : std::upper_bound(begin, end, curve.start);
    if constexpr (!std::floating_point<Time>) {
      t = behind ? (std::min)(t, detail::time_between(-(Time::max)(), knots.front()))
                 : (std::max)(t, detail::time_between((Time::max)(), knots.back()));
    }
    return {static_cast<std::size_t>(next - begin), t};
  }
};

template <typename T>
NonUniformKnots(std::vector<T>) -> NonUniformKnots<T>;

}  // namespace splinertia
