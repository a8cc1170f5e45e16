// SPDX-License-Identifier: MIT
/// What orderK.cpp instantiate: see curves.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/sample_imu.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <utility>

#include "curves.hpp"

namespace study {

inline constexpr std::size_t most_dense_samples = 4096;  // in one call of sample_imu()

/// The curve of these control points in another scalar.
template <typename To, typename From>
[[nodiscard]] To in_other_scalar(const From& curve) {
  using H = typename To::Group;
  std::vector<H> points;
  for (const auto& x : curve.control_points())
    points.push_back(splinertia::detail::with_scalar<splinertia::ScalarOf<H>>(x));
  return To(curve.knots(), std::move(points));
}

template <typename Curve>
[[nodiscard]] CurveErrors errors_of(const Curve& curve, std::span<const Truth> truth) {
  using namespace splinertia;
  CurveErrors errors;
  for (const auto& [time, motion] : truth) {
    const auto is = curve.template evaluate<2>(time);
    const auto read = ideal_imu(is);
    const auto should = ideal_imu(motion);
    const auto turned = rotation(is.value).unit_quaternion().template cast<double>();
    const Sophus::SO3d R_WB = rotation_from_unit_quaternion(turned.normalized());
    errors.orientation.add(increment(rotation(motion.value), R_WB).norm());
    errors.position.add((position(is.value).template cast<double>() - position(motion.value)).norm());
    errors.gyro.add((read.gyro.template cast<double>() - should.gyro).norm());
    errors.accel.add((read.accel.template cast<double>() - should.accel).norm());
  }
  return errors;
}

template <typename Curve>
[[nodiscard]] Subject subject_of(const char* group, const char* scalar, const Curve& curve,
                                 std::span<const Truth> truth) {
  using G = typename Curve::Group;
  Subject subject{.group = group,
                  .order = Curve::order,
                  .scalar = scalar,
                  .control_points = curve.control_points().size(),
                  .bytes = sizeof(G) + sizeof(splinertia::Tangent<G>),
                  .errors = errors_of(curve, truth),
                  .single = {},
                  .dense = {}};
  constexpr std::size_t some = 1024;
  std::vector<double> times(some);
  std::mt19937_64 bits(1);
  for (double& time : times) {
    const auto share = static_cast<double>(bits() >> 11) * 0x1p-53;
    time = truth.front().time + share * (truth.back().time - truth.front().time);
  }
  subject.single = [curve, times](std::size_t calls) {
    for (std::size_t i = 0; i < calls; ++i) {
      keep(splinertia::ideal_imu(curve.template evaluate<2>(times[i % some])));
    }
  };
  const double length = truth.back().time - truth.front().time;
  const auto at_once = std::min(most_dense_samples, static_cast<std::size_t>(length / dense_interval));
  subject.dense = [curve, start = truth.front().time, at_once](std::size_t calls) {
    splinertia::ImuSamples<G> samples;
    const auto gravity = splinertia::standard_gravity<splinertia::ScalarOf<G>>();
    for (std::size_t done = 0; done < calls; done += at_once) {
      const std::size_t count = std::min(at_once, calls - done);
      splinertia::sample_imu(curve, splinertia::SampleTimes{start, dense_interval}, 0, count, samples, gravity);
      keep(samples);
    }
  };
  return subject;
}

/// On one group.
template <template <typename> typename Group, int Order>
[[nodiscard]] std::vector<Subject> subjects_on(const char* group, const Poses& poses, double knot_interval,
                                               std::span<const Truth> truth) {
  using splinertia::Spline;
  using Curve = Spline<Group<double>, Order>;
  const Curve curve = splinertia::fit<Curve>(poses, {.knot_interval = knot_interval}).spline;
  const auto in_float = in_other_scalar<Spline<Group<float>, Order>>(curve);
  const auto in_long_double = in_other_scalar<Spline<Group<long double>, Order>>(curve);
  return {subject_of(group, "float", in_float, truth), subject_of(group, "double", curve, truth),
          subject_of(group, "long double", in_long_double, truth)};
}

template <typename Scalar>
using RigidMotion = Sophus::SE3<Scalar>;

template <int Order>
std::vector<Subject> subjects(const Poses& poses, double knot_interval, std::span<const Truth> truth) {
  auto all = subjects_on<splinertia::SO3xR3, Order>("SO3xR3", poses, knot_interval, truth);
  auto rigid = subjects_on<RigidMotion, Order>("SE3", poses, knot_interval, truth);
  std::move(rigid.begin(), rigid.end(), std::back_inserter(all));
  return all;
}

}  // namespace study
