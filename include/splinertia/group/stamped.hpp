// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// A group element with a time stamp: one line of a trajectory. Time is `double` seconds or a std::chrono::duration.
template <LieGroup G, typename Time = std::chrono::nanoseconds>
struct Stamped {
  Time time;
  G value;
};

}  // namespace splinertia
