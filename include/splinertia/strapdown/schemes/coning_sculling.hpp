// SPDX-License-Identifier: MIT
/// Schemes on integrated increments (Δθ, Δv), as inertial units for navigation deliver them. Their axes turn during the
/// interval; what that does to the sums is called coning (attitude), sculling (velocity) and scrolling (position).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// Increments as if the axes did not turn: ΔR = exp(Δθ), Δv as measured, Δp = Δv h/2. Order 1.
struct UncorrectedIncrements : IncrementScheme<1> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    const StepMean<Scalar>& step = window[from];
    return {rotation_exp<Scalar>(step.phi), step.nu, step.nu * (step.interval / Scalar(2)), step.interval};
  }
};

/// Rate and force as if constant over each interval: exact for that, with the rotation of the axes and without coning
/// and sculling. Order 2.
struct RotationCorrectedIncrements : IncrementScheme<1> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static StepMean<Scalar> moments(const Window& window, std::size_t from) {
    return window[from];
  }
};

/// Two increments at a time, through which rate and force are linear: order 4. For equal intervals the rotation is
/// Miller's Δθ₁ + Δθ₂ + 2/3 Δθ₁ × Δθ₂. Unequal ones see curvature as slope, so there a parabola goes through the two
/// and a neighbour, as it does for a single increment left at the end of a run. Where one interval is below a quarter
/// of another, a slope would be that of noise: there rate and force are constant over each interval, of order 2 as in
/// RotationCorrectedIncrements. Miller, JGCD 6 (1983); Savage, JGCD 21 (1998).
struct TwoSampleIncrements : IncrementScheme<3, 2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static StepMoments<Scalar> moments(const Window& window, std::size_t from) {
    const StepMean<Scalar>& last = window[2];
    const bool full = window[0].interval > Scalar(0);
    if (from == 2 && !full) {
      return {last.phi, last.nu, Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero(), last.interval};
    }
    const std::array<Scalar, 3> h{window[0].interval, window[1].interval, last.interval};
    const Scalar step = from == 2 ? h[2] : h[from] + h[from + 1];
    // The sum of the distances of the middle of the step from the ends of two increments.
    const Scalar offset = from == 2 ? h[1] + h[2] / Scalar(2) : (h[from + 1] - h[from]) / Scalar(2);
    // A difference is taken of intervals within a factor of four of each other.
    const auto alike = [&](std::size_t i, std::size_t j) {
      return h[i] <= Scalar(4) * h[j] && h[j] <= Scalar(4) * h[i];
    };
    const std::size_t pair = from == 0 ? 0 : 1;
    using std::abs;
    const bool straight = abs(offset) <= step * Scalar(1e-6F);  // what curvature adds is as little of that term
    const bool sloped = straight || alike(pair, pair + 1);
    const bool curved = full && !straight && sloped && alike(0, 1) && alike(0, 2) && alike(1, 2);
    // The slope A' there makes the moment step² A'/12; in divided differences of F = ∫A it is 2 F[0, 1, 2] + 2 offset
    // F[0, 1, 2, 3].
    const auto moment = [&](auto of) -> Vector3<Scalar> {
      if (!sloped) [[unlikely]] {
        if (from == 2) return Vector3<Scalar>::Zero();
        return (window[from + 1].*of * h[from] - window[from].*of * h[from + 1]) / (step + step);
      }
      const auto difference = [&](std::size_t i) -> Vector3<Scalar> {
        const Scalar scale = Scalar(1) / (h[i] + h[i + 1]);
        return window[i + 1].*of * Scalar(scale / h[i + 1]) - window[i].*of * Scalar(scale / h[i]);
      };
      Vector3<Scalar> slope = difference(pair);
      if (curved) slope += (difference(1) - difference(0)) * (offset / (h[0] + h[1] + h[2]));
      return slope * (step * step / Scalar(6));
    };
    const auto sum = [&](auto of) -> Vector3<Scalar> {
      return from == 2 ? last.*of : window[from].*of + window[from + 1].*of;
    };
    constexpr auto phi = &StepMean<Scalar>::phi, nu = &StepMean<Scalar>::nu;
    return {sum(phi), sum(nu), moment(phi), moment(nu), step};
  }
};

/// Three increments at a time, through which rate and force are parabolas: Ω = Σ Δ + 9/20 [Δ₁, Δ₃] + 27/40 [Δ₂, Δ₃ −
/// Δ₁] on the Galilean algebra, which makes coning, sculling and scrolling one formula. Order 4. The coefficients are
/// made for coning, where the attitude drifts with order 6; in other motion the longer step makes the error larger than
/// that of TwoSampleIncrements. Equal intervals only; others are refused. Miller, JGCD 6 (1983).
struct ThreeSampleIncrements : IncrementScheme<3> {
  static constexpr bool needs_equal_intervals = true;

  template <typename Scalar, typename Window>
  [[nodiscard]] static NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    if (from > 0) return increment_from(TwoSampleIncrements::moments<Scalar>(window, from));
    const auto as_vector = [](const StepMean<Scalar>& step) -> GalileanVector<Scalar> {
      return {step.phi, step.nu, Vector3<Scalar>::Zero(), step.interval};
    };
    const auto first = as_vector(window[0]), second = as_vector(window[1]), third = as_vector(window[2]);
    return galilean_exp(first + second + third + bracket(first, third) * (Scalar(9) / Scalar(20)) +
                        bracket(second, third - first) * (Scalar(27) / Scalar(40)));
  }
};

}  // namespace splinertia
