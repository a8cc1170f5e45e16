// SPDX-License-Identifier: MIT
/// The files of a EuRoC sequence. euroc_imu.hpp alone does not need Sophus.
#pragma once

#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/euroc_imu.hpp>
