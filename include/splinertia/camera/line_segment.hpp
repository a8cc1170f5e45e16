// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/detail/camera_state.hpp>
#include <splinertia/camera/detail/frame_poses.hpp>
#include <splinertia/camera/detail/segment_clip.hpp>
#include <splinertia/camera/observation.hpp>
#include <splinertia/camera/observe.hpp>

namespace splinertia {

/// A visible part of a line segment from `a` to `b`. In between, its image is a straight line only without distortion.
template <typename Scalar = double>
struct SegmentPart {
  struct End {
    Eigen::Vector2<Scalar> pixel;
    Scalar share;  ///< 0 at a, 1 at b: the point is a + share (b − a)
  };
  End first, last;  ///< first.share <= last.share
};

/// The visible parts of the segment from a to b (world, m) in one frame of a camera with a global shutter, from a to b: a
/// range without heap. The segment is clipped to the image and the region of the camera and to the model's domain; a
/// distorted segment may leave the image and return, so there may be several parts, at most 8. Ends are exact to
/// rounding. Gaps that a region (ImageMask, ImageCircle) makes are only found if they are wider than 0.1 rad.
///
/// A segment that is not finite, or that begins, ends or passes at the camera, has no visible parts. Throws
/// std::out_of_range unless the curve is defined at frame_time.
template <typename Curve, typename Camera>
  requires(detail::ObservesAlong<Curve, Camera> && std::same_as<detail::ShutterOf<Camera>, GlobalShutter>)
[[nodiscard]] auto observe_segment(const Curve& curve, const Camera& camera,
                                   const Eigen::Vector3<typename Camera::Scalar>& a,
                                   const Eigen::Vector3<typename Camera::Scalar>& b, typename Curve::Time frame_time) {
  detail::require_defined(curve, frame_time);
  const auto state = detail::camera_state<0>(curve.template evaluate<0>(frame_time), camera.T_BC());
  using Clip = detail::SegmentClip<Camera, SegmentPart<typename Camera::Scalar>>;
  return Clip(camera, state.in_camera(a), state.in_camera(b)).run();
}

}  // namespace splinertia
