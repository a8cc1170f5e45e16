// SPDX-License-Identifier: MIT
/// Derivatives of an observed pixel. The row is part of the pixel and decides when it is read, so a change of anything
/// also moves the time. With π(t, θ) the pixel at time t, π̇ its rate and t(v, θ) the time of row v, the implicit function
/// theorem for v = π_v(t(v, θ), θ) gives
///
///   dv/dθ = (∂π_v/∂θ + π̇_v ∂t/∂θ) / (1 − π̇_v ∂t/∂v),   d pixel/dθ = ∂π/∂θ + π̇ (∂t/∂θ + ∂t/∂v dv/dθ)
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <splinertia/camera/detail/observation_jacobians.hpp>
#include <splinertia/camera/observation.hpp>
#include <splinertia/camera/observe.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/spline/linearize.hpp>

namespace splinertia {

/// A pixel with the Jacobians that were requested; others do not exist. Those with respect to the control points have the
/// index `first` of the first of them beside them.
///   pose_jacobian            2 × 6, tangent order of the group
///   control_point_jacobian   Order times 2 × 6
///   landmark_jacobian        2 × 3
///   T_BC_jacobian            2 × 6, [translation; rotation]
///   clock_offset_jacobian, line_delay_jacobian   2 × 1, pixels per s
///   parameter_jacobian       2 × P, in the order of Model::parameters()
/// `rate` is that of the point in the image at the time of the row, pixels per s.
template <typename Scalar, int Parameters, Wrt wrt, int Order = 0>
struct ObservationLinearization : detail::PoseJacobian<Scalar, includes(wrt, Wrt::pose)>,
                                  detail::ControlPointJacobian<Scalar, Order, includes(wrt, Wrt::control_points)>,
                                  detail::LandmarkJacobian<Scalar, includes(wrt, Wrt::landmark)>,
                                  detail::ExtrinsicsJacobian<Scalar, includes(wrt, Wrt::T_BC)>,
                                  detail::ClockOffsetJacobian<Scalar, includes(wrt, Wrt::clock_offset)>,
                                  detail::LineDelayJacobian<Scalar, includes(wrt, Wrt::line_delay)>,
                                  detail::ParameterJacobian<Scalar, Parameters, includes(wrt, Wrt::parameters)> {
  Eigen::Vector2<Scalar> pixel;
  Eigen::Vector2<Scalar> rate;
};

/// The pixel of a landmark and its derivatives from the motion of the body when the row of that pixel is read: for
/// estimators, whose motion comes from control points of their own. Nothing outside the model's domain.
template <Wrt wrt, Pose G, typename Camera>
  requires(!includes(wrt, Wrt::control_points))
[[nodiscard]] auto linearize_observation(const Motion<G, 1>& body, const Camera& camera,
                                         const Eigen::Vector3<ScalarOf<G>>& landmark) {
  using Scalar = ScalarOf<G>;
  using Result = ObservationLinearization<Scalar, Camera::Model::parameter_count, wrt>;
  Result result;
  const bool valid = detail::linearize_pixel<wrt>(body, camera, landmark, result, [](const auto&) {});
  return valid ? std::optional<Result>(result) : std::nullopt;
}

/// The derivatives of an observation that observe() found in the frame of time `frame_time`. Nothing if the landmark is
/// not in the model's domain at the time of the observation. `curve` is a Spline if Wrt::control_points is requested.
template <Wrt wrt, typename Curve, typename Camera>
  requires detail::ObservesAlong<Curve, Camera> && Trajectory<Curve, 1>
[[nodiscard]] auto linearize_observation(const Curve& curve, const Camera& camera,
                                         const Eigen::Vector3<typename Camera::Scalar>& landmark,
                                         typename Curve::Time frame_time,
                                         const Observation<typename Camera::Scalar, typename Curve::Time>& observed) {
  using Scalar = typename Camera::Scalar;
  using G = typename Curve::Group;
  const auto t = detail::rounded_after<Scalar>(frame_time, observed.row_offset);
  const auto at_row = [&](Motion<G, 1> m) {
    if (t.rest != Scalar(0)) {
      m.value = GroupTraits<G>::compose(m.value, GroupTraits<G>::exp(Tangent<G>(m.velocity * t.rest)));
    }
    return m;
  };
  if constexpr (includes(wrt, Wrt::control_points)) {
    const auto at = curve.template linearize<1>(t.time);
    using Result = ObservationLinearization<Scalar, Camera::Model::parameter_count, wrt, Curve::order>;
    Result result;
    result.first = at.first;
    const bool valid =
        detail::linearize_pixel<wrt>(at_row(at), camera, landmark, result, [&](const auto& pose_jacobian) {
          for (std::size_t i = 0; i < at.value_jacobian.size(); ++i) {
            result.control_point_jacobian[i] = pose_jacobian * at.value_jacobian[i];
          }
        });
    return valid ? std::optional<Result>(result) : std::nullopt;
  } else {
    return linearize_observation<wrt>(at_row(curve.template evaluate<1>(t.time)), camera, landmark);
  }
}

}  // namespace splinertia
