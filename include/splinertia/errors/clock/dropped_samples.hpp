// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Samples that are lost in transmission, each independently with the given probability. The sensor still takes them:
/// those that arrive are the same as if none had been lost.
template <typename Scalar = double>
struct DroppedSamples {
  static constexpr std::string_view name = "dropped samples";
  template <typename Normals>
  using State = Normals;

  Scalar probability;

  /// Throws std::invalid_argument unless 0 <= probability < 1.
  constexpr DroppedSamples(const Scalar& probability_) : probability(probability_) {
    detail::require(probability >= Scalar(0) && probability < Scalar(1), "DroppedSamples", "probability", probability,
                    "a number >= 0 and < 1");
  }

  void apply(Stamp<Scalar>& stamp, auto& random) const {
    if (static_cast<Scalar>(random.uniform()) < probability) stamp.dropped = true;
  }

  void describe(auto&& parameter) const { parameter("probability", probability, "1"); }
};

template <typename P>
DroppedSamples(const P&) -> DroppedSamples<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
