// SPDX-License-Identifier: MIT
/// Kernels whose instructions are counted: a sample of an IMU along a curve of any group, order and scalar.
#pragma once

#include <array>
#include <random>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/sample_imu.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
#include <vector>

#include "../../support/harness.hpp"

namespace study {

/// 100 control points 0.1 s apart, up to 0.5 rad and about a metre from one to the next.
template <typename Curve>
Curve random_curve() {
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> turn(-0.25, 0.25), place(-1, 1);
  Sophus::SO3d R;
  std::vector<G> points;
  for (int i = 0; i < 100; ++i) {
    R = R * Sophus::SO3d::exp({turn(bits), turn(bits), turn(bits)});
    const Eigen::Vector3d p(place(bits), place(bits), place(bits));
    points.push_back(splinertia::make_pose<G>(R.template cast<Scalar>(), p.cast<Scalar>()));
  }
  return Curve({.start = 0, .interval = 0.1}, std::move(points));
}

/// One at a time, at times in no order.
template <typename Curve>
void single(std::size_t calls) {
  static const Curve curve = random_curve<Curve>();
  static const std::vector<double> times = [] {
    std::mt19937_64 bits(2);
    std::uniform_real_distribution<double> time(curve.start(), curve.end());
    std::vector<double> all(1024);
    for (double& t : all) t = time(bits);
    return all;
  }();
  for (std::size_t i = 0; i < calls; ++i) {
    benchmark::keep(splinertia::ideal_imu(curve.template evaluate<2>(times[i % 1024])));
  }
}

/// A thousand at once, at 1 kHz: `calls` is a multiple of 1000, as it is when instructions are counted.
template <typename Curve>
void dense(std::size_t calls) {
  static const Curve curve = random_curve<Curve>();
  static splinertia::ImuSamples<typename Curve::Group> samples;
  const auto gravity = splinertia::standard_gravity<typename Curve::Scalar>();
  for (std::size_t done = 0; done < calls; done += 1000) {
    splinertia::sample_imu(curve, splinertia::SampleTimes{curve.start(), 1e-3}, 0, 1000, samples, gravity);
    benchmark::keep(samples);
  }
}

template <typename G, int Order>
void add_kernels(std::vector<benchmark::Kernel>& kernels, const std::string& name) {
  using Curve = splinertia::Spline<G, Order>;
  const std::string full = name + '_' + std::to_string(Order);
  kernels.push_back({full + "_single", single<Curve>});
  kernels.push_back({full + "_dense", dense<Curve>});
}

template <typename G>
void add_orders(std::vector<benchmark::Kernel>& kernels, const std::string& name) {
  add_kernels<G, 3>(kernels, name);
  add_kernels<G, 4>(kernels, name);
  add_kernels<G, 5>(kernels, name);
  add_kernels<G, 6>(kernels, name);
  add_kernels<G, 7>(kernels, name);
  add_kernels<G, 8>(kernels, name);
}

}  // namespace study
