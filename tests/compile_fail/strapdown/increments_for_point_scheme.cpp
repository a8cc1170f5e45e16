// expect: this scheme takes point samples: structs with time, gyro
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

using namespace splinertia;

void f(const std::vector<ImuIncrement<>>& increments) { (void)integrate<Midpoint>(NavState<double>{}, increments); }
