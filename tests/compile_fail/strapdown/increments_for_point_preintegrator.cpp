// expect: this scheme takes point samples: structs with time, gyro
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

using namespace splinertia;

void f(Preintegrator<Midpoint, double>& preintegrator, const ImuIncrement<>& increment) {
  preintegrator.push(increment);
}
