// SPDX-License-Identifier: MIT
/// The checks of tables of reference values, one function for each kind of table.
#pragma once

#include <filesystem>
#include <string_view>

#include "golden_grade.hpp"

namespace golden {

void check_lie_coeffs(const Table& table, Report& report);
void check_so3_lie(const Table& table, Report& report);
void check_so3_log(const Table& table, Report& report);
void check_se3_lie(const Table& table, Report& report);
void check_se3_log(const Table& table, Report& report);
void check_basis_matrix(const Table& table, Report& report);
void check_basis_uniform(const Table& table, Report& report);
void check_basis_nonuniform(const Table& table, Report& report);
void check_so3_spline(const Table& table, Report& report);
void check_so3_spline_inc(const Table& table, Report& report);
void check_so3r3_spline(const Table& table, Report& report);
void check_se3_spline(const Table& table, Report& report);
void check_se3_spline_inc(const Table& table, Report& report);
void check_jac_so3(const Table& table, Report& report);
void check_jac_se3(const Table& table, Report& report);
void check_imu_truth(const Table& table, Report& report);
void check_imu_spline(const Table& table, Report& report);
void check_strapdown_truth(const Table& table, Report& report);
void check_preint(const Table& table, Report& report);
void check_camera_project(const Table& table, Report& report);
void check_camera_unproject(const Table& table, Report& report);
void check_rolling_shutter(const Table& table, Report& report);

/// Checks every table *.csv of a folder. Throws std::runtime_error when there is none or one cannot be read.
[[nodiscard]] Report check_folder(const std::filesystem::path& folder);

}  // namespace golden
