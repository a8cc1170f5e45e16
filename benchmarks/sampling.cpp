// SPDX-License-Identifier: MIT
// What sampling a spline densely costs: pose, angular velocity and specific force at 1 kHz, several samples at once
// (sample_imu) and one by one; beside what bounds it, the arithmetic and the memory; and whole simulations, spline →
// ideal IMU → white noise and random walk → memory, beside the loop of a simulator with a motion of its own.
//
// Workload: 100 control points 0.1 s apart, rotation increments up to 0.5 rad, positions ~ N(0, 1) m, 9500 samples in a
// row. A call is a sample.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <random>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/sample_imu.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/sample.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/harness.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

constexpr std::size_t samples_of_a_run = 9500;

/// Of 97 segments.
template <typename G, int Order>
std::vector<G> control_points() {
  using Scalar = ScalarOf<G>;
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> angle(-0.29, 0.29);
  const auto scalar = [&](auto& distribution) { return static_cast<Scalar>(distribution(bits)); };
  using Rotation = GroupTraits<Sophus::SO3<Scalar>>;
  Sophus::SO3<Scalar> R;
  std::vector<G> points;
  for (int i = 0; i < 96 + Order; ++i) {
    R = Rotation::compose(R, Rotation::exp({scalar(angle), scalar(angle), scalar(angle)}));
    points.push_back(make_pose<G>(R, {scalar(normal), scalar(normal), scalar(normal)}));
  }
  return points;
}

template <typename G, int Order, typename K = UniformKnots<double>>
std::shared_ptr<const Spline<G, Order, K>> make_curve() {
  using Curve = const Spline<G, Order, K>;
  if constexpr (std::same_as<K, UniformKnots<double>>) {
    return std::make_shared<Curve>(K{0.0, 0.1}, control_points<G, Order>());
  } else if constexpr (std::same_as<K, UniformKnots<nanoseconds>>) {
    // An epoch of today, which double seconds would tell apart by 2e-7 s only.
    return std::make_shared<Curve>(K{nanoseconds(1'700'000'000'000'000'000), nanoseconds(100'000'000)},
                                   control_points<G, Order>());
  } else {
    K knots;
    for (int i = 0; i < 96 + 2 * Order; ++i) knots.knots.push_back(0.1 * (i - Order + 1));
    return std::make_shared<Curve>(knots, control_points<G, Order>());
  }
}

template <typename Curve>
SampleTimes<typename Curve::Time> at_1_kHz(const Curve& curve) {
  if constexpr (std::same_as<typename Curve::Time, double>) {
    return {curve.start(), 0.001};
  } else {
    return {curve.start(), nanoseconds(1'000'000)};
  }
}

/// f(first, count) for `calls` samples, in runs of at most 9500.
void in_runs(std::size_t calls, const auto& f) {
  for (std::size_t done = 0; done < calls; done += samples_of_a_run) f(std::min(samples_of_a_run, calls - done));
}

template <typename G, int Order, typename K = UniformKnots<double>>
benchmark::Kernel dense_imu(const std::string& name) {
  using Scalar = ScalarOf<G>;
  using Samples = ImuSamples<G, typename K::Time>;
  return {name, [curve = make_curve<G, Order, K>(), samples = std::make_shared<Samples>()](std::size_t calls) {
            in_runs(calls, [&](std::size_t count) {
              sample_imu(*curve, at_1_kHz(*curve), 0, count, *samples, standard_gravity<Scalar>());
              benchmark::keep(*samples);
            });
          }};
}

template <typename G, int Order, int D>
benchmark::Kernel dense(const std::string& name) {
  return {name, [curve = make_curve<G, Order>(), samples = std::make_shared<MotionSamples<G, D>>()](std::size_t calls) {
            in_runs(calls, [&](std::size_t count) {
              sample<D>(*curve, at_1_kHz(*curve), 0, count, *samples);
              benchmark::keep(*samples);
            });
          }};
}

/// The same numbers as dense_imu, a sample at a time.
template <typename G, int Order>
benchmark::Kernel one_by_one(const std::string& name) {
  using Scalar = ScalarOf<G>;
  return {name, [curve = make_curve<G, Order>(),
                 samples = std::make_shared<std::vector<ImuSampleAtPose<G>>>(samples_of_a_run)](std::size_t calls) {
            const auto times = at_1_kHz(*curve);
            in_runs(calls, [&](std::size_t count) {
              for (std::size_t i = 0; i < count; ++i) {
                const auto motion = curve->template evaluate<2>(times(i));
                const auto [gyro, accel] = ideal_imu(motion, standard_gravity<Scalar>());
                (*samples)[i] = {{times(i), gyro, accel}, motion.value};
              }
              benchmark::keep(*samples);
            });
          }};
}

/// The memory alone: 13 rows of numbers, as sample_imu writes them.
benchmark::Kernel memory_bound() {
  using L = NativeSimdPack<double>;
  struct Rows : SampleRows<double, 13> {
    Rows() { resize(samples_of_a_run); }
  };
  return {"bound_memory", [rows = std::make_shared<Rows>()](std::size_t calls) {
            in_runs(calls, [&](std::size_t count) {
              const typename Rows::Writer to(*rows);
              std::array<L, 13> numbers;
              numbers.fill(L(1.0));
              for (std::size_t i = 0; i < count; i += L::size) to.write<0, 13>(i, numbers);
              benchmark::keep(*rows);
            });
          }};
}

/// The arithmetic alone: for each sample of a lane, as many products and sums, fused where the target can, as
/// dense_imu_so3xr3_order4 has (counted in its machine code), on sixteen numbers that do not wait for one another.
benchmark::Kernel arithmetic_bound() {
  using L = NativeSimdPack<double>;
  return {"bound_arithmetic", [](std::size_t calls) {
            std::array<L, 8> sums;
            sums.fill(L(0.5));
            const L factor(0.999), term(1e-3);
            for (std::size_t i = 0; i < calls; i += L::size) {
              for (int round = 0; round < 32; ++round) {
                for (L& sum : sums) sum = sum * factor + term;
              }
            }
            benchmark::keep(sums);
          }};
}

struct Stored {
  std::vector<double> time;
  std::vector<Eigen::Vector3d> gyro, accel, gyro_bias, accel_bias;
  explicit Stored(std::size_t n) : time(n), gyro(n), accel(n), gyro_bias(n), accel_bias(n) {}
};

/// A whole simulation at 1 kHz into memory.
template <typename G>
benchmark::Kernel simulation(const std::string& name, const auto& imu) {
  return {name,
          [curve = make_curve<G, 4>(), imu, stored = std::make_shared<Stored>(samples_of_a_run)](std::size_t calls) {
            in_runs(calls, [&](std::size_t count) {
              std::size_t i = 0;
              const double end = curve->start() + static_cast<double>(count - 1) * 0.001;
              for (const auto& r : simulate(*curve, imu, {.rate = 1000, .seed = 1, .end = end})) {
                stored->time[i] = r.time;
                stored->gyro[i] = r.gyro;
                stored->accel[i] = r.accel;
                if constexpr (requires { r.gyro_bias; }) {
                  stored->gyro_bias[i] = r.gyro_bias;
                  stored->accel_bias[i] = r.accel_bias;
                }
                if (++i == count) break;
              }
              benchmark::keep(*stored);
            });
          }};
}

/// What simulators of courses do, by hand: an ellipse with a wave in height, attitude in Euler angles, all derivatives
/// written out, and white noise and random walk of six axes from one generator of <random> that lives outside the loop.
benchmark::Kernel hard_coded_motion() {
  return {"hard_coded_motion_std_random", [stored = std::make_shared<Stored>(samples_of_a_run)](std::size_t calls) {
            std::mt19937_64 bits(1);
            std::normal_distribution<double> normal;
            const auto noise = [&](double sigma) -> Eigen::Vector3d {
              return {sigma * normal(bits), sigma * normal(bits), sigma * normal(bits)};
            };
            const double dt = 0.001, white = 1 / std::sqrt(dt), walk = std::sqrt(dt);
            const double a = 15, b = 20, h = 1, k = 2 * M_PI / 20, roll_amplitude = 0.1, pitch_amplitude = 0.2;
            const Eigen::Vector3d gravity(0, 0, -9.80665);
            in_runs(calls, [&](std::size_t count) {
              Eigen::Vector3d gyro_bias(0, 0, 0), accel_bias(0, 0, 0);
              for (std::size_t i = 0; i < count; ++i) {
                const double t = static_cast<double>(i) * dt;
                const Eigen::Vector3d acceleration(-k * k * a * std::cos(k * t), -k * k * b * std::sin(k * t),
                                                   -100 * k * k * h * std::sin(10 * k * t));
                const double roll = roll_amplitude * std::cos(t), pitch = pitch_amplitude * std::sin(t), yaw = k * t;
                const Eigen::Vector3d rates(-roll_amplitude * std::sin(t), pitch_amplitude * std::cos(t), k);
                const double cr = std::cos(roll), sr = std::sin(roll), cp = std::cos(pitch), sp = std::sin(pitch);
                const double cy = std::cos(yaw), sy = std::sin(yaw);
                Eigen::Matrix3d R_WB, rates_to_body;
                R_WB << cy * cp, cy * sp * sr - sy * cr, sy * sr + cy * cr * sp,  //
                    sy * cp, cy * cr + sy * sr * sp, sp * sy * cr - cy * sr,      //
                    -sp, cp * sr, cp * cr;
                rates_to_body << 1, 0, -sp, 0, cr, sr * cp, 0, -sr, cr * cp;
                gyro_bias += noise(5e-5 * walk);
                accel_bias += noise(5e-4 * walk);
                stored->time[i] = t;
                stored->gyro[i] = rates_to_body * rates + gyro_bias + noise(0.015 * white);
                stored->accel[i] = R_WB.transpose() * (acceleration - gravity) + accel_bias + noise(0.019 * white);
                stored->gyro_bias[i] = gyro_bias;
                stored->accel_bias[i] = accel_bias;
              }
              benchmark::keep(*stored);
            });
          }};
}

/// Streams so many samples through one block of memory; returns ns a sample.
double stream(std::size_t count) {
  const Spline<SO3xR3<double>, 4> curve({0.0, static_cast<double>(count) / 95000 + 1e-3},
                                        control_points<SO3xR3<double>, 4>());
  const SampleTimes<double> times{0.0, 0.001};
  ImuSamples<SO3xR3<double>> block;
  double sum = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t first = 0; first < count; first += 1024) {
    sample_imu(curve, times, first, std::min<std::size_t>(1024, count - first), block, standard_gravity<double>());
    sum += block.gyro()(0, 0);
  }
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  benchmark::keep(sum);
  return elapsed.count() / static_cast<double>(count);
}

/// Time and peak memory of streams of growing length, each in a process of its own.
void print_streams(bool csv) {
  if (!csv) std::printf("\n%-42s %10s %14s\n", "streamed samples", "ns each", "peak memory");
  for (const std::size_t count : {10'000u, 100'000u, 1'000'000u, 10'000'000u, 100'000'000u}) {
    int channel[2];
    if (pipe(channel) != 0) return;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      const double ns = stream(count);
      const bool told = write(channel[1], &ns, sizeof(ns)) == sizeof(ns);
      _exit(told ? 0 : 1);
    }
    rusage usage{};
    int status = 1;
    double ns = 0;
    if (child < 0 || wait4(child, &status, 0, &usage) < 0 || status != 0 ||
        read(channel[0], &ns, sizeof(ns)) != sizeof(ns)) {
      std::fprintf(stderr, "sampling: a process that streams %zu samples failed\n", count);
    } else {
      const auto kilobytes = static_cast<double>(usage.ru_maxrss);
      std::string name = "stream_";
      name += std::to_string(count);
      benchmark::figure(csv, name + "_ns", ns, "ns");
      benchmark::figure(csv, name + "_memory", kilobytes, "KiB");
      if (!csv) std::printf("%-42zu %10.2f %10.0f KiB\n", count, ns, kilobytes);
    }
    close(channel[0]);
    close(channel[1]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using Split = SO3xR3<double>;
  using SE3 = Sophus::SE3d;
  const ErrorModel gyro{RandomWalk{5e-5}, WhiteNoise{0.015}}, accel{RandomWalk{5e-4}, WhiteNoise{0.019}};
  const std::vector<benchmark::Kernel> kernels{
      dense_imu<Split, 4>("dense_imu_so3xr3_order4"),
      one_by_one<Split, 4>("one_by_one_imu_so3xr3_order4"),
      dense_imu<Split, 3>("dense_imu_so3xr3_order3"),
      dense_imu<Split, 5>("dense_imu_so3xr3_order5"),
      dense_imu<Split, 6>("dense_imu_so3xr3_order6"),
      dense_imu<Split, 8>("dense_imu_so3xr3_order8"),
      dense_imu<SO3xR3<float>, 4>("dense_imu_so3xr3_order4_float"),
      dense_imu<Split, 4, UniformKnots<nanoseconds>>("dense_imu_so3xr3_order4_nanoseconds"),
      dense_imu<Split, 4, NonUniformKnots<double>>("dense_imu_so3xr3_order4_nonuniform"),
      dense_imu<SE3, 4>("dense_imu_se3_order4"),
      one_by_one<SE3, 4>("one_by_one_imu_se3_order4"),
      dense_imu<SE3, 6>("dense_imu_se3_order6"),
      dense_imu<Sophus::SE3f, 4>("dense_imu_se3_order4_float"),
      dense<Split, 4, 0>("dense_so3xr3_order4_value"),
      dense<Split, 4, 2>("dense_so3xr3_order4_evaluate2"),
      memory_bound(),
      arithmetic_bound(),
      simulation<Split>("simulation_so3xr3_order4", Imu{gyro, accel}),
      simulation<SE3>("simulation_se3_order4", Imu{gyro, accel}),
      simulation<Split>("simulation_so3xr3_order4_noise_free", Imu{ErrorModel{}, ErrorModel{}}),
      hard_coded_motion(),
  };
  bool streams = false;
  return benchmark::run(argc, argv, "Costs of sampling splines densely, and of whole simulations.", kernels,
                        {.options =
                             [&](CLI::App& app) {
                               app.add_flag("--streams", streams, "also stream 1e4 to 1e8 samples: time and memory");
                             },
                         .figures =
                             [&](bool csv, std::size_t) {
                               if (streams) print_streams(csv);
                             }});
}
