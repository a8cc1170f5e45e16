// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <string_view>

namespace splinertia {

namespace detail {

/// One exact step of a stationary first-order Gauss–Markov (Ornstein–Uhlenbeck) process of unit variance:
/// x ← x − gain·x + deviation·n, n standard normal. Gelb, Applied Optimal Estimation (1974), 3.6.
/// In the form exp(−h/τ)·x + …, x would no longer return to zero where the exponential is rounded to one.
template <typename Scalar>
struct GaussMarkovStep {
  Scalar gain = Scalar(1);       ///< 1 − exp(−h/τ)
  Scalar deviation = Scalar(1);  ///< √(1 − exp(−2h/τ))

  GaussMarkovStep() = default;
  /// A step of h correlation times.
  explicit GaussMarkovStep(const Scalar& h) {
    using std::sqrt;
    gain = one_minus_exp_minus<Scalar>(h);
    deviation = sqrt(one_minus_exp_minus<Scalar>(Scalar(2) * h));
  }
};

}  // namespace detail

/// A bias that wanders about zero: a first-order Gauss–Markov process with the given stationary standard deviation σ
/// (in the sensor's unit) and correlation time τ (s). Autocovariance σ² exp(−|t|/τ). The discretisation is exact, so
/// that the statistics do not depend on the sampling rate. It starts in its stationary distribution, or at `initial`.
template <typename Scalar = double, int N = 1>
struct GaussMarkov {
  static constexpr std::string_view name = "Gauss-Markov";

  /// x ← x − gain·x + deviation·n, for each axis.
  template <int Axes>
  struct Step {
    AxisVector<Scalar, Axes> gain, deviation;
  };
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : normals(term) {}
    Normals normals;
    AxisVector<Scalar, Normals::axes> bias = AxisVector<Scalar, Normals::axes>::Zero();
    detail::ForInterval<Scalar, Step<Normals::axes>> step{};
  };

  PerAxis<Scalar, N> standard_deviation;
  PerAxis<Scalar, N> correlation_time;
  std::optional<PerAxis<Scalar, N>> initial;  ///< the bias in the first sample

  /// Throws std::invalid_argument unless the deviation and its third power are finite and >= 0, the correlation time finite
  /// and > 0, and the initial value finite.
  constexpr GaussMarkov(const PerAxis<Scalar, N>& standard_deviation_, const PerAxis<Scalar, N>& correlation_time_,
                        const std::optional<PerAxis<Scalar, N>>& initial_ = std::nullopt)
      : standard_deviation(standard_deviation_), correlation_time(correlation_time_), initial(initial_) {
    detail::require_noise_factor("GaussMarkov", "standard deviation", standard_deviation);
    detail::require_positive("GaussMarkov", "correlation time", correlation_time);
    if (initial_) detail::require_finite("GaussMarkov", "initial value", *initial_);
  }

  template <int Axes>
  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    if (sample.first && initial) [[unlikely]] {
      state.bias = initial->template vector<Axes>();
    } else {
      const Scalar interval = sample.first ? Scalar(0) : sample.interval;
      const Step<Axes>& step = state.step(interval, [this, interval] { return make_step<Axes>(interval); });
      const AxisVector<Scalar, Axes> n = state.normals.template draw<Scalar>();
      state.bias += step.deviation.cwiseProduct(n) - step.gain.cwiseProduct(state.bias);
    }
    sample.value += state.bias;
    sample.bias += state.bias;
  }

  void describe(auto&& parameter) const {
    parameter("standard deviation", standard_deviation, SensorUnit{});
    parameter("correlation time", correlation_time, "s");
    if (initial) parameter("initial value", *initial, SensorUnit{});
  }

 private:
  template <int Axes>
  [[nodiscard]] SPLINERTIA_COLD Step<Axes> make_step(Scalar interval) const {
    const AxisVector<Scalar, Axes> deviation = standard_deviation.template vector<Axes>(),
                                   time = correlation_time.template vector<Axes>();
    // From zero to the stationary distribution.
    if (interval == Scalar(0)) return {AxisVector<Scalar, Axes>::Zero(), deviation};
    Step<Axes> result;
    for (int axis = 0; axis < Axes; ++axis) {
      const detail::GaussMarkovStep<Scalar> unit(interval / time[axis]);
      result.gain[axis] = unit.gain;
      result.deviation[axis] = deviation[axis] * unit.deviation;
    }
    return result;
  }
};

template <typename P, typename... More>
GaussMarkov(const P&,
            const More&...) -> GaussMarkov<detail::ScalarOfParameter<P>, detail::values_in_parameters<P, More...>>;

}  // namespace splinertia
