// expect: this scheme takes point samples: structs with time, gyro
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/coning_sculling.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/midpoint.hpp>
#include <splinertia/strapdown/preintegrator.hpp>
#include <vector>

using namespace splinertia;

void f(const std::vector<TimedImuIncrement<double, double>>& increments) {
  (void)integrate<Midpoint>(NavState<double>{}, increments);
}
