// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Clips the reading to the sensor's range [−limit, limit], in the sensor's unit.
template <typename Scalar = double>
struct Saturation {
  static constexpr std::string_view name = "saturation";
  struct State {};

  PerAxis<Scalar> limit;

  /// Throws std::invalid_argument unless the limit is finite and > 0.
  constexpr Saturation(const PerAxis<Scalar>& limit_) : limit(limit_) {
    require_positive("Saturation", "limit", limit);
  }

  [[gnu::always_inline]] void apply(Sample<Scalar>& sample, State&) const {
    const auto clip = [](const Scalar& x, const Scalar& most) {
      const Scalar above = x < -most ? -most : x;
      return most < above ? most : above;
    };
    sample.value = {clip(sample.value.x(), limit[0]), clip(sample.value.y(), limit[1]),
                    clip(sample.value.z(), limit[2])};
  }

  void describe(auto&& parameter) const { parameter("limit", limit, SensorUnit{}); }
};

template <typename P>
Saturation(const P&) -> Saturation<ScalarOfParameter<P>>;

/// Called by ErrorModel if both terms are in it: throws std::invalid_argument for a range of less than one bit, with
/// which the sensor would read zero or nothing.
template <typename Scalar>
constexpr void check_together(const Saturation<Scalar>& saturation, const Quantization<Scalar>& quantization) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require(saturation.limit[axis] >= quantization.least_significant_bit[axis], "Saturation", "limit",
            saturation.limit[axis], "at least the least significant bit of the Quantization term");
  }
}

}  // namespace splinertia
