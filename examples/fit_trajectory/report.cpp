// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <splinertia/time.hpp>
#include <splinertia/units.hpp>

#include "support/formatted.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

constexpr std::size_t most_lines = 20;

long long count(nanoseconds time) { return time.count(); }

std::string knots_text(const FittedTrajectory& fitted, const Options& o) {
  const std::size_t segments = fitted.control_points.size() - static_cast<std::size_t>(o.order) + 1;
  if (fitted.interval) {
    std::string text = formatted("knots: uniform, %.6g s apart", seconds<double>(*fitted.interval));
    if (o.cross_validate) text += ", the longest interval that predicts poses left out as well as the best";
    if (o.goal_position) {
      text += formatted(", the longest that leave at most %g m and %g rad (rms of each axis, without outliers)",
                        *o.goal_position, *o.goal_rotation);
    }
    return text;
  }
  if (o.interpolate) return "knots: at the poses";
  double shortest = INFINITY, longest = 0;
  for (std::size_t i = 1; i < fitted.knots.size(); ++i) {
    const double length = seconds<double>(fitted.knots[i] - fitted.knots[i - 1]);
    if (length > 0) shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return formatted("knots: non-uniform, %.4g to %.4g s apart, as many as leave %g m and %g rad in %zu segments",
                   shortest, longest, *o.goal_position, *o.goal_rotation, segments);
}

std::string fit_text(const FittedTrajectory& fitted, const Options& o) {
  if (o.interpolate) return "fit: through every pose, without acceleration at the ends";
  std::string text = "fit: " + o.loss;
  if (o.adaptive && o.loss != "squares") text = "fit: squares, without outliers";
  if (o.position_density) {
    text += formatted(", smoothed as if the %s were white noise of %g m and %g rad /s^%d/sqrt(Hz)",
                      o.smooth_derivative == 2 ? "acceleration" : "jerk", *o.position_density, *o.rotation_density,
                      o.smooth_derivative);
  }
  return text + formatted(", %s after %d linear systems, condition %.2g",
                          fitted.converged ? "converged" : "NOT CONVERGED", fitted.iterations, fitted.condition);
}

std::string residuals_text(const FittedTrajectory& fitted) {
  const Lengths position = lengths(fitted.distances.position), rotation = lengths(fitted.distances.rotation);
  const Lengths inner_position = lengths(fitted.distances.position, fitted.outliers);
  const Lengths inner_rotation = lengths(fitted.distances.rotation, fitted.outliers);
  std::string text = "\ncurve to poses          rms        max   without outliers: rms        max\n";
  const auto row = [](const char* name, const Lengths& all, const Lengths& inner) {
    return formatted("%-16s %10.3g %10.3g %23.3g %10.3g\n", name, all.rms, all.max, inner.rms, inner.max);
  };
  text += row("position [m]", position, inner_position);
  return text + row("rotation [rad]", rotation, inner_rotation);
}

std::string deviation_text(const FittedTrajectory& fitted, const Options& o) {
  const auto &p = fitted.position_deviation, &r = fitted.rotation_deviation;
  const bool split = o.group == "split";
  return formatted("standard deviation of a pose, as %s: x y z %.3g %.3g %.3g m%s, %.3g %.3g %.3g rad\n",
                   o.position_deviation ? "given" : "found in the residuals", p.x(), p.y(), p.z(),
                   split ? "" : " in its body", r.x(), r.y(), r.z());
}

std::string tried_text(const FittedTrajectory& fitted) {
  double least = INFINITY;
  for (const auto& [interval, error] : fitted.tried) least = std::min(least, error);
  std::string text = "\ncross-validation\n  knot interval [s]   error of poses left out, over the least\n";
  for (const auto& [interval, error] : fitted.tried) {
    text += formatted("  %17.6g   %10.4g%s\n", interval, error / least,
                      interval == *fitted.chosen_interval ? "  <- chosen" : "");
  }
  return text;
}

std::string list(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "  " + line + '\n';
  return text;
}

std::string outliers_text(const Poses& poses, const FittedTrajectory& fitted, const Options& o) {
  if (o.interpolate) return "";
  if (fitted.outliers.empty()) return formatted("outliers: none (%g standard deviations)\n", o.outlier_limit);
  return formatted("outliers: %zu poses further off than %g standard deviations, in seconds from the first pose\n",
                   fitted.outliers.size(), o.outlier_limit) +
         list(outlier_lines(poses, fitted.distances, fitted.outliers, most_lines));
}

std::string gaps_text(const Poses& poses, const FittedTrajectory& fitted, const Options& o) {
  if (o.interpolate) return "";
  if (fitted.gaps.empty()) return "gaps: none, every control point has poses that hold it\n";
  const char* done = o.fit_imu            ? "bridged by the IMU"
                     : o.position_density ? "bridged by the smoothness that was asked for"
                                          : "bridged by the way of least acceleration, which nothing measured";
  return formatted("gaps: %zu where poses do not hold the curve, %s; in seconds from the first pose\n",
                   fitted.gaps.size(), done) +
         list(gap_lines(poses, fitted.gaps, o.position_density ? 3 : most_lines));
}

/// A number with its standard deviation.
std::string estimate(double value, double deviation) {
  if (!std::isfinite(deviation)) return formatted("%11.5g  not shown  ", value);
  return formatted("%11.5g +- %-8.2g", value, deviation);
}

std::string imu_text(const FittedImu& imu, std::size_t samples, const Options& o) {
  const auto& [calibration, deviation, gyro_rms, accel_rms, inside, iterations, converged] = imu.calibrated;
  std::string text = formatted("\nIMU %s: %zu of %zu samples within the curve, %s\n", o.imu.string().c_str(), inside,
                               samples, o.fit_imu ? "fitted together with the poses" : "held against the curve");
  const auto row = [&](const char* name, const Eigen::Vector3d& value, const Eigen::Vector3d& sigma, const char* unit) {
    text += formatted("  %-19s", name);
    for (int i = 0; i < 3; ++i) text += estimate(value[i], sigma[i]);
    text += formatted(" %s\n", unit);
  };
  row("gyroscope bias", calibration.gyro_bias, deviation.gyro_bias, "rad/s");
  row("accelerometer bias", calibration.accel_bias, deviation.accel_bias, "m/s^2");
  if (o.estimate_lever_arm) row("lever arm", calibration.arm.p_BI, deviation.lever_arm, "m");
  if (o.estimate_time_offset) {
    text += formatted("  %-19s%s s, of the trajectory's clock from the IMU's\n", "time offset",
                      estimate(calibration.time_offset, deviation.time_offset).c_str());
  }
  const Eigen::Vector3d given = o.gravity_vector(), &found = calibration.gravity;
  const double turned = std::atan2(given.cross(found).norm(), given.dot(found));
  text += formatted("  %-19s%11.5g %11.5g %11.5g m/s^2: %.3g deg +- %.2g deg from where it was given\n", "gravity",
                    found.x(), found.y(), found.z(), turned / units::degree,
                    deviation.gravity_direction.maxCoeff() / units::degree);
  text += formatted("  %-19s%11.4g rad/s, %.4g m/s^2 (rms of each axis)\n", "residuals", gyro_rms, accel_rms);
  text += formatted("  +- one sigma, with white noise of %.4g rad/s and %.4g m/s^2 in a sample, as %s\n",
                    imu.gyro_deviation, imu.accel_deviation, o.gyro_deviation ? "given" : "the residuals have it");
  if (!converged) text += formatted("  NOT CONVERGED after %d linear systems\n", iterations);
  return text;
}

/// What to be careful about, a line each.
std::vector<std::string> warnings(const Poses& poses, const FittedTrajectory& fitted, const Options& o) {
  std::vector<std::string> lines;
  if (!fitted.converged) {
    lines.push_back(fitted.iterations >= o.most_iterations
                        ? formatted("not converged: %d linear systems were not enough (--most-iterations); the curve "
                                    "is the best so far",
                                    fitted.iterations)
                        : formatted("not converged: after %d linear systems no step lowered the cost any more; the "
                                    "curve is the best so far",
                                    fitted.iterations));
  }
  if (fitted.ends_held) {
    lines.push_back("the poses do not hold the ends of so high an order; its accelerations there were kept small");
  }
  if (fitted.imu && !fitted.imu->calibrated.converged && !o.fit_imu) {
    lines.push_back("the calibration of the IMU has not converged");
  }
  if (fitted.condition > 1e10) {
    lines.push_back(
        formatted("condition %.2g: of the curve's 16 digits about %.0f are lost where the poses hold it "
                  "least",
                  fitted.condition, std::log10(fitted.condition)));
  }
  const double share = static_cast<double>(fitted.outliers.size()) / static_cast<double>(poses.size());
  if (share > 0.02) {
    lines.push_back(
        formatted("%.2g %% of the poses are outliers: their noise is not normal, or the knots are too far "
                  "apart for parts of the motion",
                  100 * share));
  }
  if (fitted.interval) {
    const auto interval_before = [&](std::size_t i) { return poses[i].time - poses[i - 1].time; };
    std::size_t longest = 1;
    for (std::size_t i = 2; i < poses.size(); ++i) {
      if (interval_before(i) > interval_before(longest)) longest = i;
    }
    const nanoseconds from = poses[longest - 1].time, to = poses[longest].time;
    const bool reported = std::any_of(fitted.gaps.begin(), fitted.gaps.end(),
                                      [&](const Gap& gap) { return gap.start < to && gap.end > from; });
    if (to - from > 2 * *fitted.interval && !reported) {
      lines.push_back(
          formatted("from %.3f to %.3f s there are no poses for %.2g knot intervals: their neighbours hold "
                    "the curve there, but its derivatives are hardly measured",
                    seconds<double>(from - poses.front().time), seconds<double>(to - poses.front().time),
                    seconds<double>(to - from) / seconds<double>(*fitted.interval)));
    }
  }
  if (fitted.tried.size() > 1) {
    const auto best = std::min_element(fitted.tried.begin(), fitted.tried.end(),
                                       [](const auto& a, const auto& b) { return a.error < b.error; });
    if (best + 2 >= fitted.tried.end()) {
      lines.push_back(
          "cross-validation finds nearly the shortest interval best that the poses can hold: their noise is not "
          "independent from one to the next (smoothed by an estimator?), choose the interval otherwise");
    }
  }
  return lines;
}

}  // namespace

std::string report(const Poses& poses, std::size_t samples, const FittedTrajectory& fitted, const Options& o) {
  const nanoseconds first = poses.front().time, last = poses.back().time;
  std::string text = formatted("%s: %zu poses over %.9g s from %lld to %lld ns, longest gap %.4g s\n",
                               o.trajectory.string().c_str(), poses.size(), seconds<double>(last - first), count(first),
                               count(last), seconds<double>(longest_interval(poses)));
  text += formatted("spline: order %d on %s, %zu control points\n", o.order,
                    o.group == "split" ? "SO(3) x R^3" : "SE(3)", fitted.control_points.size());
  text += knots_text(fitted, o) + '\n' + fit_text(fitted, o) + '\n';
  if (!fitted.tried.empty()) text += tried_text(fitted);
  text += residuals_text(fitted);
  if (!o.interpolate) text += deviation_text(fitted, o);
  text += '\n' + outliers_text(poses, fitted, o) + gaps_text(poses, fitted, o);
  if (fitted.imu) text += imu_text(*fitted.imu, samples, o);
  for (const std::string& warning : warnings(poses, fitted, o)) text += "\nwarning: " + warning + '\n';
  return text;
}
