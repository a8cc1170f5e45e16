// SPDX-License-Identifier: MIT
#include "compare_trajectories/output.hpp"

#include <cstdio>
#include <random>
#include <splinertia/group/sophus.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/units.hpp>
#include <string>
#include <system_error>

#include "support/concat.hpp"
#include "support/csv_table.hpp"
#include "support/formatted.hpp"
#include "support/python_script.hpp"

using namespace splinertia;

namespace {

void print_offset(const Comparison& c, const Options& o) {
  const auto& found = c.estimated_offset;
  if (c.time_offset == 0 && !found) return;
  std::printf("time offset: %.9g s", c.time_offset);
  if (found) std::printf(" +- %.2g s", found->standard_deviation);
  std::printf(" added to the stamps of the estimate");
  if (found && o.time_offset != 0) std::printf(", %.9g s given and %.9g s found", o.time_offset, found->offset);
  if (found) {
    std::printf("; from angular speeds over %.4g s, correlation %.4g", found->window, found->correlation);
  }
  std::puts("");
}

/// A temporary file, removed by the destructor.
class TemporaryFile {
 public:
  TemporaryFile()
      : path(std::filesystem::temp_directory_path() / concat("compare_trajectories.", std::random_device{}(), ".csv")) {
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  const std::filesystem::path path;
};

}  // namespace

void print(const Comparison& c, std::size_t reference_poses, std::size_t estimate_poses, const Options& o) {
  std::printf("reference %s: %zu poses\nestimate  %s: %zu poses\n", o.reference.file.string().c_str(), reference_poses,
              o.estimate.file.string().c_str(), estimate_poses);
  print_offset(c, o);
  std::printf("%zu pairs at most %g s apart\n", c.pairs.size(), o.max_difference);
  const Eigen::Vector3d turn = GroupTraits<Sophus::SO3d>::log(c.transform.rotation) / units::degree;
  const Eigen::Vector3d& move = c.transform.translation;
  const std::string poses = o.align_poses ? concat(" of the first ", *o.align_poses, " pairs") : "";
  std::printf("alignment %s%s: rotation vector (%.6g %.6g %.6g) deg, translation (%.6g %.6g %.6g) m, scale %.9g\n",
              o.align.c_str(), poses.c_str(), turn.x(), turn.y(), turn.z(), move.x(), move.y(), move.z(),
              c.transform.scale);
  if (c.no_relative.empty()) {
    std::printf("RPE over %g %s, %s pairs\n\n", o.delta, o.delta == 1 && o.unit == "frames" ? "frame" : o.unit.c_str(),
                o.all_pairs ? "all" : "consecutive");
  } else {
    std::printf("no RPE: %s\n\n", c.no_relative.c_str());
  }
  std::puts("error                 count       rmse       mean     median        std        min        max        sse");
  bool of_drift = false;
  for (const auto& [metric, part, unit, e] : c.rows) {
    if (!of_drift && metric.starts_with("drift")) {
      of_drift = true;
      std::puts(
          "\nerror                         count       rmse       mean     median        std        min        max");
    }
    const std::string label =
        formatted(of_drift ? "%-11s %-11s [%-5s]" : "%s %-11s [%-3s]", metric.c_str(), part.c_str(), unit.c_str());
    std::printf("%s %5zu %10.4g %10.4g %10.4g %10.4g %10.4g %10.4g", label.c_str(), e.count, e.rmse, e.mean, e.median,
                e.standard_deviation, e.min, e.max);
    std::printf(of_drift ? "\n" : " %10.4g\n", e.sse);
  }
  if (!c.no_drift.empty()) std::printf("\n%s\n", c.no_drift.c_str());
}

void write_table(const std::filesystem::path& path, const Comparison& c, FileSet& files) {
  AtomicFile file(path);
  CsvTable table(file, {"metric", "part", "unit", "count", "rmse", "mean", "median", "std", "min", "max", "sse"});
  for (const auto& [metric, part, unit, e] : c.rows) {
    table.row(metric, part, unit, e.count, e.rmse, e.mean, e.median, e.standard_deviation, e.min, e.max, e.sse);
  }
  file.commit(files);
}

void write_errors(const std::filesystem::path& path, const Comparison& c, FileSet& files) {
  AtomicFile file(path);
  CsvTable table(file, {"#timestamp [ns]", "reference_x [m]", "reference_y [m]", "reference_z [m]", "estimate_x [m]",
                        "estimate_y [m]", "estimate_z [m]", "translation_error [m]", "rotation_error [deg]"});
  for (std::size_t i = 0; i < c.pairs.size(); ++i) {
    const auto& [time, reference, estimate] = c.pairs[i];
    table.row(time, position(reference), position(estimate), c.absolute[i].translation,
              c.absolute[i].rotation / units::degree);
  }
  file.commit(files);
}

void plot(const Comparison& c, const Options& o) {
  const TemporaryFile errors;
  FileSet files;
  write_errors(errors.path, c, files);
  files.commit();
  const std::string title = concat(o.estimate.file.filename().string(), " against ",
                                   o.reference.file.filename().string(), ", aligned: ", o.align);
  PythonScript(o.python, "plot_comparison.py", {errors.path.string(), o.plot.string(), "--title", title},
               PythonScript::Output::shared)
      .finish();
}
