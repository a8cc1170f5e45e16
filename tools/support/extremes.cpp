// SPDX-License-Identifier: MIT
#include "support/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/time.hpp>

#include "support/formatted.hpp"
#include "support/pose_distances.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// Two maxima disagree if they differ by more than this factor. Those of a smooth motion and of its differences do not.
constexpr double factor = 2;
/// The longest of some thousand normally distributed vectors is about this many standard deviations of an axis long.
constexpr double largest_of_many = 5;

void raise(Peak& peak, double value, nanoseconds time) {
  if (value > peak.value) peak = {value, time};
}

void peaks_of_curve(const FittedTrajectory& fitted, const Eigen::Vector3d& gravity, double rate, Extremes& result) {
  const std::vector<nanoseconds> breaks = fitted.breaks();
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const double length = i + 1 < breaks.size() ? to_seconds<double>(breaks[i + 1] - breaks[i]) : 0;
    const double count = length > 0 ? std::max(4.0, std::ceil(length * rate)) : 1;
    for (double k = 0; k < count; ++k) {
      const nanoseconds time = std::min(after(breaks[i], k * length / count), fitted.curve.end());
      const auto motion = fitted.curve.evaluate<2>(time);
      Peaks& peaks = hole_at(fitted.holes, time) ? *result.invented : result.measured;
      raise(peaks.gyro, angular_velocity(motion).norm(), time);
      raise(peaks.accel, specific_force(motion, gravity).norm(), time);
    }
  }
}

/// The poses that are not outliers, split at holes.
std::vector<Poses> stretches(const Poses& poses, const FittedTrajectory& fitted) {
  std::vector<Poses> result(1);
  auto outlier = fitted.outliers.begin();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool hole_before = i > 0 && hole_at(fitted.holes, poses[i - 1].time + nanoseconds(1));
    if (hole_before) result.emplace_back();
    if (outlier != fitted.outliers.end() && *outlier == i) {
      ++outlier;
    } else {
      result.back().push_back(poses[i]);
    }
  }
  return result;
}

/// The largest turn rate between poses that are at least `least` apart. Over shorter times noise looks like a velocity.
void peak_of_turns(const Poses& poses, nanoseconds least, Peak& peak) {
  for (std::size_t i = 0, j = 0; j < poses.size(); ++i) {
    while (j < poses.size() && poses[j].time < poses[i].time + least) ++j;
    if (j == poses.size()) break;
    const nanoseconds length = poses[j].time - poses[i].time;
    raise(peak, increment(rotation(poses[i].value), rotation(poses[j].value)).norm() / to_seconds<double>(length),
          poses[i].time + length / 2);
  }
}

void peak_of_second_differences(const Poses& poses, nanoseconds window, const Eigen::Vector3d& gravity, Peak& peak) {
  std::size_t before = 0, behind = 0;
  for (const auto& [time, pose] : poses) {
    while (before + 1 < poses.size() && poses[before + 1].time <= time - window) ++before;
    while (behind < poses.size() && poses[behind].time < time + window) ++behind;
    if (behind == poses.size()) break;
    if (poses[before].time > time - window) continue;
    const double h0 = to_seconds<double>(time - poses[before].time), h1 = to_seconds<double>(poses[behind].time - time);
    const Eigen::Vector3d v0 = (position(pose) - position(poses[before].value)) / h0;
    const Eigen::Vector3d v1 = (position(poses[behind].value) - position(pose)) / h1;
    raise(peak, (2 * (v1 - v0) / (h0 + h1) - gravity).norm(), time);
  }
}

nanoseconds knot_interval(const FittedTrajectory& fitted) {
  if (fitted.interval) return *fitted.interval;
  const auto segments = static_cast<nanoseconds::rep>(std::max<std::size_t>(fitted.breaks().size(), 2) - 1);
  return (fitted.curve.end() - fitted.curve.start()) / segments;
}

/// The window of second differences: at least the usual interval of poses, at least the smaller of a knot interval and
/// 0.05 s, because shorter windows show glitches of single poses, and so long that `noise` adds at most about 2 m/s².
nanoseconds window_of(const PoseNoise& noise, nanoseconds usual, nanoseconds knot_interval) {
  constexpr double most = 2;
  const double quiet = std::sqrt(largest_of_many * std::sqrt(6.0) * noise.position / most);
  const nanoseconds long_enough = std::isfinite(quiet) ? after(nanoseconds(0), quiet) : usual;
  return std::max({usual, long_enough, std::min(knot_interval, nanoseconds(50'000'000))});
}

std::string cell(const Peak& peak, nanoseconds first) {
  if (peak.value < 0) return "         -          -";
  return formatted(" %9.4g %10.3f", peak.value, to_seconds<double>(peak.time - first));
}

constexpr double least_visible = 1e-3;  // rad/s, m/s^2: no warnings below what an IMU can show

/// Adds what is wrong with the largest values of one quantity.
void add_peak_warnings(std::vector<std::string>& lines, const Extremes& found, const char* what, const char* unit,
                       const Peak Peaks::*which, double noise_of_differences) {
  const double noise = std::max(noise_of_differences, least_visible);
  const double curve = (found.measured.*which).value, differences = (found.differences.*which).value;
  if (differences >= 0 && curve > factor * differences + noise) {
    lines.push_back(
        formatted("the curve's largest %s is %.3g times that of the poses' differences (%.3g for %.3g %s, "
                  "factor %g allowed): the curve oscillates, or follows poses that jump",
                  what, curve / differences, curve, differences, unit, factor));
  }
  if (differences < 0 && curve > factor * 9.80665) {
    lines.push_back(
        formatted("the curve's largest %s is %.3g %s, and there are too few poses to check it by their differences: "
                  "it may be noise",
                  what, curve, unit));
  }
  if (differences - noise > factor * curve) {
    lines.push_back(
        formatted("the poses' differences show a %s of %.3g %s, the curve has at most %.3g (factor %g "
                  "allowed): its knots are too far apart, or some poses are wrong",
                  what, differences, unit, curve, factor));
  }
  const double invented = found.invented ? ((*found.invented).*which).value : 0;
  if (invented > factor * std::max(curve, differences) + noise) {
    lines.push_back(
        formatted("inside holes the largest %s is %.3g %s, outside %.3g (factor %g allowed): do not use "
                  "the curve inside holes",
                  what, invented, unit, curve, factor));
  }
}

}  // namespace

Extremes extremes(const Poses& poses, const FittedTrajectory& fitted, const Eigen::Vector3d& gravity, double rate) {
  Extremes result{};
  if (!fitted.holes.empty()) result.invented.emplace();
  peaks_of_curve(fitted, gravity, rate, result);
  const nanoseconds usual = after(nanoseconds(0), median_interval(poses));
  const Tangent<SO3xR3<double>> noise = pose_noise(poses);
  result.noise = {noise.head<3>().maxCoeff(), noise.tail<3>().maxCoeff()};
  result.window = window_of(result.noise, usual, knot_interval(fitted));
  for (const Poses& stretch : stretches(poses, fitted)) {
    peak_of_turns(stretch, usual / 2, result.differences.gyro);
    peak_of_second_differences(stretch, result.window, gravity, result.differences.accel);
  }
  const double window = to_seconds<double>(result.window);
  result.gyro_noise = largest_of_many * std::sqrt(2.0) * result.noise.rotation / to_seconds<double>(usual);
  result.accel_noise = largest_of_many * std::sqrt(6.0) * result.noise.position / (window * window);
  return result;
}

std::string extremes_text(const Extremes& found, nanoseconds first) {
  const bool holes = found.invented.has_value();
  std::string text =
      formatted("\nlargest values   %s     at [s]%s   pose differences     at [s]\n",
                holes ? "outside of holes" : "           curve", holes ? "   inside holes     at [s]" : "");
  const auto row = [&](const char* name, const Peak Peaks::*peak) {
    text += formatted("%-22s%s", name, cell(found.measured.*peak, first).c_str());
    if (holes) text += "     " + cell((*found.invented).*peak, first);
    text += "         " + cell(found.differences.*peak, first) + '\n';
  };
  row("|omega| [rad/s]", &Peaks::gyro);
  row("|f| [m/s^2]", &Peaks::accel);
  text += formatted(
      "differences: rotations between neighbouring poses; second differences of positions %.3g s apart, minus "
      "gravity\n",
      to_seconds<double>(found.window));
  if (!std::isfinite(found.gyro_noise + found.accel_noise)) return text;
  return text + formatted(
                    "noise of the poses, found in their differences: %.2g rad and %.2g m; this alone causes "
                    "differences of up to %.2g rad/s and %.2g m/s^2\n",
                    found.noise.rotation, found.noise.position, found.gyro_noise, found.accel_noise);
}

std::vector<std::string> extremes_warnings(const Extremes& found, const FittedTrajectory& fitted) {
  std::vector<std::string> lines;
  add_peak_warnings(lines, found, "|omega|", "rad/s", &Peaks::gyro, found.gyro_noise);
  add_peak_warnings(lines, found, "|f|", "m/s^2", &Peaks::accel, found.accel_noise);

  // A rotation residual r means that an angular velocity of about r per knot interval is missing in the curve.
  const double residual = lengths(fitted.distances.rotation, fitted.outliers).rms;
  const double missing = residual / to_seconds<double>(knot_interval(fitted));
  const double noise = std::sqrt(3.0) * found.noise.rotation;
  if (noise > 0 && residual > 3 * noise && missing > std::max(least_visible, 0.01 * found.measured.gyro.value)) {
    lines.push_back(
        formatted("the rotation residuals are %.2g rad (rms), far above the noise of %.2g rad: the knots are too "
                  "far apart for parts of the motion",
                  residual, noise));
  }
  return lines;
}
