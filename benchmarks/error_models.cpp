// SPDX-License-Identifier: MIT
// What sensor errors cost: each term, beside the same loop written by hand; a full sensor, beside one with the normal
// numbers of <random>; and the memory of long runs.
//
// NAME is the library, NAME_by_hand the same arithmetic on plain vectors with constants computed before the loop; both
// add up all readings, and must come to the same sums. apply_… applies the errors of one sensor to measurements that
// are in memory; simulate_… is a whole simulate() of both sensors on a cubic spline on SO(3) × R³ at 200 Hz.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <splinertia/splinertia.hpp>

#include "error_models/by_hand.hpp"
#include "error_models/workload.hpp"
#include "support/overhead.hpp"

namespace {

// The library.

template <typename Model>
[[gnu::noinline]] void apply_model(const Model& given, std::size_t calls, Sums& result) {
  const Model model = given;
  auto state = model.start(run_key / "gyro");
  const double interval = 1 / rate();
  const Vector* measurements = workload().measurements.data();
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < calls; ++i) {
    const Vector& x = measurements[i % 4096];
    ImuSensorSample<double> sample{{x, Vector::Zero(), interval, i == 0, static_cast<double>(i) * interval}, {x, x}};
    model.apply(sample, state);
    sum += sample.value;
  }
  result.gyro += sum;
}

template <typename Model>
[[gnu::noinline]] void simulate_model(const Model& model, std::size_t calls, Sums& result) {
  Sums sums;
  const double end = (static_cast<double>(calls) - 0.5) / rate();
  for (const auto& r : simulate(curve(), Imu{model, model}, {.rate = rate(), .seed = 0, .end = end})) {
    sums.gyro += r.gyro;
    sums.accel += r.accel;
  }
  result.gyro += sums.gyro;
  result.accel += sums.accel;
}

struct Loop {
  std::string name;
  std::function<void(std::size_t calls, Sums& sums)> run;

  [[nodiscard]] Sums sums(std::size_t calls) const {
    Sums result;
    for (; calls > 0; calls -= std::min(calls, longest_run)) run(std::min(calls, longest_run), result);
    return result;
  }
  [[nodiscard]] benchmark::Kernel kernel() const {
    return {name, [loop = *this](std::size_t calls) { benchmark::keep(loop.sums(calls)); }};
  }
};

/// How many more instructions than by hand the library may have: as elsewhere, but with nothing to do, next to none.
benchmark::Tolerance tolerance(bool whole, bool no_errors) {
#ifdef __clang__
  constexpr double of_simulate = 0.08, of_no_errors = 0.04;  // clang++-14 moves more between registers and the stack
#else
  constexpr double of_simulate = 0.02, of_no_errors = 0.001;
#endif
  if (no_errors) return {.part = whole ? of_no_errors : 0.001, .few = 0};
  if (whole) return {.part = of_simulate, .few = 0};
  return {};
}

benchmark::Pair pair(const Loop& library, const Loop& by_hand, const benchmark::Tolerance& tolerance) {
  return {library.kernel(),
          by_hand.kernel(),
          [library, by_hand] {
            constexpr std::size_t calls = 3000;
            const Sums a = library.sums(calls), b = by_hand.sums(calls);
            return ((a.gyro - b.gyro).norm() + (a.accel - b.accel).norm()) / (1e-12 * calls);
          },
          {},
          tolerance};
}

template <typename ByHand>
void add_pairs(std::vector<benchmark::Pair>& pairs, const std::string& name, const auto& model,
               std::optional<benchmark::Tolerance> of_apply = std::nullopt) {
  constexpr bool no_errors = std::is_same_v<ByHand, NoErrorsByHand>;
  pairs.push_back(pair({"apply_" + name, [model](std::size_t n, Sums& s) { apply_model(model, n, s); }},
                       {"apply_" + name + "_by_hand", [](std::size_t n, Sums& s) { apply_by_hand<ByHand>(n, s); }},
                       of_apply.value_or(tolerance(false, no_errors))));
  pairs.push_back(
      pair({"simulate_" + name, [model](std::size_t n, Sums& s) { simulate_model(model, n, s); }},
           {"simulate_" + name + "_by_hand", [](std::size_t n, Sums& s) { simulate_by_hand<ByHand>(n, s); }},
           tolerance(true, no_errors)));
}

const std::vector<benchmark::Pair>& pairs() {
  static const std::vector<benchmark::Pair> the = [] {
    std::vector<benchmark::Pair> all;
    add_pairs<NoErrorsByHand>(all, "no_errors", ErrorModel{});
    add_pairs<ConstantBiasByHand>(all, "constant_bias", ErrorModel{ConstantBias{opaque(0.1, 0.2, 0.3)}});
    add_pairs<MisalignmentByHand>(all, "misalignment", ErrorModel{Misalignment{misalignment()}});
    add_pairs<SaturationByHand>(all, "saturation", ErrorModel{Saturation{opaque(1.5, 2, 2.5)}});
    add_pairs<WhiteNoiseByHand>(all, "white_noise", ErrorModel{WhiteNoise{density}});
    add_pairs<RandomWalkByHand>(all, "random_walk", ErrorModel{RandomWalk{density}});
    add_pairs<GaussMarkovByHand>(all, "gauss_markov", ErrorModel{GaussMarkov{deviation, correlation_time}});
    add_pairs<WhiteNoiseRandomWalkByHand>(all, "white_noise_random_walk",
                                          ErrorModel{WhiteNoise{density}, RandomWalk{density}},
                                          // g++ 12 at -O3 decides for this whole file. It needs 204 instructions
                                          // here (by hand 195.5), and 186 before simulate() changed, although
                                          // nothing that apply() calls did: in a program of its own, the loop has
                                          // exactly as many instructions as before.
                                          benchmark::Tolerance{.part = 0.05});
    return all;
  }();
  return the;
}

/// Terms that nobody would write by hand: their costs alone.
std::vector<Loop> further_terms() {
  std::vector<Loop> loops;
  const auto add = [&](const std::string& name, const auto& term) {
    loops.push_back(
        {"apply_" + name, [model = ErrorModel{term}](std::size_t n, Sums& s) { apply_model(model, n, s); }});
  };
  add("turn_on_bias", TurnOnBias{0.1});
  add("rate_ramp", RateRamp{0.001});
  add("bias_instability", BiasInstability{0.1});
  add("scale_factor", ScaleFactor{0.01});
  add("g_sensitivity", GSensitivity{misalignment()});
  add("quantization", Quantization{0.001});
  add("quantization_noise", QuantizationNoise{0.001});
  add("first_order_bandwidth", FirstOrderBandwidth{50.0});
  add("second_order_bandwidth", SecondOrderBandwidth{50.0, 0.7});
  add("sinusoidal_vibration", SinusoidalVibration{0.1, 30.0});
  add("random_vibration", RandomVibration{0.1, 30.0, 0.1});
  return loops;
}

// A full sensor: six axes, each with white noise and a random walk, twelve normal numbers a sample.

void full_sensor(std::size_t calls) {
  const ErrorModel model{WhiteNoise{density}, RandomWalk{density}};
  auto gyro_state = model.start(run_key / "gyro"), accel_state = model.start(run_key / "accel");
  const double interval = 1 / rate();
  const Vector* measurements = workload().measurements.data();
  Sums sums;
  for (std::size_t i = 0; i < calls; ++i) {
    const Vector& x = measurements[i % 4096];
    ImuSensorSample<double> gyro{{x, Vector::Zero(), interval, i == 0, static_cast<double>(i) * interval}, {x, x}},
        accel = gyro;
    model.apply(gyro, gyro_state);
    model.apply(accel, accel_state);
    sums.gyro += gyro.value;
    sums.accel += accel.value;
  }
  benchmark::keep(sums);
}

void full_sensor_with_std(std::size_t calls) {
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  const double white = density * std::sqrt(rate()), walk = density / std::sqrt(rate());
  const Vector* measurements = workload().measurements.data();
  Sums sums, bias;
  const auto axis = [&](double x, double& b) {
    const double result = x + white * normal(bits) + b;
    b += walk * normal(bits);
    return result;
  };
  for (std::size_t i = 0; i < calls; ++i) {
    const Vector& x = measurements[i % 4096];
    for (int k = 0; k < 3; ++k) sums.gyro[k] += axis(x[k], bias.gyro[k]);
    for (int k = 0; k < 3; ++k) sums.accel[k] += axis(x[k], bias.accel[k]);
  }
  benchmark::keep(sums);
}

void twelve_normals(std::size_t calls) {
  Normals a(run_key / 0), b(run_key / 1), c(run_key / 2), d(run_key / 3);
  Sums sums;
  for (std::size_t i = 0; i < calls; ++i) {
    sums.gyro += a() + b();
    sums.accel += c() + d();
  }
  benchmark::keep(sums);
}

void print_speeds(bool csv, std::size_t calls) {
  const auto times = benchmark::measure_in_turn({{"full_sensor", full_sensor},
                                                 {"full_sensor_with_std", full_sensor_with_std},
                                                 {"twelve_normals", twelve_normals},
                                                 {"simulate", pairs().back().library.run}},
                                                calls);
  const auto &library = times[0], &with_std = times[1], &normals = times[2], &whole = times[3];
  const auto line = [&](const char* name, const char* text, double value, double median, const char* unit) {
    benchmark::figure(csv, name, value, unit);
    benchmark::figure(csv, std::string(name) + "_median", median, unit);
    if (!csv) std::printf("%-62s %10.3g, median %.3g\n", text, value, median);
  };
  if (!csv) std::printf("\nA full sensor: six axes, white noise and random walk, twelve normal numbers a sample\n");
  line("samples_per_second", "samples a second", 1e9 / library.min, 1e9 / library.median, "1/s");
  line("std_samples_per_second", "the same loop with std::mt19937_64 and normal_distribution", 1e9 / with_std.min,
       1e9 / with_std.median, "1/s");
  line("simulate_samples_per_second", "simulate() with it on a spline", 1e9 / whole.min, 1e9 / whole.median, "1/s");
  line("speedup_vs_std", "times as fast as with <random>", with_std.min / library.min, with_std.median / library.median,
       "1");
  line("fraction_of_normals_bound", "speed over that of drawing the normal numbers alone", normals.min / library.min,
       normals.median / library.median, "1");
}

/// Peak resident memory of a process that makes so many samples, KiB.
long peak_memory(double samples) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const ErrorModel model{WhiteNoise{density}, RandomWalk{density}};
    Vector sum = Vector::Zero();
    for (const auto& r : simulate(at_rest(SO3xR3<double>{}), Imu{model, model},
                                  {.rate = rate(), .start = 0.0, .end = (samples - 0.5) / rate()})) {
      sum += r.gyro + r.accel;
    }
    benchmark::keep(sum);
    _exit(0);
  }
  rusage usage{};
  int status = 0;
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) return -1;
  return usage.ru_maxrss;
}

void print_memory(bool csv, bool long_run) {
  if (!csv) std::printf("\nPeak memory of a process that iterates simulate() at rest\n");
  for (const auto& [name, samples] : {std::pair("1e3", 1e3), std::pair("1e6", 1e6), std::pair("1e8", 1e8)}) {
    if (samples > 1e6 && !long_run) continue;
    const auto memory = static_cast<double>(peak_memory(samples));
    benchmark::figure(csv, std::string("peak_memory_") + name + "_samples", memory, "KiB");
    if (!csv) std::printf("%s samples %8.0f KiB\n", name, memory);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<benchmark::Kernel> kernels = benchmark::kernels_of(pairs());
  for (const Loop& loop : further_terms()) kernels.push_back(loop.kernel());
  curve();

  bool long_run = false;
  benchmark::OverheadOptions overhead;
  return benchmark::run(argc, argv, "Costs of sensor errors.", kernels,
                        {.options =
                             [&](CLI::App& app) {
                               overhead.add(app);
                               app.add_flag("--memory", long_run, "memory of a run of 1e8 samples, too");
                             },
                         .instead = [&] { return overhead.run(pairs(), "sample"); },
                         .figures =
                             [&](bool csv, std::size_t calls) {
                               print_speeds(csv, calls);
                               print_memory(csv, long_run);
                             }});
}
