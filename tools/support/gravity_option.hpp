// SPDX-License-Identifier: MIT
// The option --gravity of several programs.
#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "support/concat.hpp"

/// The acceleration of free fall in the world, m/s².
struct GravityOption {
  Eigen::Vector3d vector{0, 0, -9.80665};
};

/// Adds --gravity: three numbers, or a magnitude along -z. The parser rejects a negative magnitude, whose sign would be
/// ambiguous, and numbers that are not finite. Returns the option, for group() and count().
inline CLI::Option* add_gravity_option(CLI::App& app, GravityOption& gravity) {
  const auto read = [&gravity](const std::vector<double>& numbers) {
    const auto refuse = [](const auto&... what) { throw CLI::ValidationError("--gravity", concat(what...)); };
    for (const double number : numbers) {
      if (!std::isfinite(number)) refuse(number, ", expected finite numbers");
    }
    if (numbers.size() == 3) {
      gravity.vector = Eigen::Vector3d(numbers.data());
    } else if (numbers.size() != 1) {
      refuse(numbers.size(), " numbers, expected 1 or 3");
    } else if (numbers[0] < 0) {
      refuse(numbers[0], ", expected a magnitude >= 0, which acts along -z, or a vector x y z");
    } else {
      gravity.vector = {0, 0, -numbers[0]};
    }
  };
  return app
      .add_option_function<std::vector<double>>(
          "--gravity", read, "acceleration of free fall in the world [m/s^2]: x y z, or its magnitude along -z")
      ->expected(1, 3)
      ->check(CLI::Number)
      ->default_str("0 0 -9.80665");
}
