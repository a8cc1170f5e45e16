// SPDX-License-Identifier: MIT
/// An integration scheme is a type that turns a window of neighbouring samples into the motion over a step, without
/// heap, state or virtual calls. It derives from PointScheme or IncrementScheme, which say how many samples it looks
/// at, and has one of
///
///   static StepMean | StepMoments moments(window, from)   the integrals of rate and force over the step
///   static NavIncrement increment(window, from)           the motion itself
///
/// as templates of the scalar. For point samples the step goes from window[from] to window[from + stride], or to the
/// last sample of the window if that comes first. For increments it consists of up to `stride` of them from
/// window[from] on. If fewer increments have come than the window holds, the missing ones have an interval of 0.
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/strapdown/detail/galilean.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

/// A scheme on point samples: it looks at `Window` of them, advances by `Stride` intervals at a time, and needs `Lead`
/// samples beyond the end of a step, except in the last steps of a run.
template <std::size_t Window, std::size_t Stride = 1, std::size_t Lead = 0>
struct PointScheme {
  static constexpr bool takes_increments = false, needs_equal_intervals = false;
  static constexpr std::size_t window = Window, stride = Stride, lead = Lead;
};

/// A scheme on integrated increments: it looks at `Window` of them and advances by `Stride` at a time. With
/// needs_equal_intervals, unequal ones are refused.
template <std::size_t Window, std::size_t Stride = Window>
struct IncrementScheme {
  static constexpr bool takes_increments = true, needs_equal_intervals = false;
  static constexpr std::size_t window = Window, stride = Stride, lead = 0;
};

/// The time from window[from] to the next sample, s.
template <typename Scalar, typename Window>
[[nodiscard]] Scalar step_interval(const Window& window, std::size_t from) {
  return to_seconds<Scalar>(window[from + 1].time - window[from].time);
}

/// The integrals over a step of the angular velocity, φ = ∫ω dt (rad), and of the specific force, ν = ∫f dt (m/s), both
/// in the turning axes of the body; `interval` is the length h, s. An increment of an IMU is of this form.
template <typename Scalar>
struct StepMean {
  Eigen::Vector3<Scalar> phi, nu;
  Scalar interval;
};

namespace detail {

/// The same with first moments: φ₁ = ∫sω dt/h, ν₁ = ∫sf dt/h, where s is the time from the middle of the step.
template <typename Scalar>
struct StepMoments {
  Eigen::Vector3<Scalar> phi, nu;
  Eigen::Vector3<Scalar> phi_moment, nu_moment;
  Scalar interval;
};

/// The logarithm of the motion over a step, X' = X A, to fourth order:
///   Ω = M₀ + [M₀, M₁],  M₀ = (φ, ν, 0, h),  M₁ = (φ₁, ν₁, 0, 0)
/// Magnus (1954); Iserles et al., "Lie-group methods", Acta Numerica 9 (2000), 4.
template <typename Scalar>
[[nodiscard]] GalileanVector<Scalar> magnus4(const StepMoments<Scalar>& m) {
  return {m.phi + m.phi.cross(m.phi_moment), m.nu + m.phi.cross(m.nu_moment) + m.nu.cross(m.phi_moment),
          m.nu_moment * -m.interval, m.interval};
}

template <typename Scalar>
[[nodiscard]] NavIncrement<Scalar> increment_from(const StepMean<Scalar>& m) {
  return galilean_exp(stumpff<5>(Scalar(m.phi.squaredNorm())), m.phi, m.nu, m.interval);
}
template <typename Scalar>
[[nodiscard]] NavIncrement<Scalar> increment_from(const StepMoments<Scalar>& m) {
  return galilean_exp(magnus4(m));
}

/// Whether a scheme has moments(), the integrals of rate and force.
template <typename Scheme, typename Scalar, typename Window>
concept HasMoments =
    requires(const Window& window) { increment_from(Scheme::template moments<Scalar>(window, std::size_t{0})); };

/// Whether a scheme has increment(), the motion itself.
template <typename Scheme, typename Scalar, typename Window>
concept HasIncrement = requires(const Window& window) {
  { Scheme::template increment<Scalar>(window, std::size_t{0}) } -> std::convertible_to<NavIncrement<Scalar>>;
};

/// The motion over the step of a scheme that begins at window[from].
template <typename Scheme, typename Scalar, typename Window>
[[nodiscard]] NavIncrement<Scalar> step_increment(const Window& window, std::size_t from) {
  return flattened<Scalar>([&] {
    if constexpr (HasMoments<Scheme, Scalar, Window>) {
      return increment_from(Scheme::template moments<Scalar>(window, from));
    } else {
      return Scheme::template increment<Scalar>(window, from);
    }
  });
}

}  // namespace detail

}  // namespace splinertia
