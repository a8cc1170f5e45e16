// expect: the samples must have the same type of time as the integration
// SPDX-License-Identifier: MIT
#include <chrono>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

using namespace splinertia;

struct DriverSample {
  std::chrono::nanoseconds time;
  Eigen::Vector3d gyro, accel;
};

void f(Preintegrator<Midpoint, double>& preintegrator, const DriverSample& sample) { preintegrator.push(sample); }
