// SPDX-License-Identifier: MIT
// Any signal, of a few samples and more, at any rate: deviations, identification, checks; any stamps: sampling.
#include <chrono>
#include <cmath>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/allan/record/sampling.hpp>
#include <vector>

#include "fuzz/motions.hpp"

namespace splinertia::fuzz::allan_target {

template <allan::Deviation D>
void expect_curve(const allan::IntegratedSignal<double>& signal, bool usual) {
  const auto curve = allan::curve<D>(signal);
  for (const auto& point : curve.points) {
    expect(point.deviation >= 0 && (!usual || std::isfinite(point.deviation)), D::name, " is ", point.deviation);
    expect(!usual || (point.interval.lower <= point.deviation && point.deviation <= point.interval.upper), D::name,
           " is ", point.deviation, " beside an interval from ", point.interval.lower, " to ", point.interval.upper);
  }
}

void use_signal(Input& input) {
  // Identification takes a hundred times as long as all curves: few inputs ask for it, with few samples.
  const bool all = input.integer(0, 15) == 15;
  const int terms = all ? input.integer(0, 255) : 0;
  Numbers numbers{input};
  const double rate = numbers.wild ? numbers() : 1 + std::abs(numbers());
  const auto repeats = static_cast<std::size_t>(input.integer(1, all ? 1 : 4));
  std::vector<double> values;
  while (!input.empty() && values.size() < (all ? 40U : 100U)) values.push_back(numbers());
  const std::size_t size = values.size();
  // More samples than bytes: patterns with a drift.
  for (std::size_t i = size; i < size * repeats; ++i) {
    values.push_back(values[i - size] + static_cast<double>(i) * (numbers.usual ? 1e-3 : 0));
  }
  (void)accepted("", [&] {
    const allan::IntegratedSignal<double> signal(values, rate);
    expect_curve<allan::AllanDeviation>(signal, numbers.usual);
    expect_curve<allan::OverlappingAllanDeviation>(signal, numbers.usual);
    expect_curve<allan::ModifiedAllanDeviation>(signal, numbers.usual);
    expect_curve<allan::TimeDeviation>(signal, numbers.usual);
    expect_curve<allan::HadamardDeviation>(signal, numbers.usual);
    expect_curve<allan::OverlappingHadamardDeviation>(signal, numbers.usual);
    expect_curve<allan::TotalDeviation>(signal, numbers.usual);
  });
  if (!all) return;
  (void)accepted("", [&] {
    const auto sets = static_cast<int>(allan::NoiseTerms::sets);
    const auto analysis =
        allan::analyse(values, rate, {.candidates = allan::NoiseTerms::numbered(static_cast<unsigned>(terms % sets))});
    for (const allan::NoiseTerm term : allan::noise_terms) {
      const auto& estimate = analysis.noise[term];
      expect(!numbers.usual || !std::isnan(estimate.value), "an estimate is NaN");
    }
  });
}

template <TimePoint Time>
void use_stamps(Input& input) {
  Numbers numbers{input};
  std::vector<Time> stamps;
  Time time{};
  const bool timed = accepted("time: ", [&] {  // after() refuses what is beyond 64 bits
    while (!input.empty() && stamps.size() < 300) {
      if (numbers.wild && input.integer(0, 15) == 0) {
        time = numbers.time<Time>();
      } else {
        time = after(time, 1e-3 * input.integer(0, 20));
      }
      stamps.push_back(time);
    }
  });
  if (!timed) return;
  (void)accepted("sampling: ", [&] {
    const auto sampling = allan::measure_sampling(stamps);
    expect(sampling.rate > 0 && (!numbers.usual || std::isfinite(sampling.rate)), "rate ", sampling.rate);
    expect(sampling.missing >= 0 && sampling.samples == std::ssize(stamps), sampling.samples, " samples");
    expect(sampling.missing_share() >= 0 && sampling.missing_share() < 1, "share ", sampling.missing_share());
    allan::require_regular(sampling);
  });
}

const Target target{"allan", [](Input input) {
                      switch (input.integer(0, 3)) {
                        case 0:
                          return use_stamps<double>(input);
                        case 1:
                          return use_stamps<std::chrono::nanoseconds>(input);
                        default:
                          return use_signal(input);
                      }
                    }};

}  // namespace splinertia::fuzz::allan_target
