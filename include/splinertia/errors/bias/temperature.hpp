// SPDX-License-Identifier: MIT
/// The temperature of a sensor: any callable that takes the time since the first sample in s and returns °C.
#pragma once

#include <concepts>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>

namespace splinertia {

template <typename F, typename Scalar>
concept TemperatureProfile = requires(const F& profile, const Scalar& elapsed) {
  { profile(elapsed) } -> std::convertible_to<Scalar>;
};

/// The temperature of a sensor that warms up (or cools down) by itself, °C, with t in s:
/// T(t) = final + (initial − final)·exp(−t/time_constant).
template <typename Scalar = double>
struct WarmUp {
  Scalar initial, final, time_constant;

  /// Throws std::invalid_argument unless the temperatures and their third powers are finite, and the time constant is
  /// finite and > 0.
  constexpr WarmUp(const Scalar& initial_, const Scalar& final_, const Scalar& time_constant_)
      : initial(initial_), final(final_), time_constant(time_constant_) {
    detail::require_factor("WarmUp", "initial temperature", initial);
    detail::require_factor("WarmUp", "final temperature", final);
    detail::require_positive("WarmUp", "time constant", time_constant);
  }

  [[nodiscard]] Scalar operator()(const Scalar& elapsed) const {
    return initial + (final - initial) * detail::one_minus_exp_minus<Scalar>(elapsed / time_constant);
  }

  void describe(auto&& parameter) const {
    parameter("initial temperature", initial, "degC");
    parameter("final temperature", final, "degC");
    parameter("time constant", time_constant, "s");
  }
};

template <typename P>
WarmUp(const P&, const P&, const P&) -> WarmUp<detail::ScalarOfParameter<P>>;
template <typename P, typename Q, typename R>
WarmUp(const P&, const Q&, const R&) -> WarmUp<detail::ScalarOfParameter<P>>;

namespace detail {

/// Calls describe() of a temperature profile, if it has one.
template <typename Profile>
void describe_profile(const Profile& profile, auto&& parameter) {
  if constexpr (requires { profile.describe(parameter); }) profile.describe(parameter);
}

}  // namespace detail

}  // namespace splinertia
