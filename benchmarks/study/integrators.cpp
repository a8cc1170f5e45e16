// SPDX-License-Identifier: MIT
// Error against time of the schemes of strapdown integration: three motions, six rates, with exact samples and with
// those of sensors of three grades.

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <splinertia/imu/presets.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "scenes.hpp"
#include "study.hpp"

namespace study {
namespace {

using namespace splinertia;

using State = NavState<double>;
using Point = ImuSample<>;
using Increment = ImuIncrement<>;

constexpr double duration = 10;  // s

/// What an IMU delivers of one run in both ways, and the truth.
struct Run {
  double rate;  // Hz
  std::vector<Point> points;
  std::vector<Increment> increments;
  std::vector<State> truth;  // at the times of the points
};

/// Exact samples. Increments are integrals by Gauss' rule with 5 nodes, whose error falls with the 11th power of the
/// interval: 1e-9 of the fastest motion here at 50 Hz.
Run exact_run(const Scene& scene, double rate) {
  constexpr std::array<double, 5> nodes{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                        0.9061798459386640},
      weights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  Run run{rate, {}, {}, {}};
  for (int i = 0; i <= static_cast<int>(duration * rate); ++i) {
    const double t = i / rate;
    const auto motion = scene.evaluate<2>(t);
    const auto [gyro, accel] = ideal_imu(motion);
    run.points.push_back({t, gyro, accel});
    run.truth.push_back(nav_state(motion, t));
    if (i == 0) continue;
    Increment increment{t, Eigen::Vector3<double>::Zero(), Eigen::Vector3<double>::Zero()};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto within = ideal_imu(scene.evaluate<2>((i - 0.5 + nodes[k] / 2) / rate));
      increment.delta_angle += weights[k] / (2 * rate) * within.gyro;
      increment.delta_velocity += weights[k] / (2 * rate) * within.accel;
    }
    run.increments.push_back(increment);
  }
  return run;
}

/// The same run with the errors of a sensor: an increment gets those of a sample of its mean, which for white noise of
/// density N are N·√interval, as they are for the integral of a point sample.
template <typename Sensors>
Run noisy_run(const Run& exact, const Sensors& sensors, std::uint64_t seed) {
  Run run = exact;
  const double interval = 1 / exact.rate;
  using Errors = ImuErrors<Sensors, double, double>;
  typename Errors::Reading reading;
  Errors of_points(sensors, StreamKey(seed)), of_increments(sensors, StreamKey(seed));
  for (Point& point : run.points) {
    of_points.apply(point.time, {point.gyro, point.accel}, interval, reading);
    point.gyro = reading.gyro;
    point.accel = reading.accel;
  }
  for (Increment& increment : run.increments) {
    of_increments.apply(increment.time, {increment.delta_angle / interval, increment.delta_velocity / interval},
                        interval, reading);
    increment.delta_angle = reading.gyro * interval;
    increment.delta_velocity = reading.accel * interval;
  }
  return run;
}

/// See within_run() of an Imu.
template <typename Term>
inline constexpr bool is_left_out = false;
template <typename Scalar, int N>
inline constexpr bool is_left_out<TurnOnBias<Scalar, N>> = true;
template <typename Scalar, int N>
inline constexpr bool is_left_out<Saturation<Scalar, N>> = true;

/// A model without the terms that are left out.
template <typename... Terms>
auto within_run(const ErrorModel<Terms...>& model) {
  const auto kept = std::apply(
      [](const auto&... terms) {
        return std::tuple_cat([&] {
          if constexpr (is_left_out<std::remove_cvref_t<decltype(terms)>>) {
            return std::tuple<>();
          } else {
            return std::make_tuple(terms);
          }
        }()...);
      },
      model.terms());
  return std::apply([](const auto&... terms) { return ErrorModel(terms...); }, kept);
}

/// A preset as it is within a run: without the turn-on bias, which whoever integrates has estimated, and without
/// saturation, since the tactical unit's range of ±400 °/s is less than the drone turns.
template <typename Gyro, typename Accel>
auto within_run(const Imu<Gyro, Accel>& preset) {
  return Imu{within_run(preset.gyro), within_run(preset.accel)};
}

struct Grade {
  std::string name;
  std::function<Run(const Run& exact, std::uint64_t seed)> noisy;
};

template <typename Sensors>
Grade grade(const std::string& name, const Sensors& preset) {
  return {name, [sensors = within_run(preset)](const Run& exact, std::uint64_t seed) {
            return noisy_run(exact, sensors, seed);
          }};
}

/// The sources of their figures are in presets.hpp.
std::vector<Grade> grades() {
  return {grade("consumer", presets::mpu6050), grade("industrial", presets::adis16448),
          grade("tactical", presets::stim300)};
}

/// Errors over one run; those of several are added up as squares.
struct Errors {
  ErrorStatistics position, orientation, velocity;  // m, rad, m/s

  void add(const State& state, const State& truth) {
    position.add((state.p_WB - truth.p_WB).norm());
    velocity.add((state.v_WB - truth.v_WB).norm());
    const Eigen::Quaterniond off = truth.R_WB.unit_quaternion().conjugate() * state.R_WB.unit_quaternion();
    orientation.add(2 * std::atan2(off.vec().norm(), std::abs(off.w())));
  }
};

struct Scheme {
  std::string name;
  Errors (*errors)(const Run& run);
  void (*integrate)(const Run& run);  // what is timed
};

template <typename S>
const auto& samples_for(const Run& run) {
  if constexpr (S::takes_increments) {
    return run.increments;
  } else {
    return run.points;
  }
}

template <typename S>
Scheme scheme(const std::string& name) {
  return {name,
          [](const Run& run) {
            Errors errors;
            integrate<S>(run.truth.front(), samples_for<S>(run), standard_gravity<double>(), [&](const State& state) {
              errors.add(state, run.truth[static_cast<std::size_t>(std::lround(state.time * run.rate))]);
            });
            return errors;
          },
          [](const Run& run) {
            Integrator<S> integrator(run.truth.front());
            for (const auto& sample : samples_for<S>(run)) integrator.push(sample);
            integrator.finish();
            keep(integrator.state());
          }};
}

std::vector<Scheme> schemes() {
  return {scheme<Euler>("Euler"),
          scheme<ZeroOrderHold>("ZeroOrderHold"),
          scheme<Midpoint>("Midpoint"),
          scheme<Trapezoid>("Trapezoid"),
          scheme<RungeKutta4>("RungeKutta4"),
          scheme<RungeKutta4DoubleStep>("RungeKutta4DoubleStep"),
          scheme<Magnus4>("Magnus4"),
          scheme<UncorrectedIncrements>("UncorrectedIncrements"),
          scheme<RotationCorrectedIncrements>("RotationCorrectedIncrements"),
          scheme<TwoSampleIncrements>("TwoSampleIncrements"),
          scheme<ThreeSampleIncrements>("ThreeSampleIncrements")};
}

/// ns a sample of each scheme, in turn.
std::vector<Times> times_of(const std::vector<Scheme>& schemes, const Run& run, int repetitions,
                            std::chrono::nanoseconds least) {
  std::vector<Kernel> kernels;
  for (const Scheme& of : schemes) {
    kernels.push_back([&](std::size_t calls) {
      for (; calls > 0; --calls) of.integrate(run);
    });
  }
  std::vector<Times> times = paired(kernels, repetitions, least);
  const double samples = duration * run.rate;
  for (Times& t : times) t = {t.min / samples, t.median / samples, t.max / samples};
  return times;
}

}  // namespace

/// integrators.csv: errors over 10 s from the true initial state [m, rad, m/s] and ns a sample. With the noise of a
/// grade errors are the root mean square over 20 seeds, the same for all schemes; times are those of the exact samples.
void integrators(const Options& options) {
  Table table(options.output / "integrators.csv", {"scene", "grade", "rate", "scheme", "position_max", "position_rms",
                                                   "orientation_max", "velocity_max", "ns_min", "ns_median", "ns_max"});
  const std::vector<double> rates =
      options.quick ? std::vector<double>{100, 400} : std::vector<double>{50, 100, 200, 400, 1000, 2000};
  const std::uint64_t seeds = options.quick ? 3 : 20;
  const auto least = std::chrono::milliseconds(options.quick ? 1 : 4);
  const std::vector<Scheme> all = schemes();
  for (const Scene& scene : scenes()) {
    for (const double rate : rates) {
      const Run exact = exact_run(scene, rate);
      const std::vector<Times> times = times_of(all, exact, options.repetitions, least);
      // Of each scheme: the sums over runs.
      struct Sums {
        ErrorStatistics position_max, position_rms, orientation_max, velocity_max;
      };
      const auto add_rows = [&](const std::string& grade, std::uint64_t runs, const auto& make) {
        std::vector<Sums> sums(all.size());
        for (std::uint64_t seed = 0; seed < runs; ++seed) {
          const Run& run = make(seed);
          for (std::size_t k = 0; k < all.size(); ++k) {
            const Errors errors = all[k].errors(run);
            sums[k].position_max.add(errors.position.max());
            sums[k].position_rms.add(errors.position.rms());
            sums[k].orientation_max.add(errors.orientation.max());
            sums[k].velocity_max.add(errors.velocity.max());
          }
        }
        for (std::size_t k = 0; k < all.size(); ++k) {
          table.row(scene.name, grade, rate, all[k].name, sums[k].position_max.rms(), sums[k].position_rms.rms(),
                    sums[k].orientation_max.rms(), sums[k].velocity_max.rms(), times[k].min, times[k].median,
                    times[k].max);
        }
      };
      add_rows("none", 1, [&](std::uint64_t) -> const Run& { return exact; });
      for (const Grade& of : grades()) {
        add_rows(of.name, seeds, [&](std::uint64_t seed) { return of.noisy(exact, seed); });
      }
      progress("integrators: ", scene.name, " at ", rate, " Hz");
    }
  }
  table.commit();
}

}  // namespace study
