// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/detail/select.hpp>
#include <type_traits>

namespace splinertia::detail {

/// The image of a point of Inputs coordinates in the plane, with what was requested of its derivatives with respect to
/// these (2 × Inputs) and to Count parameters (2 × Count). T is a scalar, or a SIMD pack of it.
template <typename T, int Inputs, int Count, Wrt wrt>
struct ImagePoint {
  T x, y;
  Mask<T> valid;  ///< the point is in the domain
  [[no_unique_address]] std::conditional_t<includes(wrt, Wrt::point), Eigen::Matrix<T, 2, Inputs>,
                                           Eigen::Matrix<T, 0, 0>> by_point;
  [[no_unique_address]] std::conditional_t<includes(wrt, Wrt::parameters) && (Count > 0), Eigen::Matrix<T, 2, Count>,
                                           Eigen::Matrix<T, 0, 1>> by_parameters;
};

}  // namespace splinertia::detail
