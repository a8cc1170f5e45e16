// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/imu/error_term.hpp>
#include <splinertia/imu/per_axis.hpp>
#include <splinertia/imu/stamp.hpp>
#include <string_view>

namespace splinertia {

/// Jitter of the stamps: each is off by a normal number of its own with the given standard deviation in s. The samples
/// themselves are taken on time. Where it would put a stamp before the last one, simulate() keeps the order.
template <typename Scalar = double>
struct StampJitter {
  static constexpr std::string_view name = "stamp jitter";
  template <typename Normals>
  using State = Normals;

  Scalar standard_deviation;

  /// Throws std::invalid_argument unless the deviation is finite and >= 0.
  constexpr StampJitter(const Scalar& standard_deviation_) : standard_deviation(standard_deviation_) {
    require_non_negative("StampJitter", "standard deviation", standard_deviation);
  }

  void apply(Stamp<Scalar>& stamp, auto& normals) const {
    stamp.offset += standard_deviation * static_cast<Scalar>(normals.draw_one());
  }

  void describe(auto&& parameter) const { parameter("standard deviation", standard_deviation, "s"); }
};

template <typename P>
StampJitter(const P&) -> StampJitter<ScalarOfParameter<P>>;

}  // namespace splinertia
