// SPDX-License-Identifier: MIT
// What Allan analysis costs: nanoseconds a sample and averaging time, beside what memory and the vector unit allow, and
// its memory. And what it is worth: its rounding errors against exact integers, and how far estimates of noise terms
// are from the truth, beside the least that any estimate could be.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/expected_accuracy.hpp>
#include <splinertia/allan/fit_curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <splinertia/allan/record/steps.hpp>
#include <splinertia/allan/streaming.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/bias_instability.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/random/normal.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "support/harness.hpp"

using namespace splinertia;
using namespace splinertia::allan;
using Factors = std::vector<std::int64_t>;
using Signals = std::array<std::vector<double>, 3>;

namespace {

constexpr double rate = 200;  // Hz
constexpr std::size_t two_hours = 1'440'000;

struct Settings {
  std::size_t samples = 1'000'000;
  int repetitions = 9;
  bool huge = false;
  bool accuracy = false;
  bool statistics = false;
  int runs = 200;
  std::string only_case;
  std::filesystem::path written, analysed;
};

/// White noise about an offset.
std::vector<double> white_signal(std::size_t n) {
  NormalStream<> normal(StreamKey(1) / "white");
  std::vector<double> y(n);
  for (double& value : y) value = 9.81 + 0.01 * normal();
  return y;
}

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
    streams += static_cast<double>(chain.places.size() + 1);
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

// Memory.

struct Usage {
  double input, peak, seconds;  // MiB
};

double peak_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Of a process that analyses so many samples.
std::optional<Usage> usage_of(std::size_t n, void (*work)(const std::vector<double>& y)) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const std::vector<double> y = white_signal(n);
    Usage usage{peak_now(), 0, 0};
    const auto start = std::chrono::steady_clock::now();
    work(y);
    usage.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    usage.peak = peak_now();
    _exit(write(ends[1], &usage, sizeof usage) == sizeof usage ? 0 : 1);
  }
  close(ends[1]);
  Usage usage{};
  const bool got = read(ends[0], &usage, sizeof usage) == sizeof usage;
  close(ends[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0 || !got) return std::nullopt;
  return usage;
}

void print_memory(bool csv, const Settings& settings) {
  const auto print = [&](const std::string& name, std::size_t n, void (*work)(const std::vector<double>&)) {
    const auto usage = usage_of(n, work);
    if (!usage) throw std::runtime_error("no process could be started, or it failed");
    const double input = static_cast<double>(n) * 8 / (1 << 20);
    const double share = (usage->peak - usage->input) / input;
    benchmark::figure(csv, "memory_" + name, share, "1");
    benchmark::figure(csv, "peak_memory_" + name, usage->peak, "MiB");
    benchmark::figure(csv, "process_" + name + "_s", usage->seconds, "s");
    if (!csv) {
      std::printf("%-20s %9.3g samples: %8.2f times the input beyond it, peak of the process %7.1f MiB, %.2f s\n",
                  name.c_str(), static_cast<double>(n), share, usage->peak, usage->seconds);
    }
  };
  if (!csv) std::printf("\nMemory of a process of its own\n");
  const auto oadev = [](const std::vector<double>& y) { benchmark::keep(allan::overlapping(y, rate)); };
  print("overlapping", settings.samples, oadev);
  print("identify", settings.samples, [](const std::vector<double>& y) { benchmark::keep(identify(y, rate)); });
  if (settings.huge) print("overlapping_1e8", 100'000'000, oadev);
}

// Accuracy, against integers.

/// Σ over i = 0, stride … of the squared second differences.
long double exact_sum(const std::vector<std::int64_t>& phase, std::int64_t m, std::int64_t stride) {
  __extension__ using Integer = __int128;
  Integer sum = 0;
  const auto end = static_cast<std::int64_t>(phase.size()) - 2 * m;
  const std::int64_t* p = phase.data();
  for (std::int64_t i = 0; i < end; i += stride) {
    const std::int64_t difference = p[i + 2 * m] - 2 * p[i + m] + p[i];
    sum += static_cast<Integer>(difference) * difference;
  }
  return static_cast<long double>(sum);
}

int check_accuracy(bool csv, const Settings& settings) {
  constexpr double lsb = 1e-3, deviation = 1e-3, offset = 9.81;
  constexpr std::int64_t mean = 9810;
  constexpr double goal = 1e-9;
  const std::size_t n = settings.samples;
  std::vector<double> y(n);
  std::vector<std::int64_t> phase(n + 1);
  NormalStream<> normal(StreamKey(2) / "white");
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t k = std::llround((offset + deviation * normal()) / lsb);
    y[i] = static_cast<double>(k) * lsb;
    phase[i + 1] = phase[i] + (k - mean);
  }
  double worst = 0, worst_streaming = 0;
  if (!csv) std::printf("%zu samples of %g with noise of %g, LSB %g\n", n, offset, deviation, lsb);
  const auto compare = [&](const char* name, const CurvePoint<double>& point, std::int64_t stride, double& largest) {
    const long double sum = exact_sum(phase, point.factor, stride);
    const auto m = static_cast<long double>(point.factor);
    const long double exact =
        std::sqrt(sum / (2 * static_cast<long double>(point.terms))) / m * static_cast<long double>(lsb);
    const auto error = static_cast<double>(std::abs(static_cast<long double>(point.deviation) / exact - 1));
    largest = std::max(largest, error);
    if (!csv) {
      std::printf("%-10s m = %9lld: %.15g, relative error %.1e\n", name, static_cast<long long>(point.factor),
                  point.deviation, error);
    }
  };
  for (const auto& point : allan::overlapping(y, rate).points) compare("oadev", point, 1, worst);
  StreamingAllanDeviation<double> streaming(rate);
  for (const double value : y) streaming.push(value);
  for (const auto& point : streaming.curve().points)
    compare("streaming", point, std::max<std::int64_t>(1, point.factor / 16), worst_streaming);
  benchmark::figure(csv, "worst_error_oadev", worst, "1");
  benchmark::figure(csv, "worst_error_streaming", worst_streaming, "1");
  if (!csv) std::printf("worst relative error: oadev %.2e, streaming %.2e\n", worst, worst_streaming);
  return worst <= goal && worst_streaming <= goal ? 0 : 1;
}

// Statistics of estimates.

struct Case {
  const char* name;
  double N, K, B;
  [[nodiscard]] double truth(NoiseTerm term) const {
    return std::array<double, 5>{N, K, B, 0, 0}[static_cast<std::size_t>(term)];
  }
};

constexpr std::array<Case, 9> cases{{{"N15e3_K5e5", 0.015, 5e-5, 0},
                                     {"N5e3_K1e5", 0.005, 1e-5, 0},
                                     {"N19e3_K5e4", 0.019, 5e-4, 0},
                                     {"N19e3_K1e4", 0.019, 1e-4, 0},
                                     {"N3e4_K1e4", 3e-4, 1e-4, 0},
                                     {"N15e3_K1e5", 0.015, 1e-5, 0},
                                     {"N5e3_B1e3", 0.005, 0, 1e-3},
                                     {"N5e3_K1e4_B1e3", 0.005, 1e-4, 1e-3},
                                     {"N5e3", 0.005, 0, 0}}};

template <typename... Terms>
Signals simulate_terms(const ErrorModel<Terms...>& model, std::size_t n, std::uint64_t seed) {
  using Vector = Eigen::Vector3d;
  auto state = model.start(StreamKey(seed) / "gyro");
  Signals signals;
  for (auto& signal : signals) signal.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    SensorSample<double> sample{Vector::Zero(), Vector::Zero(), 1 / rate, i == 0, static_cast<double>(i) / rate};
    model.apply(sample, state);
    for (std::size_t axis = 0; axis < 3; ++axis) signals[axis][i] = sample.value[static_cast<Eigen::Index>(axis)];
  }
  return signals;
}

Signals simulate_case(const Case& of, std::size_t n, std::uint64_t seed) {
  const WhiteNoise white{of.N};
  const RandomWalk walk{of.K};
  if (of.B > 0) return simulate_terms(ErrorModel{white, walk, BiasInstability{of.B}}, n, seed);
  return simulate_terms(ErrorModel{white, walk}, n, seed);
}

struct Estimates {
  std::array<NoiseEstimates<double>, 3> identified, fitted;  // one for each axis
};

/// All runs of a case, on two processors.
std::vector<Estimates> estimate_case(const Case& of, std::size_t n, int runs, std::uint64_t first_seed) {
  std::vector<Estimates> results(static_cast<std::size_t>(runs));
  std::atomic<std::size_t> next = 0;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto work = [&] {
    for (std::size_t run; (run = next++) < results.size();) {
      const Signals signals = simulate_case(of, n, first_seed + run);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const IntegratedSignal x(signals[axis], rate);
        results[run].identified[axis] = identify(x);
        results[run].fitted[axis] = fit_curve(curve<OverlappingAllanDeviation>(x));
      }
      if (terminal) std::fprintf(stderr, "\r%s: run %zu of %d ", of.name, run + 1, runs);
    }
  };
  std::thread other(work);
  work();
  other.join();
  if (terminal) std::fprintf(stderr, "\r%40s\r", "");
  return results;
}

/// Of one coefficient over all logs, in units of the truth.
void print_estimates(bool csv, const std::string& name, double truth, const std::vector<Estimate<double>>& estimates,
                     std::optional<double> bound) {
  const auto n = static_cast<double>(estimates.size());
  double sum = 0, squares = 0, detected = 0, one = 0, wide = 0, limits = 0, undetected_limits = 0;
  for (const auto& estimate : estimates) {
    if (estimate.detected) ++detected;
    if (truth <= 0) continue;
    sum += estimate.value / truth;
    squares += (estimate.value / truth) * (estimate.value / truth);
    if (estimate.one_sigma.lower <= truth && truth <= estimate.one_sigma.upper) ++one;
    if (estimate.interval.lower <= truth && truth <= estimate.interval.upper) ++wide;
    if (truth <= estimate.interval.upper) ++limits;
    if (truth <= estimate.interval.upper && !estimate.detected) ++undetected_limits;
  }
  benchmark::figure(csv, name + "_detected", detected / n, "1");
  if (truth <= 0) {
    if (!csv) std::printf("  %-24s not there, detected in %.1f %%\n", name.c_str(), 100 * detected / n);
    return;
  }
  const double mean = sum / n, spread = std::sqrt(std::max(0.0, squares / n - mean * mean) * n / (n - 1));
  benchmark::figure(csv, name + "_mean", mean, "1");
  benchmark::figure(csv, name + "_std", spread, "1");
  if (bound) benchmark::figure(csv, name + "_std_over_bound", spread / *bound, "1");
  benchmark::figure(csv, name + "_within_one_sigma", one / n, "1");
  benchmark::figure(csv, name + "_within_95", wide / n, "1");
  benchmark::figure(csv, name + "_limits_hold", limits / n, "1");
  if (csv) return;
  std::printf("  %-24s mean %.4f +- %.5f", name.c_str(), mean, spread);
  bound ? std::printf(" (%.3f of the bound)", spread / *bound) : std::printf("%21s", "");
  std::printf(", within 1 sigma %.1f %%, 95 %%: %.1f %%, detected %.1f %%, limits hold %.1f %%", 100 * one / n,
              100 * wide / n, 100 * detected / n, 100 * limits / n);
  if (detected < n) std::printf(", of undetected %.1f %%", 100 * undetected_limits / (n - detected));
  std::printf("\n");
}

void print_statistics(bool csv, const Settings& settings) {
  const std::size_t n = settings.samples;
  const double duration = static_cast<double>(n) / rate;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case& of = cases[k];
    if (std::string_view(of.name).find(settings.only_case) == std::string_view::npos) continue;
    const auto results = estimate_case(of, n, settings.runs, 1'000'000 * k);
    if (!csv) {
      std::printf("N = %g, K = %g, B = %g: %d logs of %.2f h at %g Hz\n", of.N, of.K, of.B, 3 * settings.runs,
                  duration / 3600, rate);
    }
    for (const auto& [how, which] :
         {std::pair("identify", &Estimates::identified), std::pair("fit_curve", &Estimates::fitted)}) {
      for (const NoiseTerm term : noise_terms) {
        std::vector<Estimate<double>> estimates;
        for (const Estimates& result : results) {
          for (const auto& axis : result.*which) estimates.push_back(axis[term]);
        }
        std::optional<double> bound;
        if (of.K > 0 && of.B <= 0) {
          const auto expected = expected_accuracy(rate, duration, of.N, of.K);
          if (term == NoiseTerm::white) bound = expected.N;
          if (term == NoiseTerm::random_walk) bound = expected.K;
        }
        const std::string prefix = csv ? std::string(of.name) + "_" : std::string();
        print_estimates(csv, prefix + how + "_" + std::string(symbol(term)), of.truth(term), estimates, bound);
      }
    }
    std::fflush(stdout);
  }
}

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
