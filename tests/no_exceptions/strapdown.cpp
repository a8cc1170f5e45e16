// SPDX-License-Identifier: MIT
// An estimator's loop for a small processor.
#include <splinertia/strapdown/integrator.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

using namespace splinertia;

void push(Integrator<Midpoint, double>& integrator, const ImuSample<>& sample) { integrator.push(sample); }

Integrator<Midpoint, double> begin(const NavState<double>& state) { return Integrator<Midpoint, double>(state); }
