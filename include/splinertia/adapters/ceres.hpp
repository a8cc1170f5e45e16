// SPDX-License-Identifier: MIT
/// Curves in Ceres Solver (2.1 or newer): a manifold for control points in the memory of Sophus objects, and residuals
/// with analytic Jacobians for poses, IMU samples and preintegrated motions. Not part of splinertia.hpp, because it
/// needs Ceres.
///
///   std::vector<Sophus::SE3d> T = …;                    // control points, of UniformKnots knots{start, interval}
///   for (auto& x : T) problem.AddParameterBlock(x.data(), 7, new CeresManifold<Sophus::SE3d>);
///   const auto [i, basis] = knots.basis<double, 4, 1>(t, T.size());
///   problem.AddResidualBlock(new CeresGyroscopeResidual<Sophus::SE3d, 4>(basis, gyro, W), nullptr,
///                            T[i].data(), T[i + 1].data(), T[i + 2].data(), T[i + 3].data(), bias.data());
///
/// For residuals of your own with automatic differentiation, pass the blocks of ceres::Jet that Ceres gives you to
/// evaluate<D, Sophus::SE3<Jet>>(blocks, basis) of spline/parameter_blocks.hpp.
#pragma once

#include <splinertia/adapters/ceres_imu.hpp>
#include <splinertia/adapters/ceres_manifold.hpp>
#include <splinertia/adapters/ceres_pose.hpp>
#include <splinertia/adapters/ceres_preintegration.hpp>
