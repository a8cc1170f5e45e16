// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/spline/fit/detail/quadrature.hpp>
#include <splinertia/spline/linearize.hpp>
#include <splinertia/time.hpp>

namespace splinertia::detail {

/// The least-squares cost ∫ |x⁽ᵈ⁾/density|² dt over a span of a curve; d = 2 or 3, for order 2: d = 1. Exact for Rⁿ. On
/// other groups the third derivative is that of the polynomial through the second derivatives at the nodes of a
/// segment, which is as accurate as the spline's own approximation.
template <typename Curve>
class SmoothnessTerm {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  static constexpr int order = Curve::order;

  using Time = typename Curve::Time;

  /// Requires derivative 1 for order 2, otherwise 2 or 3 (3 from order 4 on), positive densities, and a span within the
  /// domain of the curve.
  SmoothnessTerm(int derivative, const Tangent<G>& density, Time from, Time to)
      : derivative_(derivative), inverse_density_(density.cwiseInverse()), from_(from), to_(to) {}

  template <typename System>
  Scalar add(const Curve& curve, System& system) const {
    if constexpr (order >= 3) {
      return add<2>(curve, system);
    } else {
      return add<1>(curve, system);
    }
  }

 private:
  template <int D, typename System>
  Scalar add(const Curve& curve, System& system) const {
    using std::sqrt;
    // The D-th derivative has degree order − 1 − D.
    constexpr std::size_t nodes = order - D;
    static const Quadrature<Scalar, nodes> quadrature;
    Scalar cost(0);
    const auto segment = [&](Time t) {
      return curve.knots().template basis<double, order, 0>(t, curve.control_points().size()).first;
    };
    for (std::size_t s = segment(from_), last = segment(to_); s <= last; ++s) {
      const Time start = (std::max)(from_, curve.knots().knot(s, order));
      const Time end = (std::min)(to_, curve.knots().knot(s + 1, order));
      const Scalar length = to_seconds<Scalar>(end - start);
      if (!(length > Scalar(0))) continue;
      std::array<Tangent<G>, nodes> value;
      std::array<ControlPointJacobians<G, order>, nodes> jacobian;
      for (std::size_t n = 0; n < nodes; ++n) {
        const auto at = curve.template linearize<D>(start + fraction_of(end - start, quadrature.node[n]));
        if constexpr (D == 1) {
          value[n] = at.velocity;
          jacobian[n] = at.velocity_jacobian;
        } else {
          value[n] = at.acceleration;
          jacobian[n] = at.acceleration_jacobian;
        }
      }
      for (std::size_t n = 0; n < nodes; ++n) {
        const Tangent<G> scale = inverse_density_ * sqrt(quadrature.weight[n] * length);
        Tangent<G> r = Tangent<G>::Zero();
        ControlPointJacobians<G, order> J;
        J.fill(Jacobian<G>::Zero());
        for (std::size_t m = 0; m < nodes; ++m) {
          if (derivative_ == D && m != n) continue;
          const Scalar share = derivative_ == D ? Scalar(1) : quadrature.derivative[n][m] / length;
          r += share * scale.cwiseProduct(value[m]);
          for (std::size_t i = 0; i < J.size(); ++i) J[i] += share * (scale.asDiagonal() * jacobian[m][i]);
        }
        cost += r.squaredNorm();
        system.add(s, r, J);
      }
    }
    return cost;
  }

  int derivative_;
  Tangent<G> inverse_density_;
  Time from_, to_;
};

}  // namespace splinertia::detail
