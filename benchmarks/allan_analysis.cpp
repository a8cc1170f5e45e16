// SPDX-License-Identifier: MIT
// What Allan analysis costs: nanoseconds a sample and averaging time, beside what memory and the vector unit allow, and
// its memory. And what it is worth: its rounding errors against exact integers, and how far estimates of noise terms
// are from the truth, beside the least that any estimate could be.

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <stdexcept>
#include <vector>

#include "allan/accuracy.hpp"
#include "allan/memory.hpp"
#include "allan/speed.hpp"
#include "allan/statistics.hpp"
#include "support/harness.hpp"

namespace {

using namespace splinertia::detail;

// For allan_allantools.py.

/// Doubles as they are in memory.
void write_samples(const std::filesystem::path& path, std::size_t n) {
  const std::vector<double> y = white_signal(n);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(y.data()), static_cast<std::streamsize>(y.size() * sizeof(double)));
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

void analyse(const std::filesystem::path& path) {
  std::vector<double> y(static_cast<std::size_t>(std::filesystem::file_size(path) / sizeof(double)));
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(y.data()), static_cast<std::streamsize>(y.size() * sizeof(double))))
    throw std::runtime_error(path.string() + ": cannot be read");
  const auto factors = AveragingFactors::logarithmic().up_to(static_cast<std::int64_t>(y.size()) / 2);
  const auto start = std::chrono::steady_clock::now();
  const auto values = deviations<OverlappingAllanDeviation>(IntegratedSignal(y, rate), factors);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%.6f\n", seconds);
  for (std::size_t j = 0; j < factors.size(); ++j)
    std::printf("%lld,%.17g\n", static_cast<long long>(factors[j]), values[j]);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<benchmark::Kernel> kernels{{"integrated_signal", run_integration},
                                               {"overlapping", run_overlapping},
                                               {"streaming_push", run_streaming},
                                               {"identify", run_identify}};
  Settings settings;
  CLI::Option *samples = nullptr, *csv = nullptr;
  benchmark::Extension extension;
  extension.options = [&](CLI::App& app) {
    csv = app.get_option("--csv");
    samples = app.add_option("--samples", settings.samples, "samples of a log; 1440000 for --statistics, if not given")
                  ->capture_default_str()
                  ->check(CLI::Range(std::size_t{1000}, std::size_t{1} << 40));
    app.add_option("--repetitions", settings.repetitions, "times that each job is measured")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_flag("--huge", settings.huge, "memory and time for 1e8 samples, too");
    app.add_flag("--accuracy", settings.accuracy,
                 "only compare with exact integers, 1e8 samples if not given; exit code 1 if an error is above 1e-9");
    app.add_flag("--statistics", settings.statistics, "only estimate noise terms of simulated logs");
    app.add_option("--runs", settings.runs, "logs of three axes for --statistics")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--case", settings.only_case, "only cases of --statistics whose name contains this");
    app.add_option("--write-samples", settings.written, "only write a log to this file, for allan_allantools.py");
    app.add_option("--analyse", settings.analysed, "only print the time for such a file, factors and OADEV");
  };
  extension.instead = [&]() -> std::optional<int> {
    const bool as_csv = csv->count() > 0;
    if (!settings.written.empty()) return write_samples(settings.written, settings.samples), 0;
    if (!settings.analysed.empty()) return analyse(settings.analysed), 0;
    if (settings.accuracy) {
      if (samples->count() == 0) settings.samples = 100'000'000;
      return check_accuracy(as_csv, settings);
    }
    if (settings.statistics) {
      if (samples->count() == 0) settings.samples = two_hours;
      return print_statistics(as_csv, settings), 0;
    }
    return std::nullopt;
  };
  extension.figures = [&](bool as_csv, std::size_t) {
    print_memory(as_csv, settings);  // first: a process begins with what this one has
    print_speed(as_csv, settings);
  };
  return benchmark::run(argc, argv, "What Allan analysis costs, and what it is worth.", kernels, extension);
}
