// SPDX-License-Identifier: MIT
// Identifies the noise of many logs, which come through standard input as bare numbers: for allan_statistics.py.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <span>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/detail/deviation_misfit.hpp>
#include <splinertia/allan/identify.hpp>
#include <stdexcept>
#include <string>
#include <vector>

using namespace splinertia;

namespace {

struct Options {
  std::size_t samples = 0;
  double rate = 0;
  std::size_t axes = 1;
};

/// How far the model's Allan deviation is from the measured one at the worst averaging time, in standard errors of the
/// measured one if the model is true; of several axes, at the worst of them.
struct Misfit {
  double above = 0;  ///< the model is larger: it says more power than was measured
  double below = 0;
};

/// What is known of one log.
struct Analysis {
  allan::NoiseEstimates<double> noise;
  int adequacy = 0;    // allan::Adequacy
  double seconds = 0;  ///< that identification took the processor, whatever else runs
  Misfit misfit;
};

struct Field {
  std::string name;
  double value;
};

/// Fills `log` from standard input. False at the end of the input, which may only be between two logs.
bool read_log(std::vector<double>& log) {
  const std::size_t expected = log.size() * sizeof(double), count = std::fread(log.data(), 1, expected, stdin);
  if (count == expected) return true;
  if (std::ferror(stdin) != 0) throw std::runtime_error("standard input cannot be read");
  if (count == 0) return false;
  throw std::invalid_argument("standard input ends after " + std::to_string(count) + " bytes of a log, expected " +
                              std::to_string(expected));
}

void add_misfit(const allan::IntegratedSignal<double>& signal, const allan::NoiseEstimates<double>& noise,
                Misfit& misfit) {
  for (const auto& point : allan::curve<allan::OverlappingAllanDeviation>(signal, {.alpha = 0}).points) {
    const double off = allan::detail::compare_deviation(point, signal.samples(), noise).off;
    misfit.above = std::max(misfit.above, -off);
    misfit.below = std::max(misfit.below, off);
  }
}

Analysis analyse(const std::vector<double>& log, const Options& options) {
  std::vector<allan::IntegratedSignal<double>> signals;
  const std::clock_t start = std::clock();
  for (std::size_t axis = 0; axis < options.axes; ++axis) {
    signals.emplace_back(std::span(log).subspan(axis * options.samples, options.samples), options.rate);
  }
  Analysis result;
  if (options.axes == 1) {
    const auto analysis = allan::analyse(std::span<const double>(log), options.rate);
    result.noise = analysis.noise;
    result.adequacy = static_cast<int>(analysis.adequacy());
  } else {
    result.noise =
        allan::identify_pooled(std::vector<allan::DifferenceSpectrum<double>>(signals.begin(), signals.end()));
    if (!result.noise.fits || result.noise.agreement_probability < 0.01) result.adequacy = 2;
  }
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  for (const auto& signal : signals) add_misfit(signal, result.noise, result.misfit);
  return result;
}

/// The columns of the table. allan_statistics.py finds them by name.
std::vector<Field> fields(const Analysis& analysis) {
  std::vector<Field> result;
  for (const allan::NoiseTerm term : allan::noise_terms) {
    const auto& estimate = analysis.noise[term];
    const std::string symbol(term == allan::NoiseTerm::gauss_markov ? "sigma" : allan::symbol(term));
    const auto add = [&](const char* name, double value) { result.push_back({symbol + "_" + name, value}); };
    add("detected", estimate.detected ? 1 : 0);
    add("value", estimate.value);
    add("lower", estimate.interval.lower);
    add("upper", estimate.interval.upper);
    add("one_sigma_lower", estimate.one_sigma.lower);
    add("one_sigma_upper", estimate.one_sigma.upper);
  }
  const auto add_time = [&](const std::string& name, const allan::TimedEstimate<double>& estimate) {
    result.push_back({name + "_detected", estimate.detected ? 1.0 : 0.0});
    result.push_back({name + "_value", estimate.time});
    result.push_back({name + "_lower", estimate.time_interval.lower});
    result.push_back({name + "_upper", estimate.time_interval.upper});
    result.push_back({name + "_one_sigma_lower", estimate.time});
    result.push_back({name + "_one_sigma_upper", estimate.time});
  };
  add_time("tau", analysis.noise.G);
  add_time("settling", analysis.noise.W);
  result.push_back({"adequacy", static_cast<double>(analysis.adequacy)});
  result.push_back({"descriptions", static_cast<double>(analysis.noise.descriptions.size())});
  result.push_back({"fits", analysis.noise.fits ? 1.0 : 0.0});
  result.push_back({"highest_frequency", analysis.noise.highest_frequency});
  result.push_back({"model_above", analysis.misfit.above});
  result.push_back({"model_below", analysis.misfit.below});
  result.push_back({"seconds", analysis.seconds});
  return result;
}

void identify_logs(const Options& options) {
  std::vector<double> log(options.samples * options.axes);
  for (bool first = true; read_log(log); first = false) {
    const auto row = fields(analyse(log, options));
    if (first) {
      for (const Field& field : row) std::printf("%s%s", &field == &row.front() ? "" : ",", field.name.c_str());
      std::printf("\n");
    }
    for (const Field& field : row) std::printf("%s%.9g", &field == &row.front() ? "" : ",", field.value);
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Identifies the noise of logs that follow each other on standard input: little-endian doubles without\n"
      "header, of several axes one axis after the other. Prints a csv table, one line a log: of N, K, B, Q and R\n"
      "what was found, whether the model fits, the highest frequency that was used [Hz], how far the model's Allan\n"
      "deviation is above and below the measured one at worst [standard errors], and the processor's time [s]."};
  Options options;
  app.add_option("samples", options.samples, "samples of a log and axis")
      ->required()
      ->check(CLI::Range(std::size_t{3}, std::size_t{1} << 40));
  app.add_option("rate", options.rate, "Hz")->required()->check(CLI::PositiveNumber);
  app.add_option("--axes", options.axes, "axes of a log, which are identified together")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000}));
  try {
    app.parse(argc, argv);
    identify_logs(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "identify_logs: %s\n", error.what());
    return 2;
  }
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  std::fputs("identify_logs: standard output cannot be written\n", stderr);
  return 1;
}
