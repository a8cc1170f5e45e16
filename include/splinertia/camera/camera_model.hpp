// SPDX-License-Identifier: MIT
/// What a camera model is: it takes points in the camera frame C (x right, y down, z forward) to pixels, and pixels
/// back to rays. Pixels are continuous; where the centre of the first one lies is said by the parameters cx and cy.
/// In this library (0, 0) is the centre of the upper left pixel.
///
/// A model knows its domain: the points that it takes one-to-one to pixels. Outside it gives nothing. Every model
/// depends on the direction of a point only, so points may be of any size, and need no unit.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>
#include <optional>
#include <splinertia/detail/cpp20.hpp>
#include <string_view>

namespace splinertia {

/// What a pixel is differentiated with respect to. Values are combined by |. Models know `point`, in the camera frame, and
/// `parameters`; linearize_observation() knows `parameters` and all others.
enum class Wrt : unsigned {
  nothing = 0,
  point = 1,
  parameters = 2,
  pose = 4,            ///< of the body, at the time of the row; right perturbation
  control_points = 8,  ///< of a spline; right perturbations
  landmark = 16,       ///< in the world
  T_BC = 32,           ///< right perturbation, [translation; rotation]
  clock_offset = 64,   ///< of the camera: shifts the time of the frame with the motion fixed, per s
  line_delay = 128     ///< per s
};

[[nodiscard]] constexpr Wrt operator|(Wrt a, Wrt b) {
  return static_cast<Wrt>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// Whether `all` contains `one`.
[[nodiscard]] constexpr bool includes(Wrt all, Wrt one) {
  return (static_cast<unsigned>(all) & static_cast<unsigned>(one)) != 0;
}

namespace detail {

template <typename Scalar, bool exists>
struct PointJacobian {};
template <typename Scalar>
struct PointJacobian<Scalar, true> {
  Eigen::Matrix<Scalar, 2, 3> point_jacobian;
};

template <typename Scalar, int Parameters, bool exists>
struct ParameterJacobian {};
template <typename Scalar, int Parameters>
struct ParameterJacobian<Scalar, Parameters, true> {
  Eigen::Matrix<Scalar, 2, Parameters> parameter_jacobian;
};

}  // namespace detail

/// A pixel and its Jacobians with respect to the point (`point_jacobian`, pixels per unit of the point) and the
/// parameters (`parameter_jacobian`, in the order of M::parameters()). Those that were not requested do not exist.
template <typename Scalar, int Parameters, Wrt wrt>
struct Projection : detail::PointJacobian<Scalar, includes(wrt, Wrt::point)>,
                    detail::ParameterJacobian<Scalar, Parameters, includes(wrt, Wrt::parameters)> {
  static_assert(
      (wrt | Wrt::point | Wrt::parameters) == (Wrt::point | Wrt::parameters),
      "a camera model differentiates by Wrt::point and Wrt::parameters; linearize_observation() does by the rest");
  Projection() {}  // = default would fill all matrices with zeros first
  Eigen::Vector2<Scalar> pixel;
};

/// The ray of a pixel, of length 1, and its Jacobian (3 × 2, per pixel).
template <typename Scalar>
struct Ray {
  Eigen::Vector3<Scalar> direction;
  Eigen::Matrix<Scalar, 3, 2> pixel_jacobian;
};

/// A camera model M. `M::name` is Kalibr's, "model-distortion", where it has one: pinhole-none, pinhole-radtan,
/// pinhole-radtan8, pinhole-equi, omni-none, omni-radtan, ds-none, eucm-none, fov, equirectangular.
/// `parameters()` are in the order of docs/cameras.md; `M::from_parameters` is its inverse.
/// project(), linearize() and unproject() return nothing for what is outside the domain, and for NaN and infinity.
template <typename M>
concept CameraModel = requires(const M& model, const Eigen::Vector3<typename M::Scalar>& point,
                               const Eigen::Vector2<typename M::Scalar>& pixel) {
  typename M::Scalar;
  { M::name } -> std::convertible_to<std::string_view>;
  { M::parameter_count } -> std::convertible_to<int>;
  { model.parameters() } -> std::convertible_to<Eigen::Matrix<typename M::Scalar, M::parameter_count, 1>>;
  { M::from_parameters(model.parameters()) } -> std::same_as<M>;
  { model.project(point) } -> std::same_as<std::optional<Eigen::Vector2<typename M::Scalar>>>;
  { model.unproject(pixel) } -> std::same_as<std::optional<Eigen::Vector3<typename M::Scalar>>>;
  {
    model.template linearize<Wrt::point>(point)
  } -> std::same_as<std::optional<Projection<typename M::Scalar, M::parameter_count, Wrt::point>>>;
  { model.linearize_ray(pixel) } -> std::same_as<std::optional<Ray<typename M::Scalar>>>;
};

}  // namespace splinertia
