// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A sensor clock that runs fast: it gains `rate` seconds per second of true time (2e-5 is 20 ppm). It is right at the
/// first sample.
template <typename Scalar = double>
struct ClockDrift {
  static constexpr std::string_view name = "clock drift";
  struct State {};

  Scalar rate;

  /// Throws std::invalid_argument unless the rate is finite and > −1. At −1 the clock would stand still; below −1, run
  /// backwards.
  constexpr ClockDrift(const Scalar& rate_) : rate(rate_) {
    detail::require(detail::is_finite(rate) && rate > Scalar(-1), "ClockDrift", "rate", rate, "a finite number > -1");
  }

  void apply(Stamp<Scalar>& stamp, State&) const { stamp.offset += rate * stamp.elapsed; }

  void describe(auto&& parameter) const { parameter("rate", rate, "s/s"); }
};

template <typename P>
ClockDrift(const P&) -> ClockDrift<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
