// SPDX-License-Identifier: MIT
// What the grid of averaging times costs, and what it is worth: a whole curve from a log, and how far N and K that are
// fitted to it are from the truth, beside identify(), which needs no grid.

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/fit_curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study.hpp"

namespace study {
namespace {

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::allan;
using namespace splinertia::allan::detail;

using Vector = Eigen::Vector3<double>;
using Log = std::vector<double>;

/// Accelerometer of presets::course, m/s²/√Hz and m/s³/√Hz: a walk that both lengths of log are long enough to show.
constexpr double white_density = 0.019, walk_density = 5e-4;

/// What an estimator's config and a data sheet have. For all five terms the three points that a grid of tens has in the
/// short log are too few.
constexpr NoiseTerms candidates{NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::bias_instability};

struct Case {
  double rate;          // Hz
  std::size_t samples;  // of a log
  int runs;             // each gives three logs, one for each axis
  bool all;             // whether to fit a point for each averaging time: work in proportion to its square
};

/// Logs of a sensor at rest, one for each axis.
std::array<Log, 3> simulate_logs(const Case& of, std::uint64_t seed) {
  const ErrorModel model{WhiteNoise{white_density}, RandomWalk{walk_density}};
  auto state = model.start(StreamKey(seed) / "accel");
  std::array<Log, 3> logs;
  for (Log& log : logs) log.resize(of.samples);
  for (std::size_t i = 0; i < of.samples; ++i) {
    SensorSample<double> sample{Vector::Zero(), Vector::Zero(), 1 / of.rate, i == 0, static_cast<double>(i) / of.rate};
    model.apply(sample, state);
    for (std::size_t axis = 0; axis < 3; ++axis) logs[axis][i] = sample.value[static_cast<Eigen::Index>(axis)];
  }
  return logs;
}

struct Grid {
  std::string name;
  std::function<AveragingFactors(std::int64_t largest)> factors;  // up to the largest that a deviation has
};

/// Powers of ten times each of these.
Grid decades(const std::string& name, const std::vector<std::int64_t>& steps) {
  return {name, [steps](std::int64_t largest) {
            std::vector<std::int64_t> factors;
            for (std::int64_t ten = 1; ten <= largest; ten *= 10) {
              for (const std::int64_t step : steps) {
                if (ten * step <= largest) factors.push_back(ten * step);
              }
            }
            return AveragingFactors::given(std::move(factors));
          }};
}

Grid same(const std::string& name, const AveragingFactors& factors) {
  return {name, [factors](std::int64_t) { return factors; }};
}

std::vector<Grid> grids(bool all) {
  std::vector<Grid> result{decades("decade", {1}),
                           same("octave", AveragingFactors::octave()),
                           same("1-2-4", AveragingFactors::decade()),
                           decades("1-2-5", {1, 2, 5}),
                           same("logarithmic", AveragingFactors::logarithmic()),
                           same("logarithmic(10)", AveragingFactors::logarithmic(10))};
  if (all) result.push_back(same("all", AveragingFactors::all()));
  return result;
}

/// How good estimates of one coefficient are.
class Quality {
 public:
  void add(const Estimate<double>& estimate, double truth) {
    relative_.add(estimate.value / truth - 1);
    if (estimate.one_sigma.lower <= truth && truth <= estimate.one_sigma.upper) ++inside_;
    if (estimate.detected) ++detected_;
    ++count_;
  }
  [[nodiscard]] double relative_error() const { return relative_.rms(); }
  [[nodiscard]] double coverage() const { return inside_ / std::max(count_, 1.0); }  // of the one-sigma interval
  [[nodiscard]] double detected() const { return detected_ / std::max(count_, 1.0); }

 private:
  ErrorStatistics relative_;
  double inside_ = 0, detected_ = 0, count_ = 0;
};

/// One line of the table: a curve, or identify().
struct Way {
  std::string grid, deviation;
  std::size_t taus;
  std::function<void(const Log& log)> run;                           // what is timed
  std::function<NoiseEstimates<double>(const Log& log)> estimate{};  // nothing where there is none
  Quality white{}, walk{};
  std::vector<double> milliseconds{};  // of estimates
};

/// A curve of this kind. Only ADEV and OADEV can be fitted; on all averaging times OADEV alone is, which takes long.
template <Deviation D>
Way way(const Case& of, const Grid& grid) {
  const std::int64_t largest = D::largest_factor(static_cast<std::int64_t>(of.samples));
  const DeviationOptions<double> options{.factors = grid.factors(largest)};
  const auto make = [rate = of.rate, options](const Log& log) { return curve<D>(log, rate, options); };
  Way result{grid.name, std::string(D::name), options.factors.up_to(largest).size(),
             [make](const Log& log) { keep(make(log)); }};
  constexpr bool overlapping = std::same_as<D, OverlappingAllanDeviation>;
  if constexpr (overlapping || std::same_as<D, AllanDeviation>) {
    if (overlapping || grid.name != "all")
      result.estimate = [make](const Log& log) { return fit_curve(make(log), candidates); };
  }
  return result;
}

std::vector<Way> ways(const Case& of) {
  std::vector<Way> result;
  for (const Grid& grid : grids(of.all)) {
    result.push_back(way<AllanDeviation>(of, grid));
    result.push_back(way<OverlappingAllanDeviation>(of, grid));
    result.push_back(way<ModifiedAllanDeviation>(of, grid));
    result.push_back(way<HadamardDeviation>(of, grid));
    result.push_back(way<OverlappingHadamardDeviation>(of, grid));
    result.push_back(way<TotalDeviation>(of, grid));
  }
  const auto estimate = [rate = of.rate](const Log& log) { return identify(log, rate, {.candidates = candidates}); };
  result.push_back({"none", "identify", 0, [estimate](const Log& log) { keep(estimate(log)); }, estimate});
  return result;
}

/// N and K of many logs, each in all ways.
void estimate_all(const Case& of, std::vector<Way>& ways) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  for (int run = 1; run <= of.runs; ++run) {
    for (const Log& log : simulate_logs(of, static_cast<std::uint64_t>(run))) {
      for (Way& way : ways) {
        if (!way.estimate) continue;
        const auto start = std::chrono::steady_clock::now();
        const NoiseEstimates<double> estimates = way.estimate(log);
        way.milliseconds.push_back(Milliseconds(std::chrono::steady_clock::now() - start).count());
        way.white.add(estimates.N, white_density);
        way.walk.add(estimates.K, walk_density);
      }
    }
    if (run % 5 == 0 || run == of.runs) {
      progress("allan: ", of.samples, " samples, estimates of ", 3 * run, " of ", 3 * of.runs, " logs");
    }
  }
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void add_rows(Table& table, const Case& of, std::vector<Way> ways, int repetitions, std::chrono::nanoseconds least) {
  const Log log = simulate_logs(of, 0).front();
  std::vector<Kernel> kernels;
  for (const Way& way : ways) {
    kernels.push_back([&](std::size_t calls) {
      for (; calls > 0; --calls) way.run(log);
    });
  }
  const std::vector<Times> times = paired(kernels, repetitions, least);
  progress("allan: ", of.samples, " samples, times of ", ways.size(), " curves");
  estimate_all(of, ways);
  const auto samples = static_cast<double>(of.samples);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const Way& way = ways[k];
    const auto estimated = [&way](double value) { return way.estimate ? std::optional(value) : std::nullopt; };
    table.row(way.grid, way.deviation, of.samples, way.taus, times[k].min / samples, times[k].median / samples,
              times[k].max / samples, estimated(way.white.relative_error()), estimated(way.walk.relative_error()),
              estimated((way.white.coverage() + way.walk.coverage()) / 2), estimated(way.white.coverage()),
              estimated(way.walk.coverage()), estimated(way.walk.detected()),
              way.estimate ? std::optional(median(way.milliseconds)) : std::nullopt);
  }
}

}  // namespace

/// allan.csv: ns a sample of a whole curve from a log, or of identify(), and what it is worth: root mean square of the
/// relative errors of N and K (as they are, detected or not), the shares of both, of N and of K that lie in their
/// one-sigma intervals, the share of logs in which K is detected, and ms from a log to its estimates. The logs are of
/// an hour, at 200 Hz and, few enough for a point at each averaging time, at 0.25 Hz; white noise and walk are equal at
/// an averaging time of 66 s. Of 120 logs a share of 0.68 is known to 0.04.
void allan(const Options& options) {
  Table table(options.output / "allan.csv",
              {"grid", "deviation", "samples", "taus", "ns_min", "ns_median", "ns_max", "white_relative_error",
               "walk_relative_error", "coverage", "white_coverage", "walk_coverage", "walk_detected", "estimate_ms"});
  const Case short_log{0.25, options.quick ? 300U : 900U, options.quick ? 2 : 40, true};
  const Case long_log{200, options.quick ? 36'000U : 720'000U, options.quick ? 2 : 40, false};
  for (const Case& of : {short_log, long_log}) {
    add_rows(table, of, ways(of), options.repetitions, std::chrono::milliseconds(options.quick ? 1 : 5));
  }
  table.commit();
}

}  // namespace study
