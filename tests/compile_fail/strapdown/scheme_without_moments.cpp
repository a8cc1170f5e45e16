// expect: IntegrationScheme
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

using namespace splinertia;

struct Nothing : PointScheme<2> {};
void f(const std::vector<ImuSample<>>& samples) { (void)integrate<Nothing>(NavState<double>{}, samples); }
