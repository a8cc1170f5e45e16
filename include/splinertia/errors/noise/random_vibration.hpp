// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/errors/detail/second_order_response.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>
#include <type_traits>

namespace splinertia {

/// Vibration of a structure under random excitation: a damped oscillator driven by white noise, with the given standard
/// deviation σ (in the sensor's unit), natural frequency (Hz) and damping ratio ζ (narrow-band for ζ ≪ 1, broad for ζ
/// near 1). Autocovariance σ² e^{−ζω|t|}(cos b + ζω|t| sin b/b), b = ω|t|√(1 − ζ²). The discretisation is exact, so
/// that it does not depend on the sampling rate. It starts in its stationary distribution and does not count as bias.
/// Crandall, Mark, Random Vibration in Mechanical Systems (1963), 2.3.
template <typename Scalar = double, int N = 1>
struct RandomVibration {
  static constexpr std::string_view name = "random vibration";

  /// The scalar of the state. Rounding to float would shift the variance of a vibration that lasts for a million
  /// samples by percents.
  using Wide = std::conditional_t<std::same_as<Scalar, float>, double, Scalar>;

  /// (y, y′/ω) ← transition·(y, y′/ω) + noise·n, in units of the standard deviation, which both components share.
  struct Step {
    Eigen::Matrix<Wide, 2, 2> transition, noise;
  };
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : for_value(term / "value"), for_rate(term / "rate") {}
    Normals for_value, for_rate;
    AxisVector<Wide, Normals::axes> value = AxisVector<Wide, Normals::axes>::Zero();
    AxisVector<Wide, Normals::axes> rate = AxisVector<Wide, Normals::axes>::Zero();
    detail::ForInterval<Scalar, detail::FixedArray<Step, Normals::axes>> steps{};
  };

  PerAxis<Scalar, N> standard_deviation;
  PerAxis<Scalar, N> natural_frequency;
  PerAxis<Scalar, N> damping_ratio;

  /// Throws std::invalid_argument unless the deviation is finite and >= 0, the others are finite and > 0, and the
  /// third power of the damping ratio is finite.
  constexpr RandomVibration(const PerAxis<Scalar, N>& standard_deviation_, const PerAxis<Scalar, N>& natural_frequency_,
                            const PerAxis<Scalar, N>& damping_ratio_)
      : standard_deviation(standard_deviation_), natural_frequency(natural_frequency_), damping_ratio(damping_ratio_) {
    detail::require_non_negative("RandomVibration", "standard deviation", standard_deviation);
    detail::require_positive("RandomVibration", "natural frequency", natural_frequency);
    detail::require_positive("RandomVibration", "damping ratio", damping_ratio);
    detail::require_factor("RandomVibration", "damping ratio", damping_ratio);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    const AxisVector<Wide, Axes> n = state.for_value.template draw<Wide>(), m = state.for_rate.template draw<Wide>();
    if (sample.first) {
      state.value = n;
      state.rate = m;
    } else {
      const auto& steps = state.steps(sample.interval, [&] { return make_steps<Axes>(sample.interval); });
      for (int i = 0; i < Axes; ++i) {
        const auto& [transition, noise] = steps[static_cast<std::size_t>(i)];
        const Wide value = state.value[i], rate = state.rate[i];
        state.value[i] = transition(0, 0) * value + transition(0, 1) * rate + noise(0, 0) * n[i] + noise(0, 1) * m[i];
        state.rate[i] = transition(1, 0) * value + transition(1, 1) * rate + noise(1, 1) * m[i];
      }
    }
    sample.value += standard_deviation.template vector<Axes>().cwiseProduct(state.value.template cast<Scalar>());
  }

  void describe(auto&& parameter) const {
    parameter("standard deviation", standard_deviation, SensorUnit{});
    parameter("natural frequency", natural_frequency, "Hz");
    parameter("damping ratio", damping_ratio, "1");
  }

 private:
  // The noise that keeps the covariance at the identity: Q = I − ΦΦᵀ = U·Uᵀ with U upper triangular. For small steps
  // a = ωh the first diagonal element is O(a³); below a = 1e-5 it is lost in rounding. It is limited to >= 0; the error
  // is an additional noise of at most √eps of the standard deviation per step.
  template <int Axes>
  [[nodiscard]] detail::FixedArray<Step, Axes> make_steps(const Scalar& interval) const {
    using std::sqrt;
    detail::FixedArray<Step, Axes> steps;
    for (std::size_t axis = 0; axis < steps.size(); ++axis) {
      const Wide a = Wide(2) * detail::pi_of<Wide>() * Wide(natural_frequency[axis]) * Wide(interval);
      auto& [transition, noise] = steps[axis];
      transition = detail::oscillator_transition<Wide>(a, Wide(damping_ratio[axis]));
      // Element by element: Eigen's product rounds differently where vector instructions fuse multiply and add.
      const auto covariance = [&t = transition](int i, int j) {
        return Wide(i == j ? 1 : 0) - (t(i, 0) * t(j, 0) + t(i, 1) * t(j, 1));
      };
      noise.setZero();
      noise(1, 1) = sqrt(std::max<Wide>(covariance(1, 1), Wide(0)));
      if (noise(1, 1) > Wide(0)) noise(0, 1) = covariance(0, 1) / noise(1, 1);
      noise(0, 0) = sqrt(std::max<Wide>(covariance(0, 0) - noise(0, 1) * noise(0, 1), Wide(0)));
    }
    return steps;
  }
};

template <typename P, typename... More>
RandomVibration(const P&, const More&...)
    -> RandomVibration<detail::ScalarOfParameter<P>, detail::values_in_parameters<P, More...>>;

}  // namespace splinertia
