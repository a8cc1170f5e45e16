// expect: the samples must have the same type of time as the integration
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <splinertia/strapdown/integrator.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

using namespace splinertia;

struct DriverSample {
  std::int64_t time;
  Eigen::Vector3d gyro, accel;
};

void f(Integrator<Midpoint, double>& integrator, const DriverSample& sample) { integrator.push(sample); }
