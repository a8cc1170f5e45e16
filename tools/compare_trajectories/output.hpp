// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <splinertia/io/file_set.hpp>

#include "compare_trajectories/comparison.hpp"
#include "compare_trajectories/options.hpp"

void print(const Comparison& comparison, std::size_t reference_poses, std::size_t estimate_poses,
           const Options& options);

/// Writes the statistics with all digits.
void write_table(const std::filesystem::path& path, const Comparison& comparison, splinertia::FileSet& files);

/// Writes a row for each pair: both positions and the absolute errors.
void write_errors(const std::filesystem::path& path, const Comparison& comparison, splinertia::FileSet& files);

/// Draws the paths and the errors. Throws ScriptFailed if the script has printed the reason, else std::runtime_error.
void plot(const Comparison& comparison, const Options& options);
