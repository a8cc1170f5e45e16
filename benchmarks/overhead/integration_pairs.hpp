// SPDX-License-Identifier: MIT
/// Integration of readings in memory, and the same in a turning world: from the library, and by hand.
#pragma once

#include "plain_integration.hpp"

// Integration of readings in memory, and the same in a world that turns.

[[gnu::noinline]] States integrate_euler(const LibraryFlight& f) {
  return integrate<Euler>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_midpoint(const LibraryFlight& f) {
  return integrate<Midpoint>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_runge_kutta4(const LibraryFlight& f) {
  return integrate<RungeKutta4>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_magnus4(const LibraryFlight& f) {
  return integrate<Magnus4>(f.initial, f.readings, f.gravity);
}
[[gnu::noinline]] States integrate_euler_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<Euler>(f.initial, f.readings, f.gravity, options);
}
[[gnu::noinline]] States integrate_midpoint_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<Midpoint>(f.initial, f.readings, f.gravity, options);
}
[[gnu::noinline]] States integrate_runge_kutta4_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<RungeKutta4>(f.initial, f.readings, f.gravity, options);
}
[[gnu::noinline]] States integrate_magnus4_earth(const LibraryFlight& f) {
  const IntegrationOptions<double, RotatingFrame<double>> options{.frame = {f.world_rate}};
  return integrate<Magnus4>(f.initial, f.readings, f.gravity, options);
}

namespace {

inline auto inertially(const PlainFlight& f) {
  return [gravity = f.gravity](const PlainState& state, const PlainStep& step, double time) {
    return advanced(state, step, gravity, time);
  };
}
inline auto turning(const PlainFlight& f) {
  return [gravity = f.gravity, rate = f.world_rate](const PlainState& state, const PlainStep& step, double time) {
    return advanced_in_turning_world(state, step, gravity, rate, time);
  };
}

}  // namespace

PlainStates integrate_euler_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return euler_step(a, b); }, inertially(f));
}
PlainStates integrate_midpoint_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return midpoint_step(a, b); }, inertially(f));
}
PlainStates integrate_runge_kutta4_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return classical_step(a, b); }, inertially(f));
}
PlainStates integrate_magnus4_by_hand(const PlainFlight& f) { return magnus4_by_hand(f, inertially(f)); }
PlainStates integrate_euler_earth_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return euler_step(a, b); }, turning(f));
}
PlainStates integrate_midpoint_earth_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return midpoint_step(a, b); }, turning(f));
}
PlainStates integrate_runge_kutta4_earth_by_hand(const PlainFlight& f) {
  return by_hand(f, [](const Reading& a, const Reading& b) { return classical_step(a, b); }, turning(f));
}
PlainStates integrate_magnus4_earth_by_hand(const PlainFlight& f) { return magnus4_by_hand(f, turning(f)); }
