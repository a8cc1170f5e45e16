// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Jitter of the stamps: each has a normal error of mean zero and the given standard deviation σ, in s, at any time of
/// a run. The samples themselves are taken on time. The order of the stamps is kept: the stamps of neighbouring
/// samples, taken an interval h apart, are never closer than h/100.
///
/// Up to σ = h/4 the offsets are independent. Beyond that, independent offsets would change the order. They then follow
/// a first-order Gauss–Markov process with the correlation ρ = 1 − (h/4σ)² from sample to sample. Its steps have the
/// standard deviation h/√8 at any σ. The correlation lasts for about (4σ/h)² samples, 64 for σ = 2h. The mean offset of
/// the n samples of a run is zero on average, with standard deviation σ√((1 + ρ)/((1 − ρ)n)).
///
/// A step of more than 0.99 h is rejected: the offset keeps its value (0.5 % of the steps at σ >= h/4, 0.05 % at h/5,
/// 3e-6 at 3h/20). The distribution of an offset remains exactly normal, whatever the intervals: the proposals leave it
/// unchanged and are reversible, and the rejection is the same in both directions. Metropolis et al., "Equation of
/// State Calculations by Fast Computing Machines", J. Chem. Phys. 21 (1953).
template <typename Scalar = double>
struct StampJitter {
  static constexpr std::string_view name = "stamp jitter";

  /// offset ← offset − gain·offset + deviation·n, n standard normal, unless it moves by more than `most`.
  struct Step {
    Scalar gain, deviation, most;
  };
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : normals(term) {}
    Normals normals;
    Scalar offset = Scalar(0);
    detail::ForInterval<Scalar, Step> step{};
  };

  Scalar standard_deviation;

  /// Throws std::invalid_argument unless the deviation is finite and >= 0.
  constexpr StampJitter(const Scalar& standard_deviation_) : standard_deviation(standard_deviation_) {
    detail::require_non_negative("StampJitter", "standard deviation", standard_deviation);
  }

  void apply(Stamp<Scalar>& stamp, auto& state) const {
    const Scalar n = static_cast<Scalar>(state.normals.draw_one());
    if (stamp.first) {
      state.offset = standard_deviation * n;
    } else {
      const Step& step = state.step(stamp.interval, [&] { return make_step(stamp.interval); });
      const Scalar proposal = state.offset - step.gain * state.offset + step.deviation * n;
      const Scalar change = proposal - state.offset;
      if (-step.most <= change && change <= step.most) state.offset = proposal;
    }
    stamp.offset += state.offset;
  }

  void describe(auto&& parameter) const { parameter("standard deviation", standard_deviation, "s"); }

 private:
  [[nodiscard]] Step make_step(const Scalar& interval) const {
    using std::sqrt;
    const Scalar most = interval * Scalar(99) / Scalar(100);
    const Scalar independent = interval / Scalar(4);  // the largest deviation of independent offsets
    if (standard_deviation <= independent) return {Scalar(1), standard_deviation, most};
    const Scalar ratio = independent / standard_deviation, gain = ratio * ratio;
    // σ√(1 − ρ²) with ρ = 1 − gain
    return {gain, independent * sqrt(Scalar(2) - gain), most};
  }
};

template <typename P>
StampJitter(const P&) -> StampJitter<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
