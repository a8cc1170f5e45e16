// SPDX-License-Identifier: MIT
/// All of splinertia. Each header also stands alone.
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/imu/error_model.hpp>
#include <splinertia/imu/random_walk.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/imu/white_noise.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/motion/coning.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/parameter_blocks.hpp>
#include <splinertia/spline/spline.hpp>
#include <splinertia/strapdown/euler.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/midpoint.hpp>
