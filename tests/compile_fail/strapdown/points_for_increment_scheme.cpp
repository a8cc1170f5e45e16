// expect: this scheme takes increments: structs with time, delta_angle
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

using namespace splinertia;

void f(Integrator<TwoSampleIncrements, double>& integrator, const ImuSample<>& sample) { integrator.push(sample); }
