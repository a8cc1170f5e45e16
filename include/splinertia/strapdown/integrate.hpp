// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <ranges>
#include <splinertia/strapdown/integrator.hpp>
#include <vector>

namespace splinertia {

template <typename Scalar, typename Frame = InertialFrame>
struct IntegrationOptions {
  GapOptions<Scalar> gaps{};
  std::size_t* bridged_gaps = nullptr;  ///< receives the number of bridged gaps
  [[no_unique_address]] Frame frame{};
};

/// Integrates the samples of an IMU and calls visit(state) for `initial` and then after each step; if there are no
/// samples, it makes no call. No states are stored. `gravity` is the acceleration of free fall in the world, m/s².
///
/// Scheme for point samples: Euler, Midpoint, Trapezoid, RungeKutta4, RungeKutta4DoubleStep, Magnus4, ZeroOrderHold.
/// The first sample is at initial.time. Two or three samples are enough for any scheme, at a lower order; one gives the
/// initial state alone. Scheme for increments, the first of which begins at initial.time: one of coning_sculling.hpp.
/// For a scheme of your own see scheme.hpp.
///
/// Throws std::invalid_argument if the first point sample is not at initial.time, if the initial state, gravity, the
/// frame or a reading is not finite, if a reading is beyond largest_factor(), if stamps do not increase, and for a gap
/// that is refused.
template <typename Scheme, typename Scalar, TimePoint Time, std::ranges::input_range Samples, typename Visit,
          typename Frame = InertialFrame>
  requires IntegrationScheme<Scheme, Scalar, Time> && std::invocable<Visit&, const NavState<Scalar, Time>&>
void integrate(const NavState<Scalar, Time>& initial, Samples&& samples,
               const Eigen::Vector3<std::type_identity_t<Scalar>>& gravity, Visit&& visit,
               const IntegrationOptions<std::type_identity_t<Scalar>, Frame>& options = {}) {
  Integrator<Scheme, Scalar, Time, Frame> integrator(initial, gravity, options.gaps, options.frame);
  bool any = false;
  for (const auto& sample : samples) {
    if (!any) visit(initial);
    any = true;
    integrator.push(sample, visit);
  }
  integrator.finish(visit);
  if (options.bridged_gaps) *options.bridged_gaps = integrator.gaps();
}

/// The same into a vector: `initial` and the state after each step; empty if there are no samples.
template <typename Scheme, typename Scalar, TimePoint Time, std::ranges::input_range Samples,
          typename Frame = InertialFrame>
  requires IntegrationScheme<Scheme, Scalar, Time>
[[nodiscard]] std::vector<NavState<Scalar, Time>> integrate(
    const NavState<Scalar, Time>& initial, Samples&& samples,
    const Eigen::Vector3<std::type_identity_t<Scalar>>& gravity = standard_gravity<Scalar>(),
    const IntegrationOptions<std::type_identity_t<Scalar>, Frame>& options = {}) {
  std::vector<NavState<Scalar, Time>> states;
  if constexpr (requires { std::ranges::size(samples); }) states.reserve(std::ranges::size(samples) + 1);
  detail::flattened<Scalar>([&] {
    integrate<Scheme>(
        initial, samples, gravity, [&](const NavState<Scalar, Time>& state) { states.push_back(state); }, options);
  });
  return states;
}

}  // namespace splinertia
