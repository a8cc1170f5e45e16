// SPDX-License-Identifier: MIT
/// End conditions of a spline through given points. They fix the Order − 2 degrees of freedom that the points leave.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/spline/fit/detail/smoothness.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia {

enum class EndCondition {
  /// The acceleration is zero (orders 6 and 8: derivatives Order/2 … Order − 2 are zero).
  natural,
  /// The velocity is given (orders 6 and 8: derivatives 2 … Order/2 − 1 are also zero).
  clamped,
  /// The first two segments are one polynomial, and so are the last two (orders 6 and 8: Order/2 each). No derivative
  /// is prescribed.
  not_a_knot,
};

template <LieGroup G>
struct CurveEnds {
  EndCondition condition = EndCondition::natural;
  /// Velocity at clamped ends, in the body frame: rad/s and, for SO3xR3, m/s in the world frame. By default zero.
  Tangent<G> start_velocity = Tangent<G>::Zero();
  Tangent<G> end_velocity = Tangent<G>::Zero();
};

namespace detail {

/// End conditions as a least-squares cost. Velocity and acceleration are those of the curve. A higher derivative is
/// Σ λ_j⁽ᵐ⁾ d_j, as if the increments commuted; not-a-knot is a difference of increments. Each is scaled by the length
/// of the segment to the unit of an increment.
template <typename Curve>
class EndTerm {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  static constexpr int order = Curve::order;

  EndTerm(const CurveEnds<G>& ends, const Curve& curve) : ends_(ends) {
    if (ends.condition != EndCondition::not_a_knot) {
      const int from = ends.condition == EndCondition::natural ? order / 2 : 1;
      const int to = ends.condition == EndCondition::natural ? order - 2 : order / 2 - 1;
      for (int m = from; m <= to; ++m) {
        if (m <= 2) {
          motion_derivatives_.push_back(m);
        } else {
          combine_derivative(curve, m, true);
          combine_derivative(curve, m, false);
        }
      }
    } else if constexpr (requires { curve.knots().interval; }) {
      // The highest derivative is continuous at the knot: the Order-th difference of the control points is zero.
      Combination c;
      for (int j = 0; j < order; ++j) {
        c.coefficient[static_cast<std::size_t>(j)] =
            Scalar((j % 2 == 0 ? 1 : -1) * binomial(order - 1, j)) / Scalar(binomial(order - 1, order / 2));
      }
      for (std::size_t s = 0; s + 1 < order / 2; ++s) {
        c.first = s;
        combinations_.push_back(c);
        c.first = curve.segments() - 2 - s;
        combinations_.push_back(c);
      }
    }
  }

  template <typename System>
  Scalar add(const Curve& curve, System& system) const {
    Scalar cost(0);
    for (const int m : motion_derivatives_) {
      cost += add_motion(curve, system, m, curve.start(), ends_.start_velocity);
      cost += add_motion(curve, system, m, curve.end(), ends_.end_velocity);
    }
    for (const Combination& c : combinations_) cost += add_combination(curve, system, c);
    return cost;
  }

 private:
  /// Σ coefficient_j d_{first + j}
  struct Combination {
    std::size_t first;
    FixedArray<Scalar, order> coefficient{};
  };

  [[nodiscard]] static Scalar length_of_segment(const Curve& curve, std::size_t s) {
    return to_seconds<Scalar>(curve.knots().knot(s + 1, order) - curve.knots().knot(s, order));
  }

  /// Adds the m-th derivative, m > 2, at an end. That of λ_j is the derivative of the polynomial through its second
  /// derivatives at the nodes of a segment.
  void combine_derivative(const Curve& curve, int m, bool at_start) {
    constexpr std::size_t nodes = order - 2;
    static const Quadrature<Scalar, nodes> quadrature;
    const std::size_t s = at_start ? 0 : curve.segments() - 1;
    const auto begin = curve.knots().knot(s, order), end = curve.knots().knot(s + 1, order);
    const Scalar length = length_of_segment(curve, s);
    FixedArray<FixedArray<Scalar, nodes>, order - 1> values;
    for (std::size_t n = 0; n < nodes; ++n) {
      const auto located = curve.knots().template basis<Scalar, order, 2>(
          begin + fraction_of(end - begin, quadrature.node[n]), curve.control_points().size());
      for (std::size_t j = 0; j + 1 < order; ++j) values[j][n] = located.basis.lambda[2][j] * length * length;
    }
    Combination c;
    c.first = s;
    for (std::size_t j = 0; j + 1 < order; ++j) {
      for (int derivative = 2; derivative < m; ++derivative) values[j] = quadrature.differentiated(values[j]);
      c.coefficient[j] = quadrature.value_at(at_start ? Scalar(0) : Scalar(1), values[j]);
    }
    combinations_.push_back(c);
  }

  template <typename System>
  static Scalar add_motion(const Curve& curve, System& system, int m, typename Curve::Time time,
                           const Tangent<G>& velocity) {
    auto at = curve.template linearize<2>(time);
    const Scalar length = length_of_segment(curve, at.first), unit = m == 1 ? length : length * length;
    const Tangent<G> r = m == 1 ? Tangent<G>((at.velocity - velocity) * unit) : Tangent<G>(at.acceleration * unit);
    auto& J = m == 1 ? at.velocity_jacobian : at.acceleration_jacobian;
    for (auto& j : J) j *= unit;
    system.add(at.first, r, J);
    return r.squaredNorm();
  }

  template <typename System>
  static Scalar add_combination(const Curve& curve, System& system, const Combination& c) {
    Tangent<G> r = Tangent<G>::Zero();
    FixedArray<Jacobian<G>, order + 1> J;
    J.fill(Jacobian<G>::Zero());
    std::size_t points = 1;
    for (std::size_t j = 0; j < order; ++j) {
      if (c.coefficient[j] == Scalar(0)) continue;
      const Tangent<G>& d = curve.increments()[c.first + j];
      r += c.coefficient[j] * d;
      J[j] -= c.coefficient[j] * left_jacobian_inverse<G>(d);
      J[j + 1] += c.coefficient[j] * right_jacobian_inverse<G>(d);
      points = j + 2;
    }
    if (points <= order) {
      FixedArray<Jacobian<G>, order> fewer;
      std::copy_n(J.begin(), order, fewer.begin());
      system.add(c.first, r, fewer);
    } else {
      system.add(c.first, r, J);
    }
    return r.squaredNorm();
  }

  CurveEnds<G> ends_;
  std::vector<int> motion_derivatives_;
  std::vector<Combination> combinations_;
};

}  // namespace detail

}  // namespace splinertia
