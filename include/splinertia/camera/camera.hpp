// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/image_region.hpp>
#include <splinertia/camera/image_size.hpp>
#include <splinertia/camera/shutter.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/group/sophus.hpp>

namespace splinertia {

/// A camera on a body: a model, the size of its images, where it is, its shutter, and the region of the image in which
/// it sees. What is left out takes no memory and no instruction.
///
///   Camera front{Pinhole{fx, fy, cx, cy, RadialTangential{k1, k2, p1, p2}}, ImageSize{752, 480}, T_BC,
///                RollingShutter{29.4e-6}};
template <CameraModel M, typename Shutter = GlobalShutter, typename Region = WholeImage>
class Camera {
 public:
  using Model = M;
  using Scalar = typename M::Scalar;
  using Pose = Sophus::SE3<Scalar>;

  /// `T_BC` takes coordinates in the camera frame C to the body's, p_B = T_BC p_C (m); Kalibr's T_cam_imu is its inverse.
  /// Throws std::invalid_argument for a T_BC that is not a finite rigid motion to 0.001, and for a shutter or region that
  /// cannot be one of this image.
  Camera(const Model& model, ImageSize size, const Pose& T_BC = Pose(), const Shutter& shutter = {},
         const Region& region = {})
      : model_(model), size_(size), T_BC_(rigid(T_BC)), shutter_(shutter), region_(region) {
    detail::check_shutter(shutter);
    if constexpr (requires { region.check(size); }) region.check(size);
  }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const ImageSize& size() const { return size_; }
  [[nodiscard]] const Pose& T_BC() const { return T_BC_; }
  [[nodiscard]] const Shutter& shutter() const { return shutter_; }
  [[nodiscard]] const Region& region() const { return region_; }

  /// Whether a pixel is in the image and in the region.
  [[nodiscard]] bool sees(const Eigen::Vector2<Scalar>& pixel) const {
    return size_.contains(pixel) && region_.contains(pixel);
  }

 private:
  [[nodiscard]] static Pose rigid(const Pose& T_BC) {
    using Traits = GroupTraits<Pose>;
    detail::require_all_finite("Camera", "the translation of T_BC", T_BC.translation());
    detail::require_all_finite("Camera", "the rotation of T_BC", T_BC.unit_quaternion().coeffs());
    const Scalar drift = Traits::drift(T_BC), norm = T_BC.unit_quaternion().norm();
    detail::require(drift <= Scalar(1) / Scalar(1000), "Camera", "the norm of T_BC's quaternion", norm, "1");
    using Limits = std::numeric_limits<Scalar>;
    return drift > Scalar(4) * Limits::epsilon() ? Traits::normalized(T_BC) : T_BC;
  }

  Model model_;
  ImageSize size_;
  Pose T_BC_;
  [[no_unique_address]] Shutter shutter_;
  [[no_unique_address]] Region region_;
};

}  // namespace splinertia
