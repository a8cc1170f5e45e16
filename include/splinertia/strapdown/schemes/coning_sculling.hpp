// SPDX-License-Identifier: MIT
/// Schemes on integrated increments (Δθ, Δv), as inertial navigation units deliver them. The axes turn during the
/// interval. The resulting errors are called coning (attitude), sculling (velocity) and scrolling (position).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// Treats increments as if the axes did not turn: ΔR = exp(Δθ), Δv as measured, Δp = Δv h/2. Order 1.
struct UncorrectedIncrements : IncrementScheme<1> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    const StepMean<Scalar>& step = window[from];
    return {detail::rotation_exp<Scalar>(step.phi), step.nu, step.nu * (step.interval / Scalar(2)), step.interval};
  }
};

/// Rate and force are constant over each interval; exact in that case. Corrects for the rotation of the axes, but not
/// for coning and sculling. Order 2.
struct RotationCorrectedIncrements : IncrementScheme<1> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static StepMean<Scalar> moments(const Window& window, std::size_t from) {
    return window[from];
  }
};

/// Two increments at a time, with rate and force linear over them. Order 4. For equal intervals the rotation vector is
/// Miller's Δθ₁ + Δθ₂ + 2/3 Δθ₁ × Δθ₂. For unequal ones a line would mistake curvature for slope, so rate and force are
/// parabolas over the two increments and a neighbour; likewise for a single increment left at the end of a run. If one
/// interval is below a quarter of another, noise would dominate the slope. Then rate and force are constant over each
/// interval, and the order is 2 as in RotationCorrectedIncrements. Miller, JGCD 6 (1983); Savage, JGCD 21 (1998).
struct TwoSampleIncrements : IncrementScheme<3, 2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::StepMoments<Scalar> moments(const Window& window, std::size_t from) {
    const StepMean<Scalar>& last = window[2];
    const bool full = window[0].interval > Scalar(0);
    if (from == 2 && !full) {
      return {last.phi, last.nu, Eigen::Vector3<Scalar>::Zero(), Eigen::Vector3<Scalar>::Zero(), last.interval};
    }
    const std::array<Scalar, 3> h{window[0].interval, window[1].interval, last.interval};
    const Scalar step = from == 2 ? h[2] : h[from] + h[from + 1];
    // Σ (m − t) over the three ends t of a pair of increments, where m is the middle of the step.
    const Scalar offset = from == 2 ? h[1] + h[2] / Scalar(2) : (h[from + 1] - h[from]) / Scalar(2);
    // Differences are taken only of intervals within a factor of four of each other.
    const auto alike = [&](std::size_t i, std::size_t j) {
      return h[i] <= Scalar(4) * h[j] && h[j] <= Scalar(4) * h[i];
    };
    const std::size_t pair = from == 0 ? 0 : 1;
    using std::abs;
    const bool straight = abs(offset) <= step * Scalar(1e-6F);  // then curvature changes the slope negligibly
    const bool sloped = straight || alike(pair, pair + 1);
    const bool curved = full && !straight && sloped && alike(0, 1) && alike(0, 2) && alike(1, 2);
    // The moment is step² A'/12 with the slope A' at the middle of the step. In divided differences of F = ∫A,
    // A' = 2 F[0, 1, 2] + 2 offset F[0, 1, 2, 3].
    const auto moment = [&](auto of) -> Eigen::Vector3<Scalar> {
      if (!sloped) [[unlikely]] {
        if (from == 2) return Eigen::Vector3<Scalar>::Zero();
        return (window[from + 1].*of * h[from] - window[from].*of * h[from + 1]) / (step + step);
      }
      const auto difference = [&](std::size_t i) -> Eigen::Vector3<Scalar> {
        const Scalar scale = Scalar(1) / (h[i] + h[i + 1]);
        return window[i + 1].*of * Scalar(scale / h[i + 1]) - window[i].*of * Scalar(scale / h[i]);
      };
      Eigen::Vector3<Scalar> slope = difference(pair);
      if (curved) slope += (difference(1) - difference(0)) * (offset / (h[0] + h[1] + h[2]));
      return slope * (step * step / Scalar(6));
    };
    const auto sum = [&](auto of) -> Eigen::Vector3<Scalar> {
      return from == 2 ? last.*of : window[from].*of + window[from + 1].*of;
    };
    constexpr auto phi = &StepMean<Scalar>::phi, nu = &StepMean<Scalar>::nu;
    return {sum(phi), sum(nu), moment(phi), moment(nu), step};
  }
};

/// Three increments at a time, with rate and force parabolas over them. On the Galilean algebra one formula covers
/// coning, sculling and scrolling:
///   Ω = Σ Δ + 9/20 [Δ₁, Δ₃] + 27/40 [Δ₂, Δ₃ − Δ₁]
/// Order 4. The coefficients are optimised for coning motion, where the attitude drift is of order 6. In other motion
/// the error is larger than that of TwoSampleIncrements, because the step is longer. Unequal intervals are refused.
/// Miller, JGCD 6 (1983).
struct ThreeSampleIncrements : IncrementScheme<3> {
  static constexpr bool needs_equal_intervals = true;

  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    if (from > 0) return detail::increment_from(TwoSampleIncrements::moments<Scalar>(window, from));
    const auto as_vector = [](const StepMean<Scalar>& step) -> detail::GalileanVector<Scalar> {
      return {step.phi, step.nu, Eigen::Vector3<Scalar>::Zero(), step.interval};
    };
    const auto first = as_vector(window[0]), second = as_vector(window[1]), third = as_vector(window[2]);
    return detail::galilean_exp(first + second + third + detail::bracket(first, third) * (Scalar(9) / Scalar(20)) +
                                detail::bracket(second, third - first) * (Scalar(27) / Scalar(40)));
  }
};

}  // namespace splinertia
