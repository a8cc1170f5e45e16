// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

namespace splinertia::allan {

/// A confidence interval of an estimate, in the unit of the estimate.
template <typename Scalar>
struct Interval {
  Scalar lower{};
  Scalar upper{};
};

}  // namespace splinertia::allan
