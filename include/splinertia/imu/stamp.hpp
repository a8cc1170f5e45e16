// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/cpp20.hpp>

namespace splinertia {

/// The time stamp of a sample on its way through the error terms of a clock, as Sample is for a sensor: what the host
/// makes of the time at which the sample was taken.
template <typename Scalar>
struct Stamp {
  Scalar offset;    ///< of the stamp from the true time so far, s
  bool dropped;     ///< whether the sample has been lost
  Scalar interval;  ///< true time since the previous sample, s; the sampling interval for the first
  bool first;       ///< whether it is the first of its run
  Scalar elapsed;   ///< true time since the first sample, s
};

}  // namespace splinertia
