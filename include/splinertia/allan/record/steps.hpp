// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/record/detail/step_fit.hpp>
#include <splinertia/allan/record/detail/step_scan.hpp>
#include <splinertia/allan/record/sample_span.hpp>
#include <splinertia/detail/require.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// A change of a signal's mean that its noise does not explain.
struct Step {
  std::int64_t sample;    ///< first sample at the level after the change
  double height;          ///< level after − level before, in the signal's unit
  double standard_error;  ///< of the height, in the signal's unit
  double significance;    ///< the change over the usual one between windows of this width in this signal
  std::int64_t duration;  ///< samples between the levels: 0 for a sudden step, more for a slow tilt
};

struct StepOptions {
  double false_alarms = 1e-4;             ///< probability of any step in a log of Gaussian noise
  double least_height = 0;                ///< lower steps are not reported; in the signal's unit
  std::vector<SampleSpan> left_out = {};  ///< not searched, such as freezes
};

namespace detail {

/// The search of find_steps(): takes candidates from the strongest to the weakest, fits each and judges it.
template <std::floating_point Scalar>
class StepSearch {
 public:
  StepSearch(std::reference_wrapper<const IntegratedSignal<Scalar>> signal, const StepOptions& options)
      : signal_(signal), least_(options.least_height / static_cast<double>(signal_.unit())), taken_(options.left_out) {
    means_.reserve(static_cast<std::size_t>(signal_.samples() / step_block));
    for (std::int64_t begin = 0; begin + step_block <= signal_.samples(); begin += step_block) {
      means_.push_back(mean(begin, begin + step_block));
    }
    clipped_ = means_;
    clip_knocks(clipped_);
    usual_change_ = usual_change({0, static_cast<std::int64_t>(means_.size())});
    std::vector<StepCandidate> candidates = StepScan(clipped_, options.false_alarms, least_).candidates();
    std::sort(candidates.begin(), candidates.end(),
              [](const StepCandidate& a, const StepCandidate& b) { return a.excess > b.excess; });
    for (const StepCandidate& candidate : candidates) judge(candidate);
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.sample < b.sample; });
  }

  [[nodiscard]] std::vector<Step> steps() && { return std::move(steps_); }

 private:
  /// A step must be at least this many times the scatter beside it, which a knock increases, and this many times its
  /// standard error.
  static constexpr double least_scatter = 7, least_errors = 5;
  /// A few blocks measure their noise poorly: an excess of up to this factor does not count.
  static constexpr double noisier = 1.25;
  /// A level needs at least this many samples.
  static constexpr double fewest = 6;

  /// The mean of samples begin … end − 1 less that of the signal, in units of signal.unit().
  [[nodiscard]] double mean(std::int64_t begin, std::int64_t end) const {
    const auto& sums = signal_.sums();
    const Scalar sum = sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(begin)];
    return static_cast<double>(sum) / static_cast<double>(end - begin);
  }

  void judge(const StepCandidate& candidate) {
    const SampleSpan window{(candidate.center - candidate.before) * step_block,
                            (candidate.center + candidate.after) * step_block};
    const auto overlaps = [&](const SampleSpan& span) { return span.begin < window.end && window.begin < span.end; };
    // A rejected candidate also rejects its neighbours of similar width.
    const auto stands_for = [&](const StepCandidate& other) {
      return 2 * std::abs(other.center - candidate.center) < other.width && candidate.width <= 2 * other.width &&
             other.width <= 2 * candidate.width;
    };
    if (std::any_of(taken_.begin(), taken_.end(), overlaps)) return;
    if (std::any_of(rejected_.begin(), rejected_.end(), stands_for)) return;
    if (is_noisier(candidate)) {
      rejected_.push_back(candidate);
      return;
    }
    const std::optional<StepFit> fit = fit_within(window, candidate);
    if (!fit || !(fit->is_knock || is_step(*fit))) {
      rejected_.push_back(candidate);
      return;
    }
    const std::int64_t first = window.begin + fit->begin, last = first + fit->duration;
    const std::int64_t margin = 2 * fit->duration + step_block;  // a slow change may begin and end smoothly
    taken_.push_back({first - margin, last + margin});
    if (fit->is_knock) return;
    const auto unit = static_cast<double>(signal_.unit());
    steps_.push_back({last, fit->height * unit, fit->standard_error * unit, candidate.ratio, fit->duration});
  }

  /// The usual change from a block to the next one.
  [[nodiscard]] double usual_change(const SampleSpan& blocks) {
    const std::int64_t stride = std::max<std::int64_t>(1, blocks.size() / 8192);
    changes_.clear();
    for (std::int64_t i = blocks.begin + 1; i < blocks.end; i += stride) {
      const auto block = static_cast<std::size_t>(i);
      changes_.push_back(std::abs(clipped_[block] - clipped_[block - 1]));
    }
    return (std::max)(usual_size(changes_), step_rounding);
  }

  /// Whether the noise in the candidate's window exceeds the usual noise by as much as the candidate exceeds the
  /// threshold.
  [[nodiscard]] bool is_noisier(const StepCandidate& candidate) {
    const double here = usual_change({candidate.center - candidate.before, candidate.center + candidate.after});
    return here > noisier * candidate.excess * usual_change_;
  }

  /// Rejects a bend of a drift: it looks like a step once the drift is removed, but the mean did not change in that
  /// direction. Also rejects a few samples of a coarse resolution that happen to lie close together.
  [[nodiscard]] bool is_step(const StepFit& fit) const {
    const double least =
        (std::max)({least_, step_rounding, least_scatter * fit.scatter, least_errors * fit.standard_error});
    const auto [low, high] = std::minmax_element(samples_.begin(), samples_.end());
    const double worth = std::abs(fit.height) * fit.samples / (*high - *low);  // in samples that span the whole range
    return std::abs(fit.height) >= least && 2 * fit.difference / fit.height >= 1 && worth >= fewest;
  }

  /// Returns nothing if at least a quarter of the window are knocks.
  std::optional<StepFit> fit_within(const SampleSpan& window, const StepCandidate& candidate) {
    samples_.clear();
    std::int64_t knocked = 0;
    for (std::int64_t i = window.begin; i < window.end; ++i) {
      const auto block = static_cast<std::size_t>(i / step_block);
      const bool knock = std::abs(clipped_[block] - means_[block]) > step_rounding;
      samples_.push_back(knock ? clipped_[block] : mean(i, i + 1));
      if (knock) ++knocked;
    }
    if (4 * knocked >= window.size()) return std::nullopt;
    return StepFitter(samples_).fit(candidate.before * step_block, candidate.width * step_block);
  }

  const IntegratedSignal<Scalar>& signal_;
  double least_;
  std::vector<double> means_, clipped_;  ///< of blocks
  std::vector<double> samples_;          ///< of one window
  std::vector<double> changes_;          ///< from block to block
  double usual_change_;                  ///< of the whole signal
  std::vector<SampleSpan> taken_;
  std::vector<StepCandidate> rejected_;
  std::vector<Step> steps_;
};

}  // namespace detail

/// Finds changes of a signal's mean that its own noise does not explain, in order of time.
///
/// The means of neighbouring windows are compared at every place, for widths from 32 samples to 1/32 of the signal.
/// What is usual for a width is measured on this signal, so that random walks, flicker noise, Gauss–Markov noise,
/// vibration, rounding and filters raise the threshold as needed. Windows further out remove drifts: a ramp is no step.
/// A step must also stand out of the scatter beside it.
///
/// Found in white noise of standard deviation σ, 1 h at 100 Hz (100 logs each): steps of 0.3 σ and more in all logs. At
/// 0.5 σ the time is right to 11 samples (mean error) and the height to 3 % (rms), at 5 σ to the sample and to 0.3 %. A
/// tilt that takes 3 or 10 s is one step, with its duration right to 2 samples. In shorter logs: 0.5 σ in 84 % of logs
/// of 10 minutes and in all of 20; 1 σ in 97 % of 200 s. Near an end: 0.5 σ in 50 to 63 % of logs at 400 samples from
/// it, 87 to 94 % at 600, all at 1000; 1 σ in 94 % at 150; 5 σ in 93 % at 20, all at 33. The standard error of the
/// height is right in white noise; a random walk or flicker noise besides adds up to 60 %.
///
/// False alarms: none in 200 logs each (1 h at 100 Hz), nor in 40 (2 h at 200 Hz), of:
///   white noise alone and with random walks, flicker noise, Gauss–Markov noise of 10, 100 and 600 s, ramps, warming up
///   as exp(−t/600 s) from 0.1 to 100 σ, lines from 0.05 to 40 Hz of up to 3 σ, resonances, rounding to 0.3 to 4 σ;
///   angle quantization; low-passed noise; values held for several samples.
/// With a resolution of 6 σ: one in 100 logs of 2 h. A transient of a minute or less looks like a step in one log of
/// ten.
///
/// Not found: steps in logs of fewer than 1024 samples; a level that is left again within longest_knock samples, which
/// measure_stillness() finds, or within about 250 (σ/height)² samples; a change that takes longer than 1/16 of the
/// signal.
///
/// Takes 6 to 16 ns a sample (-O2, one core) and 3/16 of the signal's memory.
/// Throws std::invalid_argument for options out of their range.
template <std::floating_point Scalar>
[[nodiscard]] std::vector<Step> find_steps(const IntegratedSignal<Scalar>& signal, const StepOptions& options = {}) {
  splinertia::detail::require(options.false_alarms > 0 && options.false_alarms < 1, "find_steps", "false_alarms",
                              options.false_alarms, "a probability in (0, 1)");
  splinertia::detail::require_non_negative("find_steps", "least_height", options.least_height);
  return detail::StepSearch<Scalar>(signal, options).steps();
}

/// The same for a signal of samples. Also throws what IntegratedSignal throws: std::invalid_argument for a constant
/// signal, one with fewer than three samples, or with one that is not finite.
template <Signal S>
[[nodiscard]] std::vector<Step> find_steps(const S& signal, const StepOptions& options = {}) {
  return find_steps(IntegratedSignal(signal, detail::ScalarOfSignal<S>(1)), options);
}

}  // namespace splinertia::allan
