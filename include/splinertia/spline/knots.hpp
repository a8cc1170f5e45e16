// SPDX-License-Identifier: MIT
/// The Knots concept: where a curve is defined, which control points determine it at a time, and its basis there.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace splinertia {

namespace detail {

/// The closed interval of time on which a curve is defined.
template <TimePoint Time>
struct Domain {
  Time start;
  Time end;

  [[nodiscard]] constexpr bool contains(Time t) const { return t >= start && t <= end; }
  /// The time in the domain nearest to t; `start` for NaN.
  [[nodiscard]] constexpr Time clamp(Time t) const { return !(t > start) ? start : t < end ? t : end; }
};

/// Prints t and the domain, which assert() cannot. Returns false.
template <TimePoint Time>
bool report_outside(const Domain<Time>& domain, Time t) {
  if constexpr (std::floating_point<Time>) {
    const auto number = [](Time x) { return static_cast<long double>(x); };
    std::fprintf(stderr, "splinertia: no curve at time %.17Lg, it is defined from %.17Lg to %.17Lg\n", number(t),
                 number(domain.start), number(domain.end));
  } else {
    const auto number = [](Time x) { return static_cast<long long>(x.count()); };
    std::fprintf(stderr, "splinertia: no curve at time %lld, it is defined from %lld to %lld\n", number(t),
                 number(domain.start), number(domain.end));
  }
  return false;
}

/// Asserts that t is in the domain.
template <TimePoint Time>
void assert_inside([[maybe_unused]] const Domain<Time>& domain, [[maybe_unused]] Time t) {
  assert(domain.contains(t) || report_outside(domain, t));
}

/// Throws std::invalid_argument unless a basis can be computed for spans of `shortest` to `longest`, s, in both Time
/// and Real, the scalar of the curve. All lengths, their reciprocals, and 7/length (the derivative at order 8) must be
/// normal numbers. A higher derivative that overflows Real is not finite.
template <typename Real, std::floating_point Time>
void check_lengths(std::string_view whose, Time shortest, Time longest) {
  using RealLimits = std::numeric_limits<Real>;
  using TimeLimits = std::numeric_limits<Time>;
  using Narrow = std::conditional_t<(RealLimits::min_exponent > TimeLimits::min_exponent), Real, Time>;
  const Narrow smallest = (std::numeric_limits<Narrow>::min)();
  const auto least = static_cast<Time>(Narrow(8) * smallest), most = static_cast<Time>(Narrow(1) / smallest);
  if (!(shortest >= least)) {
    refuse<std::invalid_argument>(whose, ": the shortest span is ", shortest, " s, expected at least ", least, " s");
  }
  if (!(longest <= most)) {
    refuse<std::invalid_argument>(whose, ": knots span ", longest, " s, expected at most ", most, " s");
  }
}

/// The scalar assumed for a curve over Time if its own is unknown.
template <TimePoint Time>
struct UsualScalar {
  using type = double;
};
template <std::floating_point Time>
struct UsualScalar<Time> {
  using type = Time;
};

/// The basis at one time. `first` is the index of the first of the Order control points that determine the curve there.
template <typename Scalar, int Order, int D>
struct BasisAt {
  std::size_t first;
  CumulativeBasis<Scalar, Order, D> basis;
};

}  // namespace detail

/// The knots of a curve over one type of Time: UniformKnots, NonUniformKnots. Knots know neither the control points nor
/// their group; functions take the number of control points. So an optimiser may own the control points
/// (spline/evaluate.hpp takes them together with a basis).
template <typename K>
concept Knots = std::copyable<K> && TimePoint<typename K::Time> &&
                requires(const K& knots, std::size_t control_points, int order, typename K::Time t) {
                  // template <typename Scalar> check(n, order), for a plain Scalar: throws std::invalid_argument unless
                  // these are the knots of a curve of that order with n >= order control points. The functions below
                  // require that it does not throw.
                  knots.template check<double>(control_points, order);
                  { knots.domain(control_points, order) } -> std::same_as<detail::Domain<typename K::Time>>;
                  // The knot where segment 0, 1, … of the domain begins, and the time that control point 0, 1, …
                  // belongs to.
                  { knots.knot(control_points, order) } -> std::same_as<typename K::Time>;
                  { knots.control_point_time(control_points, order) } -> std::same_as<typename K::Time>;
                  // template <typename Scalar, int Order, int D> basis(t, n): the basis at t for any Scalar, Order and
                  // D. A knot belongs to the span that it begins, the end of the domain to the last non-empty span.
                  // Outside the domain (asserted) the first or last non-empty span is extrapolated to t.
                  {
                    knots.template basis<double, 4, 2>(t, control_points)
                  } -> std::same_as<detail::BasisAt<double, 4, 2>>;
                };

}  // namespace splinertia
