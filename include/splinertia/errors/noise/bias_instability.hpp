// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/noise/gauss_markov.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <string_view>
#include <utility>

namespace splinertia {

/// The range of averaging times over which the Allan deviation of BiasInstability is flat, s.
template <typename Scalar = double>
struct FlickerBand {
  Scalar shortest = Scalar(1);
  Scalar longest = Scalar(3600);
};

template <typename P, typename Q>
FlickerBand(P, Q) -> FlickerBand<detail::ScalarOfParameter<P>>;

/// Flicker noise (bias instability) of coefficient B, in the sensor's unit: power spectral density B²/(2πf), Allan
/// deviation B·√(2 ln 2/π) = 0.664 B at all averaging times. IEEE Std 952-1997, C.1.2.
///
/// No finite model does that at all times. This one is a sum of Stages independent Gauss–Markov processes. Their
/// correlation times form a geometric progression with ratio r, from a fifth of the shortest averaging time of the band
/// to twice the longest. Each has the variance B² ln r/π, so that the densities add up to B²/(2πf). The first and the
/// last replace all those missing beyond them and have r/(r − 1) times this variance.
///
/// Accuracy: for ratios up to 7 the Allan deviation stays within 2 % of flat over the whole band, within 0.4 % well
/// inside. Stages = 7 gives r = 5.8 for the default band. With r = 10 it ripples by 1 %, with r = 18 by 3 %. The cost
/// is proportional to Stages: each process draws a number for each axis. The spectrum is right within the band only: to
/// 1.5 % from 1/longest to 1/(4·shortest) for the default. Below, it becomes flat; above, it falls as 1/f².
///
/// The discretisation is exact and the process starts in its stationary distribution, so that it does not depend on the
/// sampling rate. The sampling interval should not be longer than the shortest averaging time. Sums of relaxations for
/// 1/f noise: van der Ziel, Physica 16 (1950). The Gauss–Markov step is that of gauss_markov.hpp.
template <typename Scalar = double, std::size_t Stages = 7, int N = 1>
struct BiasInstability {
  static_assert(Stages >= 2);
  static constexpr std::string_view name = "bias instability";

  /// One of the processes of the sum.
  struct Stage {
    Scalar correlation_time;  ///< s
    Scalar deviation;         ///< stationary standard deviation over B
    detail::GaussMarkovStep<Scalar> step;
  };
  template <typename Normals>
  struct State {
    explicit State(StreamKey term)
        : normals([&]<std::size_t... Index>(std::index_sequence<Index...>) {
            return std::array<Normals, Stages>{Normals(term / Index)...};
          }(std::make_index_sequence<Stages>{})) {
      values.fill(AxisVector<Scalar, Normals::axes>::Zero());
    }
    std::array<Normals, Stages> normals;
    std::array<AxisVector<Scalar, Normals::axes>, Stages> values;  // over B
    detail::ForInterval<Scalar, std::array<Stage, Stages>> stages{};
  };

  PerAxis<Scalar, N> coefficient;
  FlickerBand<Scalar> band;

  /// Throws std::invalid_argument unless B is finite and >= 0 and 0 < shortest < longest < ∞ with a finite ratio.
  constexpr BiasInstability(const PerAxis<Scalar, N>& coefficient_, const FlickerBand<Scalar>& band_ = {})
      : coefficient(coefficient_), band(band_) {
    detail::require_non_negative("BiasInstability", "coefficient B", coefficient);
    detail::require_positive("BiasInstability", "shortest averaging time", band.shortest);
    detail::require(detail::is_finite(band.longest) && band.longest > band.shortest, "BiasInstability",
                    "longest averaging time", band.longest, "a finite number above the shortest");
    // The longest correlation time, and its ratio to the shortest.
    detail::require(
        detail::is_finite(Scalar(2) * band.longest) && detail::is_finite(Scalar(10) * band.longest / band.shortest),
        "BiasInstability", "longest averaging time", band.longest, "one whose ratio to the shortest is finite");
  }

  /// The processes of the sum, the slowest first, with their steps for one sampling interval.
  [[nodiscard]] std::array<Stage, Stages> stages(const Scalar& interval) const {
    using std::sqrt;
    const Scalar log_ratio =
        detail::logarithm<Scalar>(Scalar(10) * band.longest / band.shortest) / Scalar(static_cast<int>(Stages - 1));
    std::array<Stage, Stages> result;
    Scalar correlation_time = Scalar(2) * band.longest;
    for (std::size_t i = 0; i < Stages; ++i) {
      // 1/(1 − 1/r) = r/(r − 1)
      const Scalar more =
          i == 0 || i == Stages - 1 ? Scalar(1) / detail::one_minus_exp_minus<Scalar>(log_ratio) : Scalar(1);
      result[i] = {correlation_time, sqrt(log_ratio / detail::pi_of<Scalar>() * more),
                   detail::GaussMarkovStep<Scalar>(interval / correlation_time)};
      correlation_time *= detail::exp_minus<Scalar>(log_ratio);
    }
    return result;
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    const auto& stages_now = state.stages(sample.interval, [&] { return stages(sample.interval); });
    AxisVector<Scalar, Axes> sum = AxisVector<Scalar, Axes>::Zero();
    for (std::size_t i = 0; i < Stages; ++i) {
      const auto& [correlation_time, deviation, step] = stages_now[i];
      const AxisVector<Scalar, Axes> fresh = deviation * state.normals[i].template draw<Scalar>();
      if (sample.first) {
        state.values[i] = fresh;
      } else {
        state.values[i] += step.deviation * fresh - step.gain * state.values[i];
      }
      sum += state.values[i];
    }
    const AxisVector<Scalar, Axes> bias = coefficient.template vector<Axes>().cwiseProduct(sum);
    sample.value += bias;
    sample.bias += bias;
  }

  void describe(auto&& parameter) const {
    parameter("coefficient B", coefficient, SensorUnit{});
    parameter("shortest averaging time", band.shortest, "s");
    parameter("longest averaging time", band.longest, "s");
    parameter("Gauss-Markov processes", static_cast<int>(Stages), "");
  }
};

template <typename P, typename... More>
BiasInstability(const P&,
                const More&...) -> BiasInstability<detail::ScalarOfParameter<P>, 7, detail::values_in_parameter<P>>;

}  // namespace splinertia
