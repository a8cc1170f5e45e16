// SPDX-License-Identifier: MIT
#include "support/fit_report.hpp"

#include <algorithm>
#include <cmath>
#include <splinertia/time.hpp>

#include "support/formatted.hpp"
#include "support/pose_distances.hpp"
#include "support/yaml_text.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

constexpr std::size_t most_lines = 20;

std::string knots_text(const FittedTrajectory& fitted, const FitChoices& o) {
  const std::size_t segments = fitted.control_points.size() - static_cast<std::size_t>(o.order) + 1;
  if (fitted.interval) {
    std::string text = formatted("knots: uniform, %.6g s apart", to_seconds<double>(*fitted.interval));
    if (!fitted.why_interval.empty()) text += " (" + fitted.why_interval + ')';
    if (o.cross_validate) text += ", the longest interval that predicts left-out poses as well as the best";
    if (o.goal_position) {
      text += formatted(", the longest with residuals of at most %g m and %g rad (rms of each axis, without outliers)",
                        *o.goal_position, *o.goal_rotation);
    }
    return text;
  }
  if (o.interpolate) return "knots: at the poses";
  double shortest = INFINITY, longest = 0;
  for (std::size_t i = 1; i < fitted.knots.size(); ++i) {
    const double length = to_seconds<double>(fitted.knots[i] - fitted.knots[i - 1]);
    if (length > 0) shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return formatted("knots: non-uniform, %.4g to %.4g s apart, for residuals of %g m and %g rad, in %zu segments",
                   shortest, longest, *o.goal_position, *o.goal_rotation, segments);
}

std::string fit_text(const FittedTrajectory& fitted, const FitChoices& o) {
  if (o.interpolate) return "fit: through every pose, with zero acceleration at the ends";
  std::string text = "fit: " + o.loss;
  if (o.adaptive && o.loss != "squares") text = "fit: squares, without outliers";
  if (o.position_density) {
    text += formatted(", smoothed as if the %s were white noise of %g m and %g rad /s^%d/sqrt(Hz)",
                      o.smooth_derivative == 2 ? "acceleration" : "jerk", *o.position_density, *o.rotation_density,
                      o.smooth_derivative);
  }
  text +=
      formatted(", %s after %d linear systems", fitted.converged ? "converged" : "NOT CONVERGED", fitted.iterations);
  return std::isfinite(fitted.condition) ? text + formatted(", condition %.2g", fitted.condition) : text;
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

std::string deviation_text(const FittedTrajectory& fitted, const FitChoices& o) {
  const auto &p = fitted.position_deviation, &r = fitted.rotation_deviation;
  const bool split = o.group == "split";
  return formatted("standard deviation of a pose, as %s: x y z %.3g %.3g %.3g m%s, %.3g %.3g %.3g rad\n",
                   o.position_deviation ? "given" : "found in the residuals", p.x(), p.y(), p.z(),
                   split ? "" : " in its body frame", r.x(), r.y(), r.z());
}

std::string tried_text(const FittedTrajectory& fitted) {
  double least = INFINITY;
  for (const auto& [interval, error] : fitted.tried) least = std::min(least, error);
  std::string text = "\ncross-validation\n  knot interval [s]   error of left-out poses, relative to the least\n";
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

std::string outliers_text(const FitInput& input, const FittedTrajectory& fitted, const FitChoices& o) {
  if (o.interpolate) return "";
  const std::size_t count = fitted.outliers.size();
  if (count == 0) return formatted("outliers: none (%g standard deviations)\n", o.outlier_limit);
  return formatted("outliers: %zu pose%s by more than %g standard deviations, in seconds from the first pose\n", count,
                   count == 1 ? " deviates" : "s deviate", o.outlier_limit) +
         list(outlier_lines(input.poses, fitted.distances, fitted.outliers, most_lines));
}

std::string holes_text(const FitInput& input, const FittedTrajectory& fitted, const FitChoices& o, bool with_imu) {
  const std::size_t count = fitted.holes.size();
  std::string text = count == 0 ? "holes: none\n" : "";
  if (with_imu) text = "holes: none, the IMU measures the curve where there are no poses\n";
  if (count > 0) {
    text =
        formatted("holes: %zu span%s without poses, where the curve is %s; in seconds from the first pose\n", count,
                  count == 1 ? "" : "s",
                  o.position_density ? "determined by the smoothness only" : "as smooth as possible and not measured") +
        list(hole_lines(fitted.holes, input.poses.front().time, most_lines));
  }
  if (fitted.regularized_control_points == 0) return text;
  return text + formatted("regularised: %zu of %zu control points, which poses alone do not determine\n",
                          fitted.regularized_control_points, fitted.control_points.size());
}

std::string condition_warning(double condition) {
  if (condition <= 1e10) return "";
  if (!std::isfinite(condition)) {
    return "some control points are not determined at all, neither by poses nor by smoothness (a longer "
           "--knot-interval, or --smooth-position)";
  }
  return formatted("condition %.2g: about %.0f of the curve's 16 digits are lost where the poses determine it least",
                   condition, std::log10(condition));
}

/// Warns of the longest interval without poses, if it is long for the curve and is not reported as a hole.
std::string sparse_warning(const Poses& poses, const FittedTrajectory& fitted, bool with_imu) {
  if (with_imu) return "";
  const nanoseconds limit = fitted.interval ? 2 * *fitted.interval : after(nanoseconds(0), 10 * median_interval(poses));
  std::size_t longest = 1;
  for (std::size_t i = 2; i < poses.size(); ++i) {
    if (poses[i].time - poses[i - 1].time > poses[longest].time - poses[longest - 1].time) longest = i;
  }
  const nanoseconds from = poses[longest - 1].time, to = poses[longest].time;
  const bool reported = std::any_of(fitted.holes.begin(), fitted.holes.end(),
                                    [&](const Hole& hole) { return hole.start < to && hole.end > from; });
  if (to - from <= limit || reported) return "";
  return formatted(
      "from %.3f to %.3f s there are no poses: neighbouring poses determine the curve there, but hardly its "
      "derivatives",
      to_seconds<double>(from - poses.front().time), to_seconds<double>(to - poses.front().time));
}

std::string tried_warning(const FittedTrajectory& fitted) {
  if (fitted.tried.size() < 2) return "";
  const auto best = std::min_element(fitted.tried.begin(), fitted.tried.end(),
                                     [](const auto& a, const auto& b) { return a.error < b.error; });
  if (best + 2 < fitted.tried.end()) return "";
  return "cross-validation chooses nearly the shortest interval that the poses determine: their noise is correlated "
         "from pose to pose (smoothed by an estimator?), choose the interval in another way";
}

/// Warnings, one line each; some may be empty.
std::vector<std::string> warnings(const FitInput& input, const FittedTrajectory& fitted, const FitChoices& o,
                                  bool with_imu, const Extremes& found) {
  std::vector<std::string> lines{not_converged(fitted, o), condition_warning(fitted.condition)};
  const double share = static_cast<double>(fitted.outliers.size()) / static_cast<double>(input.poses.size());
  if (share > 0.02 && fitted.outliers.size() > 5) {
    lines.push_back(
        formatted("%.2g %% of the poses are outliers: their noise is not normal, or the knots are too far "
                  "apart for parts of the motion",
                  100 * share));
  }
  lines.push_back(sparse_warning(input.poses, fitted, with_imu));
  lines.push_back(tried_warning(fitted));
  for (std::string& line : extremes_warnings(found, fitted)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace

std::string fit_report(const FitInput& input, const FittedTrajectory& fitted, const FitChoices& o, const FitImu* imu,
                       const Extremes& found) {
  const Poses& poses = input.poses;
  const nanoseconds first = poses.front().time, last = poses.back().time;
  std::string text = input.notes;
  text += formatted("%s: %zu poses over %.9g s from %lld to %lld ns, longest interval %.4g s\n",
                    escaped_line(input.file.string()).c_str(), poses.size(), to_seconds<double>(last - first),
                    static_cast<long long>(first.count()), static_cast<long long>(last.count()),
                    to_seconds<double>(longest_interval(poses)));
  text += formatted("spline: order %d on %s, %zu control points\n", o.order,
                    o.group == "split" ? "SO(3) x R^3" : "SE(3)", fitted.control_points.size());
  text += knots_text(fitted, o) + '\n' + fit_text(fitted, o) + '\n';
  if (!fitted.tried.empty()) text += tried_text(fitted);
  text += residuals_text(fitted);
  if (!o.interpolate) text += deviation_text(fitted, o);
  text += extremes_text(found, first);
  text += '\n' + outliers_text(input, fitted, o) + holes_text(input, fitted, o, imu && imu->fit_together);
  if (fitted.imu) text += imu_report(*fitted.imu, *imu);
  for (const std::string& warning : warnings(input, fitted, o, imu && imu->fit_together, found)) {
    if (!warning.empty()) text += "\nwarning: " + warning + '\n';
  }
  return text;
}
