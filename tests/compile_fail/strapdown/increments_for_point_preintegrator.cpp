// expect: this scheme takes point samples: structs with time, gyro
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/midpoint.hpp>
#include <splinertia/strapdown/preintegrator.hpp>

using namespace splinertia;

void f(Preintegrator<Midpoint, double>& preintegrator, const TimedImuIncrement<double, double>& increment) {
  preintegrator.push(increment);
}
