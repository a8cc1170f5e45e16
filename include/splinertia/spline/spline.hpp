// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/spline/knots.hpp>
#include <splinertia/spline/linearize.hpp>
#include <splinertia/spline/uniform_knots.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia {

namespace detail {

/// A linearization of a Spline. `first` is the index of the first of the Order control points that it refers to.
template <LieGroup G, int Order, int D>
struct LinearizationAt : Linearization<G, Order, D> {
  std::size_t first;
};

}  // namespace detail

/// A cumulative B-spline of order k = degree + 1 on a Lie group. It is Order − 2 times continuously differentiable, and
/// at any time Order control points determine it. From order 3 on they are in general not on the curve.
///
///   Spline<SO3xR3<double>, 4> curve({.start = 0.0, .interval = 0.1}, control_points);
///   auto m = curve.evaluate<2>(t);      // m.value, m.velocity, m.acceleration
///
/// Knots are uniform in double seconds by default; NonUniformKnots may be anywhere.
///
/// The increments d_i = log(X_i⁻¹ X_{i+1}) are stored with the control points, so evaluation computes no logarithm.
/// Only the constructor allocates.
template <LieGroup G, int Order, Knots K = UniformKnots<double>>
class Spline {
  static_assert(detail::is_supported_order<Order>, "Spline: orders 2 (linear) to 8 are supported");

 public:
  using Group = G;
  using Scalar = ScalarOf<G>;
  using Time = typename K::Time;
  static constexpr int order = Order;

  /// Throws std::invalid_argument for fewer than Order control points, invalid knots, or a control point that is not
  /// finite or off its group by more than 0.001. Smaller deviations are normalised unless they are rounding.
  Spline(K knots, std::vector<G> control_points)
      : knots_(std::move(knots)), control_points_(std::move(control_points)) {
    if (control_points_.size() < static_cast<std::size_t>(Order)) {
      detail::refuse<std::invalid_argument>("Spline: ", control_points_.size(), " control points, expected at least ",
                                            Order, ", the order of the curve");
    }
    knots_.template check<detail::Constant<Scalar>>(control_points_.size(), Order);
    for (std::size_t i = 0; i < control_points_.size(); ++i) control_points_[i] = on_group(control_points_[i], i);
    increments_.resize(control_points_.size() - 1);
    for (std::size_t i = 0; i < increments_.size(); ++i) {
      increments_[i] = checked_increment(i, control_points_[i], control_points_[i + 1]);
    }
  }

  /// Rejects control points of another group, or in a vector with another allocator.
  template <typename OtherPoint, typename OtherAllocator>
    requires(!std::same_as<std::vector<OtherPoint, OtherAllocator>, std::vector<G>>)
  Spline(K, const std::vector<OtherPoint, OtherAllocator>& control_points) = delete;

  /// The closed interval on which the curve is defined.
  [[nodiscard]] detail::Domain<Time> domain() const { return knots_.domain(control_points_.size(), Order); }
  [[nodiscard]] Time start() const { return domain().start; }
  [[nodiscard]] Time end() const { return domain().end; }
  /// start() <= t <= end().
  [[nodiscard]] bool contains(Time t) const { return domain().contains(t); }
  /// The nearest time to t at which the curve is defined; start() for NaN.
  [[nodiscard]] Time clamp(Time t) const { return domain().clamp(t); }

  /// Value and first D derivatives at t. Requires start() <= t <= end() (asserted). Outside, the first or last segment
  /// is extrapolated and soon far away; at() throws there, and clamp(t) is in the domain.
  template <int D>
  [[nodiscard]] Motion<G, D> evaluate(Time t) const {
    return detail::flattened<Scalar>([&] {
      const auto located = knots_.template basis<Scalar, Order, D>(t, control_points_.size());
      return detail::evaluate_increments<D>(control_points_[located.first], increments_from(located.first),
                                            located.basis);
    });
  }

  /// Value and first D derivatives at t with their Jacobians with respect to the Order control points from `first` on:
  ///
  ///   const auto at = curve.linearize<2>(t);    // .value, .value_jacobian[i], .velocity, .velocity_jacobian[i], …
  ///
  /// (linearize.hpp). Requires start() <= t <= end() (asserted).
  template <int D>
    requires LieGroupWithJacobians<G>
  [[nodiscard]] detail::LinearizationAt<G, Order, D> linearize(Time t) const {
    const auto located = knots_.template basis<Scalar, Order, D>(t, control_points_.size());
    return {
        detail::linearize_increments<D>(control_points_[located.first], increments_from(located.first), located.basis),
        located.first};
  }

  /// evaluate() that throws std::out_of_range unless start() <= t <= end().
  template <int D>
  [[nodiscard]] Motion<G, D> at(Time t) const {
    if (!contains(t)) {
      detail::refuse<std::out_of_range>("Spline: no curve at time ", detail::seconds_or_ticks(t),
                                        ", it is defined from ", detail::seconds_or_ticks(start()), " to ",
                                        detail::seconds_or_ticks(end()));
    }
    return evaluate<D>(t);
  }

  [[nodiscard]] const K& knots() const { return knots_; }
  /// Number of spans between the knots of the domain, empty ones included.
  [[nodiscard]] std::size_t segments() const { return control_points_.size() - static_cast<std::size_t>(Order) + 1; }
  [[nodiscard]] const std::vector<G>& control_points() const { return control_points_; }
  /// increments()[i] = log(X_i⁻¹ X_{i+1}).
  [[nodiscard]] const std::vector<Tangent<G>>& increments() const { return increments_; }

  /// Replaces control point i and recomputes the increments before and after it. Requires i < control_points().size()
  /// (asserted). Throws std::invalid_argument as the constructor does; the curve is then unchanged.
  void set_control_point(std::size_t i, const G& x) {
    assert(i < control_points_.size());
    const G updated = on_group(x, i);
    Tangent<G> before = Tangent<G>::Zero(), after = before;
    if (i > 0) before = checked_increment(i - 1, control_points_[i - 1], updated);
    if (i < increments_.size()) after = checked_increment(i, updated, control_points_[i + 1]);
    control_points_[i] = updated;
    if (i > 0) increments_[i - 1] = before;
    if (i < increments_.size()) increments_[i] = after;
  }

 private:
  /// d(j) of evaluate_increments() for the Order control points from `first` on.
  [[nodiscard]] auto increments_from(std::size_t first) const {
    return [d = increments_.data() + first](std::size_t j) -> const Tangent<G>& { return d[j]; };
  }

  /// x itself if it is on the group to rounding, otherwise x normalised. Throws if it is off by more than 0.001.
  [[nodiscard]] static G on_group(const G& x, [[maybe_unused]] std::size_t i) {
    if constexpr (std::floating_point<Scalar> && requires { GroupTraits<G>::normalized(x); }) {
      // Normalising rounds, which would disturb increments much smaller than 1. So numbers that are rounded to Scalar,
      // or, as most data, to double, stay unchanged.
      constexpr Scalar rounding =
          4 * (std::max)(std::numeric_limits<Scalar>::epsilon(), Scalar(std::numeric_limits<double>::epsilon()));
      constexpr Scalar tolerance = Scalar(1) / Scalar(1000);
      const Scalar drift = GroupTraits<G>::drift(x);
      if (drift <= rounding) return x;
      if (!(drift <= tolerance)) {
        detail::refuse<std::invalid_argument>("Spline: control point ", i, " is off its group by ", drift,
                                              ", expected at most ", tolerance, " (the norm of a rotation is 1)");
      }
      return GroupTraits<G>::normalized(x);
    } else {
      return x;
    }
  }

  /// The increment from control point i, x, to the next, y. Throws std::invalid_argument unless it is finite.
  [[nodiscard]] static Tangent<G> checked_increment([[maybe_unused]] std::size_t i, const G& x, const G& y) {
    const Tangent<G> d = increment<G>(x, y);
    if constexpr (std::floating_point<Scalar>) {
      if (!detail::all_finite(d)) {
        detail::refuse<std::invalid_argument>(
            "Spline: control points ", i, " and ", i + 1,
            " have no finite increment, expected finite values and a non-zero rotation part");
      }
    }
    return d;
  }

  K knots_;
  std::vector<G> control_points_;
  std::vector<Tangent<G>> increments_;
};

}  // namespace splinertia
