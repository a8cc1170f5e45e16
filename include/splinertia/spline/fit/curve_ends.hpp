// SPDX-License-Identifier: MIT
/// What a spline through given points does at its ends, where the points leave it Order − 2 freedoms.
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
  /// The acceleration is zero (of order 6 and 8: derivatives Order/2 … Order − 2).
  natural,
  /// The velocity is given (of order 6 and 8: derivatives 2 … Order/2 − 1 are zero).
  clamped,
  /// The first two and the last two segments (Order/2 each) are of one polynomial: nothing is assumed.
  not_a_knot,
};

template <LieGroup G>
struct CurveEnds {
  EndCondition condition = EndCondition::natural;
  /// At clamped ends, in the body frame (rad/s and, for SO3xR3, m/s in the world); by default at rest.
  Tangent<G> start_velocity = Tangent<G>::Zero();
  Tangent<G> end_velocity = Tangent<G>::Zero();
};

/// End conditions as squares to minimise. Velocity and acceleration are those of the curve; a higher derivative is
/// Σ λ_j⁽ᵐ⁾ d_j, that of the increments as if they commuted, and not-a-knot a difference of them. Each is brought to
/// the unit of an increment by the length of the segment.
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
      // The highest derivative, an Order-th difference of the control points, goes on through the knot.
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

  /// The m-th derivative of λ_j, m > 2, at an end: of the polynomial through the second ones at the nodes of a segment.
  void combine_derivative(const Curve& curve, int m, bool at_start) {
    constexpr std::size_t nodes = order - 2;
    static const Quadrature<Scalar, nodes> quadrature;
    const std::size_t s = at_start ? 0 : curve.segments() - 1;
    const auto begin = curve.knots().knot(s, order), end = curve.knots().knot(s + 1, order);
    const Scalar length = length_of_segment(curve, s);
    FixedArray<FixedArray<Scalar, nodes>, order - 1> values;
    for (std::size_t n = 0; n < nodes; ++n) {
      const auto place = curve.knots().template basis<Scalar, order, 2>(
          begin + fraction_of(end - begin, quadrature.node[n]), curve.control_points().size());
      for (std::size_t j = 0; j + 1 < order; ++j) values[j][n] = place.basis.lambda[2][j] * length * length;
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

}  // namespace splinertia
