// SPDX-License-Identifier: MIT
#include "support/fit_choices.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "support/concat.hpp"

namespace {

void add_knot_options(CLI::App& app, FitChoices& o, const auto& place) {
  const auto add = [&](CLI::Option* option) { place(option, "Knots, one of"); };
  add(app.add_option("--knot-interval", o.knot_interval,
                     "interval between knots [s]; by default the program chooses and reports it"));
  add(app.add_option("--goal-position", o.goal_position,
                     "choose the longest interval with at most these position residuals, rms of each axis [m]"));
  add(app.add_option("--goal-rotation", o.goal_rotation, "and at most these rotation residuals [rad]"));
  add(app.add_flag("--adaptive", o.adaptive, "place knots closer where the motion needs it, to meet both goals"));
  add(app.add_flag("--cross-validate", o.cross_validate, "choose the interval that best predicts left-out poses"));
  add(app.add_flag("--interpolate", o.interpolate, "place a knot at each pose: the curve goes through all poses"));
}

void add_smoothness_options(CLI::App& app, FitChoices& o, const auto& add) {
  auto* position = app.add_option("--deviation-position", o.position_deviation,
                                  "standard deviation of a pose's position [m]; default: found in the residuals");
  auto* rotation =
      app.add_option("--deviation-rotation", o.rotation_deviation, "standard deviation of a pose's rotation [rad]");
  auto* smooth_position = app.add_option("--smooth-position", o.position_density,
                                         "smooth as if the derivative were white noise of this density "
                                         "[m/s^2/sqrt(Hz)], or [m/s^3/sqrt(Hz)]; also for knots closer than poses");
  auto* smooth_rotation = app.add_option("--smooth-rotation", o.rotation_density,
                                         "the same for rotation [rad/s^2/sqrt(Hz)], or [rad/s^3/sqrt(Hz)]");
  add(position->needs(rotation));
  add(rotation->needs(position));
  add(smooth_position->needs(smooth_rotation)->needs(position));
  add(smooth_rotation->needs(smooth_position));
  add(app.add_option("--smooth-derivative", o.smooth_derivative, "derivative to smooth, 2: acceleration, 3: jerk")
          ->check(CLI::Range(2, 3))
          ->needs(smooth_position)
          ->capture_default_str());
}

/// Throws std::invalid_argument if the goals are incomplete, or more than one way to place knots is chosen.
void check_knots(const FitChoices& o) {
  if (o.goal_position.has_value() != o.goal_rotation.has_value()) {
    throw std::invalid_argument("--goal-position and --goal-rotation: expected both or none");
  }
  if (o.adaptive && !o.goal_position) {
    throw std::invalid_argument(
        "--adaptive: expected --goal-position and --goal-rotation, which the knots have to meet");
  }
  const std::pair<bool, const char*> ways[] = {{o.knot_interval.has_value(), "--knot-interval"},
                                               {o.goal_position && !o.adaptive, "--goal-position"},
                                               {o.adaptive, "--adaptive"},
                                               {o.cross_validate, "--cross-validate"},
                                               {o.interpolate, "--interpolate"}};
  const char* chosen = nullptr;
  for (const auto& [given, name] : ways) {
    if (!given) continue;
    if (chosen) throw std::invalid_argument(concat(chosen, " and ", name, ": expected one way to place knots"));
    chosen = name;
  }
}

}  // namespace

void add_fit_options(CLI::App& app, FitChoices& o, CLI::Option* trajectory) {
  const auto place = [&](CLI::Option* option, const char* group) {
    option->group(group);
    if (!trajectory->get_required()) option->needs(trajectory);
  };
  const auto add = [&](CLI::Option* option) { place(option, "Fit to the poses"); };
  add(app.add_option("--order", o.order, "order of the spline: degree + 1")
          ->check(CLI::Range(3, 6))
          ->capture_default_str());
  add(app.add_option("--group", o.group, "group of the spline: split is SO(3) x R^3, se3 is SE(3)")
          ->check(CLI::IsMember({"split", "se3"}))
          ->capture_default_str());
  add_knot_options(app, o, place);
  add(app.add_option("--loss", o.loss, "loss function of the residuals")
          ->check(CLI::IsMember({"squares", "huber", "cauchy"}))
          ->capture_default_str());
  add_smoothness_options(app, o, add);
  add(app.add_option("--outlier-limit", o.outlier_limit, "number of standard deviations above which a pose is reported")
          ->capture_default_str());
  add(app.add_option("--most-iterations", o.most_iterations, "largest number of linear systems to solve")
          ->check(CLI::Range(1, 1000000))
          ->capture_default_str());
  add(app.add_flag("--accept", o.accept, "write the files even if the fit has not converged"));
}

void check_positive(const char* option, std::optional<double> number) {
  if (number && !(*number > 0 && std::isfinite(*number))) {
    throw std::invalid_argument(concat(option, ": ", *number, ", expected a finite number > 0"));
  }
}

void check(const FitChoices& o) {
  check_knots(o);
  if (o.interpolate && o.order % 2 != 0) {
    throw std::invalid_argument(concat("--interpolate: order ", o.order, ", expected an even order"));
  }
  if (o.interpolate && (o.position_deviation || o.position_density)) {
    throw std::invalid_argument(
        "--interpolate: expected no deviations and no smoothness, since the curve goes through every pose");
  }
  if (o.position_density && o.smooth_derivative >= o.order) {
    throw std::invalid_argument(concat("--smooth-derivative: ", o.smooth_derivative, " with --order ", o.order,
                                       ", expected a derivative below the order"));
  }
  if (o.knot_interval && !(*o.knot_interval >= 1e-6 && *o.knot_interval <= 1e6)) {
    throw std::invalid_argument(concat("--knot-interval: ", *o.knot_interval, ", expected 1e-6 to 1e6 seconds"));
  }
  check_positive("--goal-position", o.goal_position);
  check_positive("--goal-rotation", o.goal_rotation);
  check_positive("--deviation-position", o.position_deviation);
  check_positive("--deviation-rotation", o.rotation_deviation);
  check_positive("--smooth-position", o.position_density);
  check_positive("--smooth-rotation", o.rotation_density);
  check_positive("--outlier-limit", o.outlier_limit);
}
