// SPDX-License-Identifier: MIT
/// The groups that the library knows: Rⁿ, products and, if Sophus is installed, its groups. Headers that serve all
/// groups and also name Sophus' types include this one, so that curves on Rⁿ need only Eigen.
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

/// Without Sophus no type is a pose.
template <typename G>
concept Pose = false;

}  // namespace splinertia

#endif
