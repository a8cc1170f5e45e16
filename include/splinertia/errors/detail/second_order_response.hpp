// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>

namespace splinertia::detail {

/// The free motion (x = 0) of the damped oscillator y″ + 2ζω y′ + ω² y = ω² x over a time h: the matrix that maps
/// (y, y′/ω) at the beginning to (y, y′/ω) at the end. It depends on a = ωh >= 0 and the damping ratio ζ > 0 alone:
///
///   e^{−ζa} [ C + ζaS, aS; −aS, C − ζaS ],  C = cos b, S = sin b/b, b = a√(1 − ζ²), or cosh, sinh for ζ > 1.
///
/// The absolute error is a few eps for every a and ζ; for ζ < 1 it is 1/ζ times as much, because the phase b after many
/// turns is rounded. The growing exponentials of an overdamped oscillator are never formed. Requires that the third
/// power of ζ is finite.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 2, 2> oscillator_transition(const Scalar& a, const Scalar& damping_ratio) {
  using std::sqrt;
  // Everything has decayed: a/2ζ is large, too.
  if (!is_finite(a) || !is_finite(damping_ratio * a)) return Eigen::Matrix<Scalar, 2, 2>::Zero();
  Scalar C, S;  // both include the factor e^{−ζa}
  if (damping_ratio < Scalar(1)) {
    const Scalar b = a * sqrt((Scalar(1) - damping_ratio) * (Scalar(1) + damping_ratio));
    const Oscillation<Scalar> oscillation(b / (Scalar(2) * pi_of<Scalar>()));
    const Scalar left = exp_minus<Scalar>(damping_ratio * a);
    C = left * oscillation.cosine;
    S = b > Scalar(0) ? Scalar(left * oscillation.sine / b) : left;
  } else {
    const Scalar root = sqrt((damping_ratio - Scalar(1)) * (damping_ratio + Scalar(1)));
    const Scalar b = a * root;
    const Scalar slow = exp_minus<Scalar>(a / (damping_ratio + root));  // e^{−ζa + b}
    const Scalar fast = exp_minus<Scalar>(a * (damping_ratio + root));  // e^{−ζa − b}
    C = (slow + fast) / Scalar(2);
    S = b > Scalar(0) ? Scalar(slow * one_minus_exp_minus<Scalar>(Scalar(2) * b) / (Scalar(2) * b)) : slow;
  }
  Eigen::Matrix<Scalar, 2, 2> transition;
  transition(0, 0) = C + damping_ratio * a * S;
  transition(0, 1) = a * S;
  transition(1, 0) = -a * S;
  transition(1, 1) = C - damping_ratio * a * S;
  return transition;
}

/// The unit step response of that oscillator from rest: y after the time h. It equals 1 − transition(0, 0), computed so
/// that it goes to zero with a: the error is a few eps times a/ζ where that is less than one.
template <typename Scalar>
[[nodiscard]] Scalar oscillator_step_response(const Scalar& a, const Scalar& damping_ratio) {
  using std::sqrt;
  if (damping_ratio > Scalar(5) / Scalar(4)) {
    // Two first-order lags in series, with these time constants (times ω).
    const Scalar root = sqrt((damping_ratio - Scalar(1)) * (damping_ratio + Scalar(1)));
    const Scalar slow = damping_ratio + root, fast = Scalar(1) / slow;
    return (slow * one_minus_exp_minus<Scalar>(a / slow) - fast * one_minus_exp_minus<Scalar>(a * slow)) /
           (Scalar(2) * root);
  }
  const Scalar left = -damping_ratio * oscillator_transition(a, damping_ratio)(0, 1);  // −ζaS
  if (damping_ratio < Scalar(1)) {
    const Scalar b = a * sqrt((Scalar(1) - damping_ratio) * (Scalar(1) + damping_ratio));
    const Scalar half = Oscillation<Scalar>(b / (Scalar(4) * pi_of<Scalar>())).sine;  // 1 − cos b = 2 sin² b/2
    return left + one_minus_exp_minus<Scalar>(damping_ratio * a) +
           Scalar(2) * exp_minus<Scalar>(damping_ratio * a) * half * half;
  }
  const Scalar root = sqrt((damping_ratio - Scalar(1)) * (damping_ratio + Scalar(1)));
  return left + (one_minus_exp_minus<Scalar>(a / (damping_ratio + root)) +
                 one_minus_exp_minus<Scalar>(a * (damping_ratio + root))) /
                    Scalar(2);
}

}  // namespace splinertia::detail
