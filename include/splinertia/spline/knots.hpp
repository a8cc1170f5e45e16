// SPDX-License-Identifier: MIT
/// What a curve asks of its knots: where it is defined, which control points shape it at a time, and how much each.
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

/// The closed interval of time on which a curve is defined.
template <TimePoint Time>
struct Domain {
  Time start;
  Time end;

  [[nodiscard]] constexpr bool contains(Time t) const { return t >= start && t <= end; }
  /// The nearest time of the domain; the start for NaN.
  [[nodiscard]] constexpr Time clamp(Time t) const { return !(t > start) ? start : t < end ? t : end; }
};

namespace detail {

/// Prints what an assertion cannot: which time. Returns false.
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

/// Throws std::invalid_argument unless a basis can be made of spans of these lengths, s, in Time and in Real, the
/// numbers of the curve: all lengths and their reciprocals, and 7/length (the derivative at order 8), must be normal
/// numbers. A higher derivative that exceeds Real is not finite.
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

/// What a curve over Time computes in, if its scalar is not known.
template <TimePoint Time>
struct UsualScalar {
  using type = double;
};
template <std::floating_point Time>
struct UsualScalar<Time> {
  using type = Time;
};

}  // namespace detail

/// Where a time falls: the first of the Order control points that shape the curve there, and the basis.
template <typename Scalar, int Order, int D>
struct BasisAt {
  std::size_t first;
  CumulativeBasis<Scalar, Order, D> basis;
};

/// Knots of a curve, of one Time: UniformKnots, NonUniformKnots. They know neither the control points nor their group,
/// and are given the number of them: an optimiser may own the points (spline/evaluate.hpp takes them beside a basis).
template <typename K>
concept Knots = std::copyable<K> && TimePoint<typename K::Time> &&
                requires(const K& knots, std::size_t control_points, int order, typename K::Time t) {
                  // Throws std::invalid_argument unless these are the knots of a curve of that order with so many
                  // control points, of which there are at least `order`, in a plain Scalar: template <typename Scalar>
                  // check(n, order). What is below requires that this does not throw.
                  knots.template check<double>(control_points, order);
                  { knots.domain(control_points, order) } -> std::same_as<Domain<typename K::Time>>;
                  // The knot where segment 0, 1, … of the domain begins, and the time that control point 0, 1, …
                  // belongs to.
                  { knots.knot(control_points, order) } -> std::same_as<typename K::Time>;
                  { knots.control_point_time(control_points, order) } -> std::same_as<typename K::Time>;
                  // The basis at t, for any Scalar, Order and D: template <typename Scalar, int Order, int D> basis(t,
                  // n). A knot belongs to the span that it begins, the end to the last span that is not empty. Outside
                  // the domain (asserted) the basis is that of the first or last span that is not empty, at that t.
                  { knots.template basis<double, 4, 2>(t, control_points) } -> std::same_as<BasisAt<double, 4, 2>>;
                };

}  // namespace splinertia
