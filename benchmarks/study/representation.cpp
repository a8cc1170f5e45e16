// SPDX-License-Identifier: MIT
// Which group, order, scalar and knots a curve should have: how far its pose, angular velocity and specific force are
// from those of the motion that it was fitted to, and what a sample of an IMU along it costs.
#include <iterator>
#include <optional>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/time.hpp>

#include "curves.hpp"
#include "scenes.hpp"

namespace study {
namespace {

/// The motion is looked at from here on, for `length`. Curves are fitted to a little more at both ends: what happens at
/// the end of a curve is not its order's doing.
constexpr double first_time = 2.5;
double margin(double knot_interval) { return std::min(first_time, 7 * knot_interval); }

/// Of poses that hold the knots well: at 100 Hz, or five for each knot.
double pose_interval(double knot_interval) { return std::min(0.01, knot_interval / 5); }

template <typename Motion>
Poses sampled_poses(const Motion& motion, double from, double to, double interval) {
  const auto count = static_cast<std::size_t>(std::lround((to - from) / interval));
  Poses poses;
  for (std::size_t i = 0; i <= count; ++i) {
    const double time = from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
    poses.push_back({time, motion.template evaluate<0>(time).value});
  }
  return poses;
}

template <typename Motion>
std::vector<Truth> truth_of(const Motion& motion, double length) {
  constexpr double interval = 0.00314159;  // in step with no knots
  std::vector<Truth> truth;
  for (double time = first_time; time <= first_time + length; time += interval) {
    truth.push_back({time, motion.template evaluate<2>(time)});
  }
  return truth;
}

template <typename Motion>
void study_motion(Table& table, const std::string& scene, const Motion& motion, double length, const Options& options) {
  const auto truth = truth_of(motion, length);
  const std::vector<double> intervals =
      options.quick ? std::vector{0.1, 0.05} : std::vector{0.4, 0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625};
  for (const double interval : intervals) {
    progress("representation: ", scene, ", knots ", interval, " s apart");
    const double more = margin(interval);
    const Poses poses = sampled_poses(motion, first_time - more, first_time + length + more, pose_interval(interval));
    std::vector<Subject> all;
    for (const auto make : {subjects<3>, subjects<4>, subjects<5>, subjects<6>, subjects<7>, subjects<8>}) {
      auto some = make(poses, interval, truth);
      std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    std::vector<Kernel> kernels;
    for (const Subject& subject : all) {
      kernels.push_back(subject.single);
      kernels.push_back(subject.dense);
    }
    const auto least = options.quick ? std::chrono::microseconds(200) : std::chrono::milliseconds(5);
    const auto times = paired(kernels, options.repetitions, least);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [group, order, scalar, control_points, bytes, e, one, many] = all[i];
      const Times &single = times[2 * i], &dense = times[2 * i + 1];
      table.row(scene, group, order, scalar, interval, e.orientation.rms(), e.orientation.max(), e.position.rms(),
                e.position.max(), e.gyro.rms(), e.gyro.max(), e.accel.rms(), e.accel.max(), single.min, single.median,
                single.max, dense.min, dense.median, dense.max, static_cast<double>(bytes) / interval);
    }
  }
}

/// Poses from a file, in seconds from the first on.
Poses measured_poses(const std::filesystem::path& file) {
  const auto stamped = splinertia::read_trajectory(file).poses;
  Poses poses;
  for (const auto& [time, pose] : stamped) {
    poses.push_back({splinertia::to_seconds<double>(time - stamped.front().time), pose});
  }
  return poses;
}

}  // namespace

void representation(const Options& options) {
  Table table(options.output / "representation.csv",
              {"scene",           "group",           "order",           "scalar",        "knot_interval",
               "orientation_rms", "orientation_max", "position_rms",    "position_max",  "gyro_rms",
               "gyro_max",        "accel_rms",       "accel_max",       "single_ns_min", "single_ns_median",
               "single_ns_max",   "dense_ns_min",    "dense_ns_median", "dense_ns_max",  "bytes_per_second"});
  const double length = options.quick ? 2 : 12.5;
  std::optional<splinertia::Spline<splinertia::SO3xR3<double>, 6>> measured;
  if (!options.data.empty()) {
    // From the middle, where things fly.
    constexpr double knot_interval = 0.02;
    const double wanted = length + 2 * first_time;
    Poses poses = measured_poses(options.data);
    const double first = (poses.back().time - wanted) / 2;
    if (first < 0) {
      throw std::runtime_error(splinertia::detail::message(options.data.string(), ": ", poses.back().time,
                                                           " s long, expected at least ", wanted, " s"));
    }
    std::erase_if(poses, [&](const auto& pose) { return pose.time < first - 0.1 || pose.time > first + wanted + 0.1; });
    const double start = poses.front().time;
    for (auto& pose : poses) pose.time -= start;
    measured = smooth_curve(poses, knot_interval);
  }
  for (const Scene& scene : scenes()) study_motion(table, scene.name, scene, length, options);
  if (measured) study_motion(table, "measured", *measured, length, options);
  table.commit();
}

}  // namespace study
