// SPDX-License-Identifier: MIT
/// What a curve asks of its knots: where it is defined, which control points shape it at a time, and how much each.
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/spline/basis.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

/// The closed interval of time on which a curve is defined.
template <TimePoint Time>
struct Domain {
  Time start;
  Time end;
};

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
                  // control points, of which there are at least `order`. What is below requires that this does not
                  // throw.
                  knots.check(control_points, order);
                  { knots.domain(control_points, order) } -> std::same_as<Domain<typename K::Time>>;
                  // The knot where segment 0, 1, … of the domain begins, and the time that control point 0, 1, …
                  // belongs to.
                  { knots.knot(control_points, order) } -> std::same_as<typename K::Time>;
                  { knots.control_point_time(control_points, order) } -> std::same_as<typename K::Time>;
                  // The basis at t, for any Scalar, Order and D: template <typename Scalar, int Order, int D> basis(t,
                  // n). Requires domain.start <= t <= domain.end (asserted). A knot belongs to the span that it begins,
                  // the end to the last span that is not empty.
                  { knots.template basis<double, 4, 2>(t, control_points) } -> std::same_as<BasisAt<double, 4, 2>>;
                };

}  // namespace splinertia
