// SPDX-License-Identifier: MIT
// What it costs to put a spline through or near poses: time and instructions a pose, time and memory from a thousand to
// a million of them; and, with --study, what becomes of a real trajectory if its poses are taken as control points,
// fitted by least squares, with or without an IMU, or interpolated (docs/fitting.md).

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/splinertia.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/harness.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Pose3 = SO3xR3<double>;
using Poses = std::vector<Stamped<Pose3, double>>;
using Samples = std::vector<ImuSample<>>;

constexpr double rate = 200, knot_interval = 0.05;

/// Poses of a body that swings about an ellipse, with a millimetre and a milliradian of noise.
std::span<const Stamped<Pose3, double>> poses(std::size_t n) {
  static Poses all;
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal(0, 1e-3);
  if (all.size() < n) {
    all.clear();
    all.reserve(std::max<std::size_t>(n, 20000));
    for (std::size_t i = 0; i < all.capacity(); ++i) {
      const double t = static_cast<double>(i) / rate;
      Pose3 pose = Ellipse<>{}.evaluate<0>(t).value;
      pose.get<0>() *= Sophus::SO3d::exp({normal(bits), normal(bits), normal(bits)});
      pose.get<1>() += Eigen::Vector3d(normal(bits), normal(bits), normal(bits));
      all.push_back({t, pose});
    }
  }
  return {all.data(), n};
}

std::span<const ImuSample<>> samples(std::size_t n) {
  static Samples all;
  if (all.size() < n) {
    all.clear();
    for (std::size_t i = 0; i < std::max<std::size_t>(n, 20000); ++i) {
      const double t = static_cast<double>(i) / rate;
      const auto [gyro, accel] = ideal_imu(Ellipse<>{}.evaluate<2>(t));
      all.push_back({t, gyro, accel});
    }
  }
  return {all.data(), n};
}

template <typename Curve>
Fit<Curve> fit_poses(std::size_t n, const RobustLoss& loss = RobustLoss::squares()) {
  FitOptions<Curve> options{.knot_interval = knot_interval, .loss = loss};
  if (!loss.is_squares()) options.standard_deviation = Tangent<typename Curve::Group>::Constant(1e-3);
  return fit<Curve>(poses(n), options);
}

// A call of a kernel is one pose.
template <typename Curve>
void run_fit(std::size_t n) {
  benchmark::keep(fit_poses<Curve>(n));
}

template <typename Curve>
void run_robust(std::size_t n) {
  benchmark::keep(fit_poses<Curve>(n, RobustLoss::cauchy()));
}

template <typename Curve>
void run_interpolation(std::size_t n) {
  benchmark::keep(interpolate<Curve>(poses(n)));
}

template <typename Curve>
void run_inertial(std::size_t n) {
  const FitOptions<Curve> options{.knot_interval = knot_interval,
                                  .standard_deviation = Tangent<typename Curve::Group>::Constant(1e-3)};
  benchmark::keep(inertial_fit<Curve>(poses(n), samples(n), options,
                                      {.gyro_standard_deviation = 1e-3, .accel_standard_deviation = 1e-2}));
}

double peak_memory() {  // MiB, of this process
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Time and memory from 10³ to 10⁶ poses. In ascending order, since memory that was once used stays counted.
void print_growth(bool csv, int repetitions, std::size_t most) {
  using Curve = Spline<Pose3, 4>;
  poses(most);
  if (!csv)
    std::printf("\n%10s %28s %14s %26s\n", "poses", "seconds min/median/max", "us a pose", "memory beyond input [MiB]");
  const double before = peak_memory();
  for (std::size_t n = 1000; n <= most; n *= 10) {
    std::vector<double> seconds;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const auto start = std::chrono::steady_clock::now();
      const auto result = fit_poses<Curve>(n);
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      if (!result.converged) std::fprintf(stderr, "fitting: did not converge\n");
    }
    std::sort(seconds.begin(), seconds.end());
    const double memory = peak_memory() - before, median = seconds[seconds.size() / 2];
    if (csv) {
      const std::string name = message("fit_", n, "_poses");
      benchmark::figure(csv, name + "_seconds", median, "s");
      benchmark::figure(csv, name + "_memory", memory, "MiB");
    } else {
      std::printf("%10zu %9.4f %8.4f %8.4f %16.2f %20.1f\n", n, seconds.front(), median, seconds.back(),
                  1e6 * median / static_cast<double>(n), memory);
    }
  }
}

/// One row of the table and one set of columns of the csv.
struct Way {
  std::string name;
  std::vector<Motion<Pose3, 2>> motion;  // at the times of the poses
};

/// The poses at the times of control points, taken as control points: what many programs do.
template <typename Curve>
Curve poses_as_control_points(const std::vector<Stamped<Pose3>>& data, double interval) {
  const auto knots = even_knots<KnotsOf<Curve>>(
      data.front().time, data.back().time,
      static_cast<std::size_t>(std::ceil(to_seconds<double>(data.back().time - data.front().time) / interval)),
      Curve::order);
  std::size_t control_points = Curve::order;
  while (knots.domain(control_points, Curve::order).end < data.back().time) ++control_points;
  return poses_at_control_points<Curve>(data, knots, control_points);
}

/// Lines of `ns gx gy gz ax ay az`, separated by commas or blanks.
std::vector<ImuSample<double, nanoseconds>> read_imu(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(message(path.string(), ": cannot be read"));
  std::vector<ImuSample<double, nanoseconds>> imu;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    ImuSample<double, nanoseconds> sample{};
    std::int64_t ticks = 0;
    words >> ticks >> sample.gyro.x() >> sample.gyro.y() >> sample.gyro.z() >> sample.accel.x() >> sample.accel.y() >>
        sample.accel.z();
    if (!words) throw std::runtime_error(message(path.string(), ": no sample of an IMU: ", line));
    sample.time = nanoseconds(ticks);
    imu.push_back(sample);
  }
  return imu;
}

/// Writes, at the time of every pose, how far several curves are off and what they imply.
void write_study(const std::filesystem::path& trajectory, const std::filesystem::path& imu,
                 const std::filesystem::path& output, double interval) {
  using Uniform = Spline<Pose3, 4, UniformKnots<nanoseconds>>;
  using Free = Spline<Pose3, 4, NonUniformKnots<nanoseconds>>;
  const auto data = read_trajectory(trajectory).poses;
  std::vector<Way> ways;
  const auto add = [&](const char* name, const auto& curve) {
    Way way{name, {}};
    for (const auto& pose : data) way.motion.push_back(curve.template evaluate<2>(std::min(pose.time, curve.end())));
    ways.push_back(std::move(way));
  };
  add("control_points", poses_as_control_points<Uniform>(data, interval));
  const FitOptions<Uniform> options{.knot_interval = interval, .loss = RobustLoss::huber()};
  const auto fitted = fit<Uniform>(data, options);
  add("fit", fitted.spline);
  if (!imu.empty()) {
    // EuRoC's ground truth is good to a millimetre and a milliradian; the IMU shakes with the rotors.
    const FitOptions<Uniform> with_imu{
        .knot_interval = interval, .standard_deviation = Tangent<Pose3>::Constant(1e-3), .loss = RobustLoss::cauchy()};
    InertialOptions<double> sensor{.gyro_standard_deviation = 0.02, .accel_standard_deviation = 0.3};
    sensor.estimate_lever_arm = sensor.estimate_time_offset = true;
    const auto both = inertial_fit<Uniform>(data, read_imu(imu), with_imu, sensor);
    add("inertial", both.spline);
    const auto& c = both.imu.calibration;
    std::printf("with the IMU: gyro bias %.6f %.6f %.6f rad/s, accel bias %.4f %.4f %.4f m/s2, time offset %.3f ms\n",
                c.gyro_bias.x(), c.gyro_bias.y(), c.gyro_bias.z(), c.accel_bias.x(), c.accel_bias.y(), c.accel_bias.z(),
                1e3 * c.time_offset);
  }
  add("interpolation", interpolate<Free>(data));

  AtomicFile file(output);
  file.append("time_ns");
  for (const Way& way : ways) {
    for (const char* column :
         {"dx_m", "dy_m", "dz_m", "rx_rad", "ry_rad", "rz_rad", "wx", "wy", "wz", "ax", "ay", "az", "fx", "fy", "fz"}) {
      file.append(message(',', way.name, '_', column));
    }
  }
  file.append('\n');
  for (std::size_t i = 0; i < data.size(); ++i) {
    file.append(message(data[i].time.count()));
    for (const Way& way : ways) {
      const auto& m = way.motion[i];
      const Tangent<Pose3> off = increment(data[i].value, m.value);
      const auto [gyro, force] = ideal_imu(m);
      for (const Eigen::Vector3d& v : {Eigen::Vector3d(off.tail<3>()), Eigen::Vector3d(off.head<3>()), gyro,
                                       Eigen::Vector3d(m.acceleration.tail<3>()), force}) {
        for (int axis = 0; axis < 3; ++axis) {
          file.append(',');
          file.append_real(v[axis]);
        }
      }
    }
    file.append('\n');
  }
  file.commit();
  std::printf("%zu poses, knots %g s apart, %zu outliers; wrote %s\n", data.size(), interval, fitted.outliers.size(),
              output.string().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  using Split4 = Spline<Pose3, 4>;
  using Split6 = Spline<Pose3, 6>;
  using Rigid4 = Spline<Sophus::SE3d, 4>;
  const std::vector<benchmark::Kernel> kernels{
      {"fit_so3xr3_order4", run_fit<Split4>},
      {"fit_so3xr3_order6", run_fit<Split6>},
      {"fit_se3_order4", run_fit<Rigid4>},
      {"fit_cauchy_so3xr3_order4", run_robust<Split4>},
      {"interpolate_so3xr3_order4", run_interpolation<Split4>},
      {"inertial_fit_so3xr3_order4", run_inertial<Split4>},
  };
  std::filesystem::path trajectory, imu, output = "fitting.csv";
  double interval = 0.05;
  std::size_t most = 1'000'000;
  int repetitions = 3;
  benchmark::Extension extension;
  extension.options = [&](CLI::App& app) {
    app.add_option("--poses", most, "most poses to show the growth with")->capture_default_str();
    app.add_option("--repetitions", repetitions, "times that each is measured")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--study", trajectory, "only compare ways along this trajectory (TUM, EuRoC)");
    app.add_option("--imu", imu, "of --study: fit it, too; lines of `ns gx gy gz ax ay az`");
    app.add_option("--output", output, "csv of --study, for fitting_plot.py")->capture_default_str();
    app.add_option("--knot-interval", interval, "of --study [s]")->capture_default_str()->check(CLI::PositiveNumber);
  };
  extension.instead = [&]() -> std::optional<int> {
    if (trajectory.empty()) return std::nullopt;
    try {
      write_study(trajectory, imu, output, interval);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "fitting: %s\n", error.what());
      return 2;
    }
    return 0;
  };
  extension.figures = [&](bool csv, std::size_t) { print_growth(csv, repetitions, most); };
  return benchmark::run(argc, argv, "What splines through and near poses cost; a call is a pose.", kernels, extension);
}
