// SPDX-License-Identifier: MIT
// What integration schemes cost and what they buy: nanoseconds a sample beside the error at a rate and the order with
// which it falls, on a motion that asks much of them (10 s, up to 20.7 rad/s and 129 m/s²), and beside an Euler loop
// written by hand.

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/splinertia.hpp>
#include <string>
#include <vector>

#include "../tests/strapdown/aggressive_motion.hpp"
#include "support/harness.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Vector = Eigen::Vector3d;

namespace {

using Sample = ImuSample<>;
using Increment = ImuIncrement<>;

constexpr double duration = 10;
constexpr std::array<double, 4> rates{100, 200, 400, 1000};

const testing::AggressiveMotion<double>& motion() {
  static const testing::AggressiveMotion<double> the;
  return the;
}

ImuMeasurement<double> measured(double t) { return ideal_imu(motion().evaluate<2>(t)); }

NavState<double> state_at(double t) { return nav_state(motion().evaluate<1>(t), t); }

template <typename S>
std::vector<S> samples(double rate);

template <>
std::vector<Sample> samples<Sample>(double rate) {
  std::vector<Sample> result;
  for (int i = 0; i <= static_cast<int>(duration * rate); ++i) {
    const double t = i / rate;
    const auto [gyro, accel] = measured(t);
    result.push_back({t, gyro, accel});
  }
  return result;
}

/// The integrals over each interval by Gauss' rule with 5 nodes, error O(h¹¹).
template <>
std::vector<Increment> samples<Increment>(double rate) {
  constexpr std::array<double, 5> nodes{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                        0.9061798459386640},
      weights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  std::vector<Increment> result;
  for (int i = 1; i <= static_cast<int>(duration * rate); ++i) {
    Increment increment{i / rate, Vector::Zero(), Vector::Zero()};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto [gyro, accel] = measured((i - 0.5 + nodes[k] / 2) / rate);
      increment.delta_angle += weights[k] / (2 * rate) * gyro;
      increment.delta_velocity += weights[k] / (2 * rate) * accel;
    }
    result.push_back(increment);
  }
  return result;
}

template <typename Scheme>
using SampleOf = std::conditional_t<Scheme::takes_increments, Increment, Sample>;

/// The largest position error, m.
template <typename Scheme>
double error(double rate) {
  double largest = 0;
  integrate<Scheme>(state_at(0), samples<SampleOf<Scheme>>(rate), standard_gravity<double>(),
                    [&](const NavState<double>& state) {
                      const Vector truth = position(motion().evaluate<0>(state.time).value);
                      largest = std::max(largest, (state.p_WB - truth).norm());
                    });
  return largest;
}

template <typename S>
const std::vector<S>& thousand() {
  static const std::vector<S> the = samples<S>(1000);
  return the;
}

/// Runs of an Integrator over the same samples again and again.
template <typename Scheme>
void run_scheme(std::size_t calls) {
  const auto& all = thousand<SampleOf<Scheme>>();
  while (calls > 0) {
    const std::size_t n = std::min(calls, all.size());
    Integrator<Scheme, double> integrator(state_at(0));
    for (std::size_t i = 0; i < n; ++i) integrator.push(all[i]);
    benchmark::keep(integrator.state());
    calls -= n;
  }
}

/// What people write: Euler's method with Sophus' exponential on a loop over a vector.
void run_by_hand(std::size_t calls) {
  const auto& all = thousand<Sample>();
  const Vector gravity(0, 0, -9.80665);
  while (calls > 0) {
    const std::size_t n = std::min(calls, all.size());
    const auto initial = state_at(0);
    Sophus::SO3d R = initial.R_WB;
    Vector v = initial.v_WB, p = initial.p_WB;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double dt = all[i + 1].time - all[i].time;
      const Vector a = R * all[i].accel + gravity;
      p += v * dt + 0.5 * a * dt * dt;
      v += a * dt;
      R = R * Sophus::SO3d::exp(all[i].gyro * dt);
    }
    benchmark::keep(p);
    benchmark::keep(R);
    calls -= n;
  }
}

template <typename Noise>
void run_preintegration(std::size_t calls) {
  const auto& all = thousand<Sample>();
  while (calls > 0) {
    const std::size_t n = std::min<std::size_t>(calls, 200);
    const auto noise = [] {
      if constexpr (std::is_same_v<Noise, Noiseless>) {
        return Noiseless{};
      } else {
        return Noise{1e-3, 1e-2, 1e-5, 1e-4};
      }
    }();
    Preintegrator preintegrator(Midpoint{}, 0.0, ImuBias<>{}, noise);
    for (std::size_t i = 0; i < n; ++i) preintegrator.push(all[i]);
    benchmark::keep(preintegrator.result());
    calls -= n;
  }
}

struct Scheme {
  benchmark::Kernel kernel;
  double (*error)(double rate);  // nothing for what is no scheme
};

template <typename S>
Scheme scheme(const char* name) {
  return {{name, run_scheme<S>}, error<S>};
}

const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> table{
      {{"euler_by_hand", run_by_hand}, nullptr},
      scheme<Euler>("euler"),
      scheme<ZeroOrderHold>("zero_order_hold"),
      scheme<Midpoint>("midpoint"),
      scheme<Trapezoid>("trapezoid"),
      scheme<RungeKutta4>("runge_kutta4"),
      scheme<RungeKutta4DoubleStep>("runge_kutta4_double_step"),
      scheme<Magnus4>("magnus4"),
      scheme<UncorrectedIncrements>("uncorrected_increments"),
      scheme<RotationCorrectedIncrements>("rotation_corrected_increments"),
      scheme<TwoSampleIncrements>("two_sample_increments"),
      scheme<ThreeSampleIncrements>("three_sample_increments"),
      {{"preintegration", run_preintegration<Noiseless>}, nullptr},
      {{"preintegration_with_covariance", run_preintegration<ImuNoise<double>>}, nullptr}};
  return table;
}

/// The slope of log error over log interval, by least squares over all rates.
double order(const std::array<double, rates.size()>& errors) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = rates.size();
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double u = -std::log(rates[i]), v = std::log(errors[i]);
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// The accuracy-per-nanosecond table, all schemes in turn.
void print_table(bool csv, std::size_t calls) {
  std::vector<benchmark::Kernel> kernels;
  for (const Scheme& s : schemes()) kernels.push_back(s.kernel);
  const auto times = benchmark::measure_in_turn(kernels, calls);
  if (!csv) {
    std::puts("\nIn turn                           ns a sample                       largest position error [m] at");
    std::puts(
        "                               min  median     max  of Euler     100 Hz     200 Hz     400 Hz    1000 Hz  "
        "order");
  }
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    const std::string& name = kernels[k].name;
    const double ratio = times[k].min / times[0].min;
    if (!csv) {
      std::printf("%-29s %5.1f %7.1f %7.1f %9.2f", name.c_str(), times[k].min, times[k].median, times[k].max, ratio);
    }
    benchmark::figure(csv, "ns_" + name, times[k].min, "ns");
    benchmark::figure(csv, "ns_median_" + name, times[k].median, "ns");
    benchmark::figure(csv, "of_euler_by_hand_" + name, ratio, "1");
    if (schemes()[k].error) {
      std::array<double, rates.size()> errors;
      for (std::size_t i = 0; i < rates.size(); ++i) {
        errors[i] = schemes()[k].error(rates[i]);
        if (!csv) std::printf(" %10.3g", errors[i]);
        benchmark::figure(csv, "error_" + name + "_" + std::to_string(static_cast<int>(rates[i])) + "_Hz", errors[i],
                          "m");
      }
      if (!csv) std::printf(" %6.2f", order(errors));
      benchmark::figure(csv, "order_" + name, order(errors), "1");
    }
    if (!csv) std::puts("");
  }
}

/// The samples at each rate with the truth, for programs that are compared: t, gyro, accel, p, v, q (w x y z).
void write_samples(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const double rate : rates) {
    AtomicFile file(folder / (std::to_string(static_cast<int>(rate)) + ".csv"));
    for (const Sample& sample : samples<Sample>(rate)) {
      const NavState<double> state = state_at(sample.time);
      const Eigen::Quaterniond& q = state.R_WB.unit_quaternion();
      file.append_real(sample.time);
      for (const Vector& v : {sample.gyro, sample.accel, state.p_WB, state.v_WB}) {
        for (const double x : v) {
          file.append(',');
          file.append_real(x);
        }
      }
      for (const double x : {q.w(), q.x(), q.y(), q.z()}) {
        file.append(',');
        file.append_real(x);
      }
      file.append('\n');
    }
    file.commit();
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<benchmark::Kernel> kernels;
  for (const Scheme& s : schemes()) kernels.push_back(s.kernel);
  benchmark::Extension extension;
  std::filesystem::path folder;
  extension.options = [&](CLI::App& app) {
    app.add_option("--write-samples", folder,
                   "only write the samples and the truth to this folder, for strapdown_gtsam.py");
  };
  extension.instead = [&]() -> std::optional<int> {
    if (folder.empty()) return std::nullopt;
    write_samples(folder);
    return 0;
  };
  extension.figures = print_table;
  return benchmark::run(argc, argv, "What integration schemes cost, and what they buy.", kernels, extension);
}
