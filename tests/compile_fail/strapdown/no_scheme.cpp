// expect: IntegrationScheme
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

using namespace splinertia;

struct Nothing {};
Preintegrator<Nothing, double> f();
