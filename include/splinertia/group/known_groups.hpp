// SPDX-License-Identifier: MIT
/// The groups that the library knows: Rⁿ and products, and those of Sophus where it is installed. Headers include this
/// one where they serve all groups and treat those of Sophus by name, so that curves on Rⁿ need nothing but Eigen.
#pragma once

#include <splinertia/group/euclidean.hpp>
#include <splinertia/group/product.hpp>

#if __has_include(<sophus/se3.hpp>)
#include <splinertia/group/pose.hpp>
#else

namespace Sophus {
template <class Scalar, int Options = 0>
class SO2;
template <class Scalar, int Options = 0>
class SO3;
template <class Scalar, int Options = 0>
class SE2;
template <class Scalar, int Options = 0>
class SE3;
}  // namespace Sophus

namespace splinertia {

/// Without Sophus nothing is a pose.
template <typename G>
concept Pose = false;

}  // namespace splinertia

#endif
