// expect: preintegrate\(\) takes the schemes ZeroOrderHold, Euler, Midpoint, Trapezoid and Magnus4
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/preintegration/preintegrate.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <vector>

using namespace splinertia;

auto f(const std::vector<ImuSample<>>& samples) { return preintegrate<RungeKutta4>(samples).delta(); }
