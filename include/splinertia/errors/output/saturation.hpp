// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Clips the reading to the sensor's range [−limit, limit], in the sensor's unit.
template <typename Scalar = double, int N = 1>
struct Saturation {
  static constexpr std::string_view name = "saturation";
  struct State {};

  PerAxis<Scalar, N> limit;

  /// Throws std::invalid_argument unless the limit is finite and > 0.
  constexpr Saturation(const PerAxis<Scalar, N>& limit_) : limit(limit_) {
    detail::require_positive("Saturation", "limit", limit);
  }

  template <int Axes>
  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const auto clip = [](const Scalar& x, const Scalar& most) {
      const Scalar above = x < -most ? -most : x;
      return most < above ? most : above;
    };
    sample.value = sample.value.binaryExpr(limit.template view<Axes>(), clip);
  }

  void describe(auto&& parameter) const { parameter("limit", limit, SensorUnit{}); }
};

template <typename P>
Saturation(const P&) -> Saturation<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

/// Called by ErrorModel if both terms are in it: throws std::invalid_argument for a range of less than one bit, with
/// which the sensor would read zero or nothing.
template <typename Scalar, int N, int M>
constexpr void check_together(const Saturation<Scalar, N>& saturation, const Quantization<Scalar, M>& quantization) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>((std::max)(N, M)); ++axis) {
    detail::require(saturation.limit[axis] >= quantization.least_significant_bit[axis], "Saturation", "limit",
                    saturation.limit[axis], "at least the least significant bit of the Quantization term");
  }
}

}  // namespace splinertia
