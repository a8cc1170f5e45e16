// SPDX-License-Identifier: MIT
/// Poses, times and curves of bytes.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <splinertia/group/sophus.hpp>
#include <splinertia/time.hpp>

#include "fuzz/fuzz.hpp"

namespace splinertia::fuzz {

/// Numbers of bytes that remember whether all so far are of usual size, so that what is made of them is finite.
struct Numbers {
  Input& input;
  bool wild = input.flag();  ///< whether others may come
  bool usual = true;

  [[nodiscard]] double operator()() {
    if (!wild) return input.moderate(100);
    const double x = input.real();
    const double size = std::abs(x);
    usual = usual && (x == 0 || (size > 1e-6 && size < 1e6));
    return x;
  }
  [[nodiscard]] Eigen::Vector3d vector() {
    const double x = (*this)(), y = (*this)();
    return {x, y, (*this)()};
  }
  /// Some of them are off SO(3).
  [[nodiscard]] Sophus::SO3d rotation() {
    Eigen::Vector4d q;
    for (double& x : q) x = input.moderate(1);
    if (!(q.norm() > 0)) q = Eigen::Vector4d::UnitW();
    q.normalize();
    if (wild && input.integer(0, 7) == 0) q *= 1 + 1e-3 * (*this)();
    return rotation_from_unit_quaternion<double>(Eigen::Quaterniond{q});
  }
  /// Seconds or nanoseconds.
  template <TimePoint Time>
  [[nodiscard]] Time time() {
    if constexpr (std::floating_point<Time>) {
      return static_cast<Time>((*this)());
    } else {
      if (!wild || input.flag()) return Time(input.bits<std::int32_t>());
      usual = false;
      return Time(input.bits<std::int64_t>());
    }
  }
};

}  // namespace splinertia::fuzz
