// SPDX-License-Identifier: MIT
/// What a camera on a moving body sees of landmarks at rest in the world.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/detail/camera_state.hpp>
#include <splinertia/camera/detail/frame_poses.hpp>
#include <splinertia/camera/detail/row_search.hpp>
#include <splinertia/camera/observation.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

template <typename T>
inline constexpr bool is_camera = false;
template <typename M, typename Shutter, typename Region>
inline constexpr bool is_camera<Camera<M, Shutter, Region>> = true;

template <typename Camera>
using ShutterOf = std::remove_cvref_t<decltype(std::declval<const Camera&>().shutter())>;

/// The curve gives what observing with the camera needs: poses over the same scalar and, for a rolling shutter, their
/// velocities.
template <typename Curve, typename Camera>
concept ObservesAlong = is_camera<Camera> && Trajectory < Curve,
        is_rolling<ShutterOf<Camera>> ? 1
                                      : 0 > &&Pose<typename Curve::Group>&&
                                                std::same_as<ScalarOf<typename Curve::Group>, typename Camera::Scalar>;

/// One frame of a camera with a global shutter.
template <typename Curve, typename Camera>
class GlobalFrame {
 public:
  using Scalar = typename Camera::Scalar;
  using Time = typename Curve::Time;
  using Result = Observations<Observation<Scalar, Time>, 1>;

  GlobalFrame(const Curve& curve, const Camera& camera, Time frame_time) : camera_(&camera), time_(frame_time) {
    require_defined(curve, frame_time);
    state_ = camera_state<0>(curve.template evaluate<0>(frame_time), camera.T_BC());
  }
  [[nodiscard]] Result observe(const Eigen::Vector3<Scalar>& landmark) const {
    Result found;
    const auto pixel = camera_->model().project(state_.in_camera(landmark));
    if (pixel && camera_->sees(*pixel)) found.push_back({*pixel, time_, Scalar(0)});
    return found;
  }

 private:
  const Camera* camera_;
  Time time_;
  CameraState<Scalar, 0> state_;
};

/// One frame of a camera with a rolling shutter.
template <typename Curve, typename Camera>
class RollingFrame {
 public:
  using Scalar = typename Camera::Scalar;
  using Result = typename RowSearch<Curve, Camera>::Result;

  RollingFrame(const Curve& curve, const Camera& camera, typename Curve::Time frame_time)
      : poses_(curve, camera, frame_time) {}
  [[nodiscard]] Result observe(const Eigen::Vector3<Scalar>& landmark) const {
    return RowSearch<Curve, Camera>(poses_, landmark).run();
  }

 private:
  FramePoses<Curve, Camera> poses_;
};

template <typename Curve, typename Camera>
using FrameOf =
    std::conditional_t<is_rolling<ShutterOf<Camera>>, RollingFrame<Curve, Camera>, GlobalFrame<Curve, Camera>>;

}  // namespace detail

/// One frame of a camera: observes any number of landmarks with the poses of the body computed once.
///
///   const FrameObserver frame(curve, camera, frame_time);
///   for (const auto& landmark : landmarks) {
///     for (const auto& o : frame(landmark)) …   // o.pixel, o.time, o.row_offset
///   }
///
/// `curve` and `camera` must outlive it.
template <typename Curve, typename Camera>
  requires detail::ObservesAlong<Curve, Camera>
class FrameObserver {
 public:
  using Scalar = typename Camera::Scalar;

  /// Throws std::out_of_range unless the curve is defined while all rows of the frame are read.
  FrameObserver(const Curve& curve, const Camera& camera, typename Curve::Time frame_time)
      : frame_(curve, camera, frame_time) {}
  FrameObserver(const Curve&&, const Camera&, typename Curve::Time) = delete;
  FrameObserver(const Curve&, const Camera&&, typename Curve::Time) = delete;
  FrameObserver(const Curve&&, const Camera&&, typename Curve::Time) = delete;

  /// The observations of a landmark (world, m), as observe() gives them.
  [[nodiscard]] auto operator()(const Eigen::Vector3<Scalar>& landmark) const { return frame_.observe(landmark); }

 private:
  detail::FrameOf<Curve, Camera> frame_;
};

/// The observations (0, 1, 2 …) of a landmark in one frame. `landmark` is in the world, m; `frame_time` is the stamp of
/// the frame as the shutter's type says.
///
/// With a rolling shutter the camera moves while the rows are read. A landmark is observed at every row v in [0, height)
/// for which v is the row of its projection at the time when v is read, the pixel is in the image, and the point is in
/// the model's domain. All such rows are found to rounding (at most 8). The frame is sampled so densely that the camera
/// turns by at most 0.2 rad from one sample to the next, and where the direction to the landmark turns by more than 0.3 rad,
/// up to 4096 times as densely. Two rows can be hidden by a motion that oscillates faster than that, and by a landmark
/// that passes closer than that resolves. Between the ticks of an integer Time a pose follows from the nearest tick and its velocity, which for
/// nanoseconds is exact to rounding.
///
/// Throws std::out_of_range unless the curve is defined while all rows are read. A landmark that is not finite gives no
/// observation. For many landmarks of one frame use FrameObserver.
template <typename Curve, typename Camera>
  requires detail::ObservesAlong<Curve, Camera>
[[nodiscard]] auto observe(const Curve& curve, const Camera& camera,
                           const Eigen::Vector3<typename Camera::Scalar>& landmark, typename Curve::Time frame_time) {
  return FrameObserver<Curve, Camera>(curve, camera, frame_time)(landmark);
}

}  // namespace splinertia
