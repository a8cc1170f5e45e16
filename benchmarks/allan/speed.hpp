// SPDX-License-Identifier: MIT
/// Nanoseconds a sample and averaging time, beside what memory and the vector unit allow.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/fit_curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <splinertia/allan/record/steps.hpp>
#include <splinertia/allan/streaming.hpp>
#include <string>
#include <vector>

#include "../support/harness.hpp"
#include "logs.hpp"

using Factors = std::vector<std::int64_t>;

namespace {

using namespace splinertia::allan::detail;

/// As numpy.logspace does, rounded: whole numbers that are not each other's doubles.
Factors log_spaced(std::int64_t largest, int count) {
  Factors result;
  for (int j = 0; j < count; ++j) {
    const auto m = std::llround(std::pow(static_cast<double>(largest), static_cast<double>(j) / (count - 1)));
    if (result.empty() || m > result.back()) result.push_back(m);
  }
  return result;
}

// Speed. Kernels take logs of so many samples as they are called: times are a sample.

const std::vector<double>& kernel_signal(std::size_t calls) {
  static std::vector<double> y;
  if (y.size() != std::max<std::size_t>(calls, 100)) y = white_signal(std::max<std::size_t>(calls, 100));
  return y;
}

void run_integration(std::size_t calls) { benchmark::keep(IntegratedSignal(kernel_signal(calls), rate)); }

void run_overlapping(std::size_t calls) { benchmark::keep(allan::overlapping(kernel_signal(calls), rate)); }

void run_identify(std::size_t calls) { benchmark::keep(identify(kernel_signal(calls), rate)); }

void run_streaming(std::size_t calls) {
  StreamingAllanDeviation<double> streaming(rate);
  for (const double y : kernel_signal(calls)) streaming.push(y);
  benchmark::keep(streaming);
}

/// What is measured on a whole log: `work` units (samples, or samples times averaging times), `bytes` that it loads.
struct Job {
  std::string name, what;
  double work;
  std::function<void()> run;
  double bytes = 0;
};

/// Bytes that the differences load: each chain of factors one stream more than it has factors.
double bytes_of(const Factors& factors, std::size_t n) {
  double streams = 0;
  for (const DoublingChain& chain : doubling_chains(factors, DoublingChain::longest))
    streams += static_cast<double>(chain.indices.size() + 1);
  return streams * 8 * static_cast<double>(n);
}

/// Jobs in turn, so that what else the machine does meets all of them.
void print_jobs(bool csv, const std::vector<Job>& jobs, int repetitions) {
  std::vector<std::vector<double>> times(jobs.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      const auto start = std::chrono::steady_clock::now();
      jobs[k].run();
      times[k].push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
    }
  }
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const Job& job = jobs[k];
    std::sort(times[k].begin(), times[k].end());
    const double least = times[k].front(), median = times[k][times[k].size() / 2], most = times[k].back();
    benchmark::figure(csv, job.name + "_ns", least / job.work, "ns");
    benchmark::figure(csv, job.name + "_median_ns", median / job.work, "ns");
    benchmark::figure(csv, job.name + "_s", least * 1e-9, "s");
    if (job.bytes > 0) benchmark::figure(csv, job.name + "_bandwidth", job.bytes / least, "GB/s");
    if (csv) continue;
    std::printf("%-62s %8.3f %8.3f %8.3f %10.4f", job.what.c_str(), least / job.work, median / job.work,
                most / job.work, least * 1e-9);
    job.bytes > 0 ? std::printf(" %6.1f\n", job.bytes / least) : std::printf("\n");
  }
}

void print_speed(bool csv, const Settings& settings) {
  const std::size_t n = settings.samples;
  const auto samples = static_cast<double>(n);
  const std::vector<double> y = white_signal(n);
  const IntegratedSignal x(y, rate);
  const auto factors_of = [&]<Deviation D>(D) {
    return AveragingFactors::logarithmic().up_to(D::largest_factor(static_cast<std::int64_t>(n)));
  };
  const Factors grid = factors_of(OverlappingAllanDeviation{});
  const Factors log_grid = log_spaced(static_cast<std::int64_t>(n) / 2, 100);
  const auto taus = [](const Factors& factors) { return std::to_string(factors.size()) + " taus"; };
  std::vector<Job> jobs;
  const auto add_deviation = [&]<Deviation D>(D, const std::string& name, const std::string& what,
                                              const Factors& factors) {
    const double bytes = D::overlapping && !D::modified && D::differences == 2 ? bytes_of(factors, n) : 0;
    jobs.push_back({name, what + ", " + taus(factors), samples * static_cast<double>(factors.size()),
                    [&x, factors] { benchmark::keep(deviations<D>(x, factors)); }, bytes});
  };
  const auto points = static_cast<double>(grid.size());
  jobs.push_back({"oadev_from_signal", "OADEV from the signal, " + taus(grid), samples * points, [&] {
                    const IntegratedSignal integrated(y, rate);
                    benchmark::keep(deviations<OverlappingAllanDeviation>(integrated, grid));
                  }});
  jobs.push_back({"oadev_from_signal_log_spaced", "the same on a grid without doubles, " + taus(log_grid),
                  samples * static_cast<double>(log_grid.size()), [&] {
                    const IntegratedSignal integrated(y, rate);
                    benchmark::keep(deviations<OverlappingAllanDeviation>(integrated, log_grid));
                  }});
  add_deviation(OverlappingAllanDeviation{}, "oadev", "OADEV from sums", grid);
  add_deviation(OverlappingAllanDeviation{}, "oadev_log_spaced", "the same on a grid without doubles", log_grid);
  // The same differences where all is in the fastest cache.
  constexpr std::int64_t small = 1024, factor = 64;
  const std::size_t rounds = std::max<std::size_t>(1, n / small);
  jobs.push_back({"bound_arithmetic", "bound: differences over four factors, all in the L1 cache",
                  4.0 * small * static_cast<double>(rounds), [&x, rounds, n] {
                    const double* begin = x.sums().data();
                    if (n < small + 16 * factor) return;
                    const auto end = static_cast<std::int64_t>(std::min<std::size_t>(n, small));
                    for (std::size_t i = 0; i < rounds; ++i)
                      benchmark::keep(squared_differences<2, 4>(begin, factor, 0, end));
                  }});
  jobs.push_back({"bound_reading", "bound: reading the sums once, a stream", samples,
                  [&x] {
                    using Sums = Eigen::Map<const Eigen::ArrayXd>;
                    double sum = Sums(x.sums().data(), static_cast<Eigen::Index>(x.sums().size())).sum();
                    benchmark::keep(sum);
                  },
                  8 * samples});
  add_deviation(OverlappingHadamardDeviation{}, "ohdev", "OHDEV from sums", factors_of(OverlappingHadamardDeviation{}));
  add_deviation(ModifiedAllanDeviation{}, "mdev", "MDEV from sums", factors_of(ModifiedAllanDeviation{}));
  add_deviation(TotalDeviation{}, "totdev", "TOTDEV from sums", grid);
  jobs.push_back(
      {"integration", "a sample: mean and running sums", samples, [&] { benchmark::keep(IntegratedSignal(y, rate)); }});
  jobs.push_back({"intervals", "a sample: curve() without its deviations: power laws and intervals", samples, [&] {
                    for (const std::int64_t m : grid) {
                      const int alpha = std::max(noise_type(x, m), steepest_power_law<OverlappingAllanDeviation>);
                      const double freedom = degrees_of_freedom<OverlappingAllanDeviation>(alpha, m, x.samples(),
                                                                                           PhaseModel::greenhall_riley);
                      benchmark::keep(deviation_interval(1.0, freedom, one_sigma<double>));
                    }
                  }});
  jobs.push_back({"streaming", "a sample: StreamingAllanDeviation::push()", samples, [&] {
                    StreamingAllanDeviation<double> streaming(rate);
                    for (const double value : y) streaming.push(value);
                    benchmark::keep(streaming);
                  }});
  jobs.push_back(
      {"identify", "a sample: identify() from the signal", samples, [&] { benchmark::keep(identify(y, rate)); }});
  jobs.push_back({"find_steps", "a sample: find_steps() from sums", samples, [&] { benchmark::keep(find_steps(x)); }});
  jobs.push_back({"analyse", "a sample: analyse(), all together", samples, [&] { benchmark::keep(analyse(y, rate)); }});
  const auto of_y = allan::overlapping(y, rate);
  jobs.push_back(
      {"fit_curve", "a sample: fit_curve() of the curve", samples, [&] { benchmark::keep(fit_curve(of_y)); }});
  if (!csv) {
    std::printf("\n%.3g samples, in turn, %d times%*s min   median      max      s, min   GB/s\n", samples,
                settings.repetitions, 25, "ns:");
  }
  print_jobs(csv, jobs, settings.repetitions);
}

}  // namespace
