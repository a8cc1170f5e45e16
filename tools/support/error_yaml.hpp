// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "support/any_error_model.hpp"

/// An IMU from a YAML file that lists its terms, in the order in which they apply:
///
///   gyro:
///     - misalignment: {percent: [[0.1, 0.05, 0], [0, 0.1, 0], [0, 0, 0.1]]}
///     - random_walk: 5e-5                    # a term with one parameter: one number, or one for each axis
///     - white_noise: 0.66 deg/sqrt(h)        # SI, or one of the units of data sheets
///     - gauss_markov: {standard_deviation: 1e-3, correlation_time: [100, 100, 300]}
///   accel: []                                # ideal, as if it were left out
///   stamps:
///     - clock_offset: 3 ms
///
/// Throws std::runtime_error with file, line and what was expected.
[[nodiscard]] AnyImu read_error_yaml(const std::filesystem::path& path);

/// Help on such files: a line for each term with its parameters.
[[nodiscard]] std::string error_yaml_help();
