// expect: IntegrationScheme
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/coning_sculling.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/midpoint.hpp>
#include <splinertia/strapdown/preintegrator.hpp>
#include <vector>

using namespace splinertia;

struct Nothing {};
Preintegrator<Nothing, double> f();
