// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/spline/fit/detail/banded_system.hpp>
#include <utility>

namespace splinertia::detail {

/// The stopping criteria of minimize().
template <typename Scalar>
struct Convergence {
  Scalar relative;  ///< the predicted decrease of the cost is at most this share of it
  Scalar absolute;  ///< the predicted decrease of the cost is at most this
  int most_iterations;
};

template <typename Scalar>
struct Minimum {
  Scalar cost;
  int iterations = 0;
  bool converged = false;
};

/// Moves `state` to a minimum of the cost of `model`, by Gauss–Newton steps. Where a step does not lower the cost, it
/// is damped as by Levenberg and Marquardt (Nocedal, Wright, Numerical Optimization, 2nd ed., 10.3). A model has
///
///   cost = model.linearize(state, system)   adds the normal equations at `state` to the cleared `system`
///   model.retracted(state, step)            the state, moved by a step
///
/// On return `system` holds the normal equations at the final state, and `factor` the factorisation of the last step.
template <typename Model, typename State, typename System>
Minimum<typename System::Scalar> minimize(const Model& model, State& state, System& system,
                                          BandedCholesky<System>& factor,
                                          const Convergence<typename System::Scalar>& until) {
  using Scalar = typename System::Scalar;
  constexpr Scalar first_damping = Scalar(1) / Scalar(10000), most_damping(1e12f);
  Minimum<Scalar> result{model.linearize(state, system)};
  System next = system;
  Scalar damping(0), needed(0);  // needed: for a positive definite matrix
  while (result.iterations < until.most_iterations) {
    if (!factor.compute(system, damping)) {
      if (damping >= most_damping) return result;
      needed = damping = (std::max)(10 * damping, first_damping);
      continue;
    }
    typename System::Vector step = system.right;
    factor.solve(step);
    ++result.iterations;
    // |J δ|² ≤ δᵀb also holds for the damped step.
    const Scalar decrease = step.dot(system.right);
    const bool small = decrease <= until.absolute || decrease <= until.relative * result.cost;
    State candidate = model.retracted(state, step);
    next.clear();
    const Scalar cost = model.linearize(candidate, next);
    // Near the minimum the costs differ only by rounding, so a small step is accepted as the last one. But a step with
    // more damping than needed may be small anywhere.
    const bool last = small && damping <= needed;
    if (cost <= result.cost || last) {
      state = std::move(candidate);
      result.cost = cost;
      std::swap(system, next);
      damping = damping > first_damping ? damping / 10 : Scalar(0);
      damping = (std::max)(damping, needed);
      if (last) {
        result.converged = true;
        return result;
      }
    } else if (small || damping >= most_damping) {
      return result;
    } else {
      damping = (std::max)(10 * damping, first_damping);
    }
  }
  return result;
}

/// The condition number of the matrix scaled to unit diagonal (ratio of its largest to its smallest eigenvalue),
/// estimated by a few iterations of the power method: a lower bound, mostly within a factor of two. Its square root is
/// the worst-case ratio of the scatter of the control points to that of the data.
template <typename System>
[[nodiscard]] typename System::Scalar condition_estimate(const System& system, const BandedCholesky<System>& factor) {
  using std::sqrt;
  using Scalar = typename System::Scalar;
  using Vector = typename System::Vector;
  const auto scaled = [&](Vector x, bool inverse) {
    const auto apply = [&](auto& block, const auto& diagonal) {
      for (int i = 0; i < block.size(); ++i) {
        const Scalar root = sqrt(diagonal[i]);
        block[i] = inverse ? block[i] * root : block[i] / root;
      }
    };
    for (std::size_t i = 0; i < x.blocks.size(); ++i) apply(x.blocks[i], system.rows[i].lower[0].diagonal());
    apply(x.border, system.corner.diagonal());
    return x;
  };
  const auto largest = [&](const auto& product) {
    // Neither smooth nor regular, so it has components along every eigenvector.
    Vector x = system.right;
    std::size_t i = 0;
    for (auto& block : x.blocks) block.setConstant(Scalar(1) / Scalar(1 + i * 7 % 11) * (i % 2 == 0 ? 1 : -1)), ++i;
    x.border.setOnes();
    Scalar norm(0);
    for (int iteration = 0; iteration < 12; ++iteration) {
      x.scale(Scalar(1) / sqrt(x.dot(x)));
      x = product(x);
      norm = sqrt(x.dot(x));
    }
    return norm;
  };
  return largest([&](const Vector& x) { return scaled(multiply(system, scaled(x, false)), false); }) *
         largest([&](const Vector& x) {
           Vector y = scaled(x, true);
           factor.solve(y);
           return scaled(y, true);
         });
}

}  // namespace splinertia::detail
