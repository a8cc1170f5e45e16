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
  std::size_t* bridged_gaps = nullptr;  ///< where to write how many gaps have been bridged
  [[no_unique_address]] Frame frame{};
};

/// Integrates the samples of an IMU from `initial` on, in a world with the acceleration of free fall `gravity` (m/s²),
/// and calls visit(state) for each state, the first of them `initial`; not at all for no samples. Scheme is Euler,
/// Midpoint, Trapezoid, RungeKutta4, RungeKutta4DoubleStep, Magnus4, ZeroOrderHold, of point samples, the first of them
/// at the initial time; or one of coning_sculling.hpp, of increments, which begin there; or a type of your own
/// (scheme.hpp). One point sample gives the initial state, two or three are enough for any scheme, at a lower order.
/// Nothing is kept. Throws std::invalid_argument where the first point sample is not at initial.time, where the initial
/// state, gravity or a reading are not finite, where a reading is beyond largest_factor(), where stamps do not
/// increase, and for a gap that is refused.
template <typename Scheme, typename Scalar, TimePoint Time, std::ranges::input_range Samples, typename Visit,
          typename Frame = InertialFrame>
  requires IntegrationScheme<Scheme, Scalar, Time> && std::invocable<Visit&, const NavState<Scalar, Time>&>
void integrate(const NavState<Scalar, Time>& initial, Samples&& samples,
               const Vector3<std::type_identity_t<Scalar>>& gravity, Visit&& visit,
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

/// The same into a vector: one state for each step, the first of them `initial`; none for no samples.
template <typename Scheme, typename Scalar, TimePoint Time, std::ranges::input_range Samples,
          typename Frame = InertialFrame>
  requires IntegrationScheme<Scheme, Scalar, Time>
[[nodiscard]] std::vector<NavState<Scalar, Time>> integrate(
    const NavState<Scalar, Time>& initial, Samples&& samples,
    const Vector3<std::type_identity_t<Scalar>>& gravity = standard_gravity<Scalar>(),
    const IntegrationOptions<std::type_identity_t<Scalar>, Frame>& options = {}) {
  std::vector<NavState<Scalar, Time>> states;
  if constexpr (requires { std::ranges::size(samples); }) states.reserve(std::ranges::size(samples) + 1);
  flattened<Scalar>([&] {
    integrate<Scheme>(
        initial, samples, gravity, [&](const NavState<Scalar, Time>& state) { states.push_back(state); }, options);
  });
  return states;
}

}  // namespace splinertia
