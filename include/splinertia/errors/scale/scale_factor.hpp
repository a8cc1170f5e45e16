// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A scale factor error: the reading and the bias in it are multiplied by 1 + error. 0.01 is one percent. See
/// misalignment.hpp for non-orthogonal axes as well.
template <typename Scalar = double, int N = 1>
struct ScaleFactor {
  static constexpr std::string_view name = "scale factor";
  struct State {};

  PerAxis<Scalar, N> error;

  /// Throws std::invalid_argument unless the error is finite and not −1, which would lose the signal.
  constexpr ScaleFactor(const PerAxis<Scalar, N>& error_) : error(error_) {
    detail::require_finite("ScaleFactor", "error", error);
    for (const Scalar& e : error)
      detail::require(e != Scalar(-1), "ScaleFactor", "error", e, "a scale 1 + error other than 0");
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    sample.value += error.template vector<Axes>().cwiseProduct(sample.value);
    sample.bias += error.template vector<Axes>().cwiseProduct(sample.bias);
  }

  void describe(auto&& parameter) const { parameter("error", error, "1"); }
};

template <typename P>
ScaleFactor(const P&) -> ScaleFactor<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
