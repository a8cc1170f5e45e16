// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A constant latency: every stamp is `offset` s later than the time of its sample (earlier if negative). It is the
/// time offset t_d of Kalibr and of estimators.
template <typename Scalar = double>
struct ClockOffset {
  static constexpr std::string_view name = "clock offset";
  struct State {};

  Scalar offset;

  /// Throws std::invalid_argument unless the offset is finite.
  constexpr ClockOffset(const Scalar& offset_) : offset(offset_) {
    detail::require_finite("ClockOffset", "offset", offset);
  }

  void apply(Stamp<Scalar>& stamp, State&) const { stamp.offset += offset; }

  void describe(auto&& parameter) const { parameter("offset", offset, "s"); }
};

template <typename P>
ClockOffset(const P&) -> ClockOffset<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
