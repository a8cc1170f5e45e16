// SPDX-License-Identifier: MIT
#include <iomanip>
#include <ostream>
#include <sstream>

#include "golden_checks.hpp"

namespace golden {

namespace {

struct Kind {
  std::string_view file;
  void (*check)(const Table&, Report&);
};

constexpr Kind kinds[] = {
    {"lie_coeffs", check_lie_coeffs},
    {"so3_lie", check_so3_lie},
    {"so3_log", check_so3_log},
    {"se3_lie", check_se3_lie},
    {"se3_log", check_se3_log},
    {"basis_matrix", check_basis_matrix},
    {"basis_uniform", check_basis_uniform},
    {"basis_nonuniform", check_basis_nonuniform},
    {"so3_spline", check_so3_spline},
    {"so3_spline_inc", check_so3_spline_inc},
    {"so3r3_spline", check_so3r3_spline},
    {"se3_spline", check_se3_spline},
    {"se3_spline_inc", check_se3_spline_inc},
    {"jac_so3", check_jac_so3},
    {"jac_se3", check_jac_se3},
    {"imu_spline", check_imu_spline},
    {"imu_truth", check_imu_truth},
    {"strapdown_truth", check_strapdown_truth},
    {"preint", check_preint},
    {"camera_project", check_camera_project},
    {"camera_unproject", check_camera_unproject},
    {"rolling_shutter", check_rolling_shutter},
};

[[nodiscard]] std::string figure(double c) {
  if (c < 0) return "-";
  std::ostringstream text;
  text << std::setprecision(3) << c;
  return text.str();
}

[[nodiscard]] bool failed(const Line& line) { return line.worst_share > 1; }

void print_line(std::ostream& out, const Line& line) {
  out << std::left << std::setw(17) << line.file << std::setw(34) << (line.label.empty() ? "-" : line.label)
      << std::setw(12) << line.scalar << std::right << std::setw(6) << line.rows << std::setw(8) << line.skipped
      << std::setw(10) << figure(line.worst[0]) << std::setw(10) << figure(line.worst[1]) << "  "
      << (line.worst_row.empty() ? "-" : line.worst_row + " " + line.worst_quantity)
      << (failed(line) ? "  LIMIT PASSED" : "") << '\n';
}

void print_head(std::ostream& out) {
  out << std::left << std::setw(17) << "file" << std::setw(34) << "class" << std::setw(12) << "scalar" << std::right
      << std::setw(6) << "rows" << std::setw(8) << "skipped" << std::setw(10) << "C (A)" << std::setw(10) << "C (B)"
      << "  worst row\n";
}

/// The lines of one file and scalar as one.
void add(Line& sum, const Line& line) {
  sum.rows += line.rows;
  sum.skipped += line.skipped;
  for (int grade = 0; grade < 2; ++grade) sum.worst[grade] = std::max(sum.worst[grade], line.worst[grade]);
  if (line.worst_share > sum.worst_share) {
    sum.worst_share = line.worst_share;
    sum.worst_row = line.worst_row;
    sum.worst_quantity = line.worst_quantity;
  }
}

}  // namespace

Line& Report::line(const Row& row, std::string_view scalar) {
  const std::string file = row.table().name();
  const std::string label = row.has("class") ? row.text("class") : "";
  // Rows come in runs of one class: the line looked for is mostly the last.
  for (auto i = lines_.rbegin(); i != lines_.rend(); ++i) {
    if (i->file == file && i->label == label && i->scalar == scalar) return *i;
  }
  Line added;
  added.file = file;
  added.label = label;
  added.scalar = scalar;
  return lines_.emplace_back(std::move(added));
}

void Report::note(std::string_view file, std::string text) { notes_.emplace_back(file, std::move(text)); }

bool Report::passed() const { return std::none_of(lines_.begin(), lines_.end(), failed); }

void Report::print(std::ostream& out) const {
  print_head(out);
  for (const Line& line : lines_) print_line(out, line);
  out << "\nAll classes of a file:\n";
  print_head(out);
  std::vector<Line> sums;
  for (const Line& line : lines_) {
    if (sums.empty() || sums.back().file != line.file || sums.back().scalar != line.scalar) {
      Line sum;
      sum.file = line.file;
      sum.label = "all";
      sum.scalar = line.scalar;
      sums.push_back(std::move(sum));
    }
    add(sums.back(), line);
  }
  for (const Line& line : sums) print_line(out, line);
  for (const auto& [file, text] : notes_) out << file << ": " << text << '\n';
}

void Report::print_failures(std::ostream& out) const {
  if (passed()) return;
  print_head(out);
  for (const Line& line : lines_) {
    if (failed(line)) print_line(out, line);
  }
}

Report check_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw std::runtime_error(folder.string() + ": not a folder");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (files.empty()) throw std::runtime_error(folder.string() + ": no file *.csv in it");
  std::sort(files.begin(), files.end());
  Report report;
  for (const auto& file : files) {
    const Kind* kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.file == file.stem(); });
    if (kind == std::end(kinds)) {
      report.note(file.filename().string(), "unknown file, not checked");
    } else {
      kind->check(Table(file), report);
    }
  }
  return report;
}

}  // namespace golden
