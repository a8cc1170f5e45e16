// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <splinertia/camera/detail/camera_state.hpp>
#include <splinertia/camera/detail/shutter_times.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia::detail {

/// Throws std::out_of_range unless the curve is defined at t.
template <typename Curve>
void require_defined(const Curve& curve, typename Curve::Time t) {
  if (is_finite(t) && curve.start() <= t && t <= curve.end()) return;
  refuse<std::out_of_range>("observe: a row is read at time ", seconds_or_ticks(t), ", but the curve is defined from ",
                            seconds_or_ticks(curve.start()), " to ", seconds_or_ticks(curve.end()));
}

/// The state of a camera at a time, and the rest of that time (RoundedTime).
template <typename Scalar>
struct RowState {
  Scalar row;
  Scalar rest;
  CameraState<Scalar, 1> camera;
};

/// The states of a camera at equally spaced rows of one frame. They are so dense that between two of them the camera
/// turns by at most 0.2 rad, at a rate that changes evenly.
template <typename Curve, typename Camera>
class FramePoses {
 public:
  using Scalar = typename Camera::Scalar;
  using Time = typename Curve::Time;
  static constexpr std::size_t most_intervals = 32;

  FramePoses(const Curve& curve, const Camera& camera, Time frame_time)
      : curve_(&curve), camera_(&camera), frame_time_(frame_time), times_(camera.shutter(), camera.size().height) {
    const auto height = static_cast<Scalar>(camera.size().height);
    for (const Scalar& row : {Scalar(0), height}) require_defined(curve, time(row).time);
    states_[0] = at(Scalar(0));
    states_[1] = at(height);
    while (intervals_ < most_intervals && !dense()) halve_intervals();
  }

  [[nodiscard]] std::size_t intervals() const { return intervals_; }
  [[nodiscard]] const RowState<Scalar>& operator[](std::size_t i) const { return states_[i]; }
  [[nodiscard]] const Camera& camera() const { return *camera_; }
  [[nodiscard]] const ShutterTimes<Scalar>& times() const { return times_; }
  [[nodiscard]] RoundedTime<Scalar, Time> time(const Scalar& row) const {
    return rounded_after<Scalar>(frame_time_, times_.offset(row));
  }
  /// The state when a row is read.
  [[nodiscard]] RowState<Scalar> at(const Scalar& row) const {
    const auto t = time(row);
    return {row, t.rest, camera_state<1>(curve_->template evaluate<1>(t.time), camera_->T_BC())};
  }

 private:
  [[nodiscard]] bool dense() const {
    const Scalar half = (states_[1].row - states_[0].row) * times_.line_delay / Scalar(2);
    const Scalar most_turn = Scalar(1) / Scalar(5), most_excess = most_turn / Scalar(10);
    for (std::size_t i = 0; i < intervals_; ++i) {
      const auto &a = states_[i].camera, &b = states_[i + 1].camera;
      const Eigen::Vector3<Scalar> mean_turn = (a.omega + b.omega) * half;
      const Scalar square = (std::max)(a.omega.squaredNorm(), b.omega.squaredNorm()) * (half * half * Scalar(4));
      if (!(square <= most_turn * most_turn)) return false;
      const auto difference = quaternion_product<Scalar>(a.q_WC.conjugate(), b.q_WC);
      const Scalar twice = difference.w() < Scalar(0) ? Scalar(-2) : Scalar(2);
      if (!((twice * difference.vec() - mean_turn).squaredNorm() <= most_excess * most_excess)) return false;
    }
    return true;
  }

  void halve_intervals() {
    for (std::size_t i = intervals_; i > 0; --i) states_[2 * i] = states_[i];
    for (std::size_t i = 0; i < intervals_; ++i) {
      states_[2 * i + 1] = at((states_[2 * i].row + states_[2 * i + 2].row) / Scalar(2));
    }
    intervals_ *= 2;
  }

  const Curve* curve_;
  const Camera* camera_;
  Time frame_time_;
  ShutterTimes<Scalar> times_;
  std::size_t intervals_ = 1;
  std::array<RowState<Scalar>, most_intervals + 1> states_;
};

}  // namespace splinertia::detail
