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
#include <vector>

namespace splinertia::allan {

/// A change of a signal's mean that its noise does not explain.
struct Step {
  std::int64_t sample;    ///< first sample at the level after the change
  double height;          ///< level after − level before, in the signal's unit
  double standard_error;  ///< of the height
  double significance;    ///< the change over the usual one of windows of the same width in this signal
  std::int64_t duration;  ///< samples between the levels: 0 for a sudden step, more for a slow tilt
};

struct StepOptions {
  double false_alarms = 1e-4;  ///< probability of any step in Gaussian noise
  double least_height = 0;  ///< lower ones are not reported; of a signal rounded more coarsely than 3 σ its resolution
};

namespace detail {

/// Spans that do not overlap, and whether another one does.
class StepSpans {
 public:
  explicit StepSpans(std::vector<SampleSpan> spans) : spans_(std::move(spans)) {}
  [[nodiscard]] bool overlap(const SampleSpan& span) const {
    return std::any_of(spans_.begin(), spans_.end(),
                       [&](const SampleSpan& other) { return other.begin < span.end && span.begin < other.end; });
  }
  void add(const SampleSpan& span) { spans_.push_back(span); }

 private:
  std::vector<SampleSpan> spans_;
};

}  // namespace detail

/// Finds steps of the mean.
template <std::floating_point Scalar>
[[nodiscard]] std::vector<Step> find_steps(const IntegratedSignal<Scalar>& signal, const StepOptions& options = {},
                                           const std::vector<SampleSpan>& left_out = {}) {
  require(options.false_alarms > 0 && options.false_alarms < 1, "find_steps", "false_alarms", options.false_alarms,
          "a probability in (0, 1)");
  require_non_negative("find_steps", "least_height", options.least_height);
  const auto& sums = signal.sums();
  const auto value = [&](std::int64_t begin, std::int64_t end) {  // mean of samples, in units of signal.unit()
    return static_cast<double>(sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(begin)]) /
           static_cast<double>(end - begin);
  };
  const auto unit = static_cast<double>(signal.unit());
  const double least = options.least_height / unit;
  std::vector<double> means(static_cast<std::size_t>(signal.samples() / step_block));
  std::int64_t begin = 0;
  for (double& mean : means) {
    mean = value(begin, begin + step_block);
    begin += step_block;
  }
  const std::vector<double> unclipped = means;
  clip_knocks(means);
  StepScan scan(means, options.false_alarms, least);
  std::vector<StepCandidate> candidates = scan.candidates();
  std::sort(candidates.begin(), candidates.end(),
            [](const StepCandidate& a, const StepCandidate& b) { return a.excess > b.excess; });
  detail::StepSpans taken(left_out);
  std::vector<StepCandidate> rejected;
  std::vector<Step> steps;
  std::vector<double> window;
  for (const StepCandidate& candidate : candidates) {
    const SampleSpan span{(candidate.place - candidate.before) * step_block,
                          (candidate.place + candidate.after) * step_block};
    if (taken.overlap(span)) continue;
    const bool tried = std::any_of(rejected.begin(), rejected.end(), [&](const StepCandidate& other) {
      return 2 * std::abs(other.place - candidate.place) < other.width && candidate.width <= 2 * other.width &&
             other.width <= 2 * candidate.width;
    });
    if (tried) continue;
    window.clear();
    for (std::int64_t i = span.begin; i < span.end; ++i) {
      const auto block = static_cast<std::size_t>(i / step_block);
      window.push_back(means[block] == unclipped[block] ? value(i, i + 1) : means[block]);
    }
    const std::optional<StepFit> fit =
        StepFitter(window).fit(candidate.before * step_block, candidate.width * step_block);
    if (!fit || !(std::abs(fit->height) >= 6 * fit->standard_error) || std::abs(fit->height) < least) {
      rejected.push_back(candidate);
      continue;
    }
    const std::int64_t first = span.begin + fit->begin, last = first + fit->duration;
    const std::int64_t margin = fit->duration + step_block;
    taken.add({first - margin, last + margin});
    steps.push_back({last, fit->height * unit, fit->standard_error * unit, candidate.ratio, fit->duration});
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.sample < b.sample; });
  return steps;
}

}  // namespace splinertia::allan
