// SPDX-License-Identifier: MIT
// The options for fitting a curve to poses, shared by several programs.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

struct FitChoices {
  int order = 4;
  std::string group = "split";

  // How knots are placed: at most one of these. By default the program chooses an interval.
  std::optional<double> knot_interval;                 // s
  std::optional<double> goal_position, goal_rotation;  // m, rad
  bool cross_validate = false, adaptive = false, interpolate = false;

  std::string loss = "huber";
  std::optional<double> position_deviation, rotation_deviation;  // m, rad
  std::optional<double> position_density, rotation_density;      // of the derivative
  int smooth_derivative = 2;
  double outlier_limit = 6;
  int most_iterations = 100;
  bool accept = false;
};

/// Adds the options of a fit. `trajectory` is the option for the file of poses. If it is optional, the added options
/// need it.
void add_fit_options(CLI::App& app, FitChoices& choices, CLI::Option* trajectory);

/// Throws std::invalid_argument, naming the option, for numbers out of range and options that exclude each other.
void check(const FitChoices& choices);

/// Throws std::invalid_argument unless a number that was given is finite and > 0.
void check_positive(const char* option, std::optional<double> number);
