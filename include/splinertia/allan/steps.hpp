// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/sample_span.hpp>
#include <splinertia/allan/step_fit.hpp>
#include <splinertia/allan/step_scan.hpp>
#include <splinertia/require.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// A change of a signal's mean that its noise does not explain.
struct Step {
  std::int64_t sample;    ///< first sample at the level after the change
  double height;          ///< level after − level before, in the signal's unit
  double standard_error;  ///< of the height, in the signal's unit
  double significance;    ///< the change over what is usual between windows of the same width in this signal
  std::int64_t duration;  ///< samples between the levels: 0 for a sudden step, more for a slow tilt
};

struct StepOptions {
  double false_alarms = 1e-4;             ///< probability of any step in a log of Gaussian noise
  double least_height = 0;                ///< lower steps are not reported, in the signal's unit
  std::vector<SampleSpan> left_out = {};  ///< not looked at, such as freezes
};

/// The search of find_steps(): candidates from the strongest to the weakest, each fitted and judged.
template <std::floating_point Scalar>
class StepSearch {
 public:
  StepSearch(const IntegratedSignal<Scalar>& signal, const StepOptions& options)
      : signal_(signal), least_(options.least_height / static_cast<double>(signal.unit())), taken_(options.left_out) {
    means_.reserve(static_cast<std::size_t>(signal.samples() / step_block));
    for (std::int64_t begin = 0; begin + step_block <= signal.samples(); begin += step_block) {
      means_.push_back(mean(begin, begin + step_block));
    }
    clipped_ = means_;
    clip_knocks(clipped_);
    std::vector<StepCandidate> candidates = StepScan(clipped_, options.false_alarms, least_).candidates();
    std::sort(candidates.begin(), candidates.end(),
              [](const StepCandidate& a, const StepCandidate& b) { return a.excess > b.excess; });
    for (const StepCandidate& candidate : candidates) judge(candidate);
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.sample < b.sample; });
  }

  [[nodiscard]] std::vector<Step>& steps() { return steps_; }

 private:
  /// A change must be so many times the scatter right beside it, which a knock increases, and its standard error.
  static constexpr double least_scatter = 7, least_errors = 5;

  /// Of samples begin … end − 1 less that of the signal, in units of signal.unit().
  [[nodiscard]] double mean(std::int64_t begin, std::int64_t end) const {
    const auto& sums = signal_.sums();
    const Scalar sum = sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(begin)];
    return static_cast<double>(sum) / static_cast<double>(end - begin);
  }

  void judge(const StepCandidate& candidate) {
    const SampleSpan window{(candidate.place - candidate.before) * step_block,
                            (candidate.place + candidate.after) * step_block};
    const auto overlaps = [&](const SampleSpan& span) { return span.begin < window.end && window.begin < span.end; };
    // A rejected candidate stands for its neighbours of similar width.
    const auto stands_for = [&](const StepCandidate& other) {
      return 2 * std::abs(other.place - candidate.place) < other.width && candidate.width <= 2 * other.width &&
             other.width <= 2 * candidate.width;
    };
    if (std::any_of(taken_.begin(), taken_.end(), overlaps)) return;
    if (std::any_of(rejected_.begin(), rejected_.end(), stands_for)) return;
    const std::optional<StepFit> fit = fit_within(window, candidate);
    const bool is_step = fit && std::abs(fit->height) >= std::max({least_, step_rounding, least_scatter * fit->scatter,
                                                                   least_errors * fit->standard_error});
    if (!is_step) {
      rejected_.push_back(candidate);
      return;
    }
    const std::int64_t first = window.begin + fit->begin, last = first + fit->duration;
    const std::int64_t margin = 2 * fit->duration + step_block;  // a slow change may begin and end smoothly
    taken_.push_back({first - margin, last + margin});
    const auto unit = static_cast<double>(signal_.unit());
    steps_.push_back({last, fit->height * unit, fit->standard_error * unit, candidate.ratio, fit->duration});
  }

  /// Nothing where a quarter of the window are knocks.
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
  std::vector<SampleSpan> taken_;
  std::vector<StepCandidate> rejected_;
  std::vector<Step> steps_;
};

/// Finds changes of a signal's mean that its own noise does not explain, in order of time. Step::height is in the unit
/// of the signal.
///
/// The means of neighbouring windows are compared at every place, for widths from 32 samples to 1/32 of the signal.
/// What is usual for a width is measured on this signal, so that random walks, flicker noise, Gauss–Markov noise,
/// vibration, rounding and filters raise the threshold where they have to. Differences of windows further out take
/// drifts off: a ramp or warming up is no step. Two neighbouring blocks of 16 samples that stick out of all around them
/// are taken for a knock and clipped. A step must also stand out of the scatter beside it.
///
/// Found in white noise of standard deviation σ, 1 h at 100 Hz (100 logs each): a step of 0.5 σ in all logs, its time
/// to 12 samples (mean error), its height to 3 % (rms); 0.3 σ in 96 %; 5 σ to the sample, its height to 0.3 %. A tilt
/// that takes 3 or 10 s is one step, its duration to 2 samples. Near an end, 0.5 σ is found in 50 to 70 % of logs at
/// 400 samples from it, 80 to 95 % at 600 and 99 % at 1000; 1 σ in 95 % at 150; 5 σ in all from 20 samples on. In a
/// random walk or flicker noise the height has up to 1.6 times its standard error, which is as stated in white noise.
///
/// False alarms: none in 200 logs each of white noise, with a random walk (4 strengths), flicker noise (3),
/// Gauss–Markov noise of 10, 100 and 600 s, ramps, warming up with exp(−t/600 s) of 0.1 to 100 σ, lines of 0.05 to 40
/// Hz, resonances, rounding to 0.3 to 6 σ, angle quantization, a low-pass and sample-and-hold, 1 h at 100 Hz.
///
/// Not found: steps in fewer than 1024 samples, a level that is left again within about 250 (σ/h)² samples (h the
/// height), a change that takes longer than 1/16 of the signal.
///
/// Takes 12 to 17 ns a sample (-O2, one core), and 3/16 of the signal's memory.
/// Throws std::invalid_argument for options out of their range.
template <std::floating_point Scalar>
[[nodiscard]] std::vector<Step> find_steps(const IntegratedSignal<Scalar>& signal, const StepOptions& options = {}) {
  require(options.false_alarms > 0 && options.false_alarms < 1, "find_steps", "false_alarms", options.false_alarms,
          "a probability in (0, 1)");
  require_non_negative("find_steps", "least_height", options.least_height);
  return std::move(StepSearch(signal, options).steps());
}

/// Likewise; throws what IntegratedSignal throws.
template <Signal S>
[[nodiscard]] std::vector<Step> find_steps(const S& signal, const StepOptions& options = {}) {
  return find_steps(IntegratedSignal(signal, ScalarOfSignal<S>(1)), options);
}

}  // namespace splinertia::allan
