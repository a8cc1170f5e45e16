// expect: this scheme takes increments: structs with time, delta_angle
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/coning_sculling.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/midpoint.hpp>
#include <splinertia/strapdown/preintegrator.hpp>
#include <vector>

using namespace splinertia;

void f(Integrator<TwoSampleIncrements, double>& integrator, const TimedImuSample<double, double>& sample) {
  integrator.push(sample);
}
