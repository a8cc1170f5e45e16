// SPDX-License-Identifier: MIT
// How far an estimated trajectory is from a reference: absolute and relative errors of position and attitude (ATE and
// RPE) after an alignment, with the definitions and the statistics of evo.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/strapdown/trajectory_error.hpp>
#include <splinertia/units.hpp>
#include <string>
#include <vector>

using namespace splinertia;

namespace {

struct Options {
  std::filesystem::path reference, estimate, csv;
  std::string align = "none";
  double max_difference = 0.01;
  double delta = 1;
  std::string unit = "frames";
  bool all_pairs = false;
};

const std::map<std::string, Alignment> alignments{
    {"none", Alignment::none}, {"origin", Alignment::origin}, {"se3", Alignment::se3}, {"sim3", Alignment::sim3}};

using Pairs = std::vector<PosePair<SO3xR3<double>>>;

struct Row {
  const char *metric, *part, *unit;
  ErrorStatistics<double> errors;
};

IndexPairs index_pairs(const Pairs& pairs, const Options& o) {
  const PairSelection selection = o.all_pairs ? PairSelection::all : PairSelection::consecutive;
  if (o.unit == "m") return index_pairs_by_path(pairs, o.delta, selection);
  if (!(o.delta >= 1 && o.delta <= 1e9) || o.delta != std::floor(o.delta)) {
    throw std::invalid_argument(message("--delta: ", o.delta, ", expected a whole number of frames from 1 on"));
  }
  return index_pairs_by_frames(pairs.size(), static_cast<std::size_t>(o.delta), selection);
}

void write_table(const std::filesystem::path& path, const std::vector<Row>& rows) {
  AtomicFile file(path);
  file.append("metric,part,unit,count,rmse,mean,median,std,min,max,sse\n");
  for (const auto& [metric, part, unit, e] : rows) {
    file.append(message(metric, ',', part, ',', unit, ',', e.count));
    for (const double figure : {e.rmse, e.mean, e.median, e.standard_deviation, e.min, e.max, e.sse}) {
      file.append(',');
      file.append_real(figure);
    }
    file.append('\n');
  }
  file.commit();
}

void run(const Options& o) {
  const auto reference = read_trajectory(o.reference).poses, estimate = read_trajectory(o.estimate).poses;
  const Pairs associated = associate(reference, estimate, o.max_difference);
  const auto transform = alignment(associated, alignments.at(o.align));
  const Pairs pairs = transformed(associated, transform);
  const auto absolute = absolute_errors(pairs);
  const auto relative = relative_errors(pairs, index_pairs(pairs, o));

  const auto meters = [](const PoseError<double>& e) { return e.translation; };
  const auto degrees = [](const PoseError<double>& e) { return e.rotation / units::degree; };
  const std::vector<Row> rows{{"ATE", "translation", "m", error_statistics(absolute, meters)},
                              {"ATE", "rotation", "deg", error_statistics(absolute, degrees)},
                              {"RPE", "translation", "m", error_statistics(relative, meters)},
                              {"RPE", "rotation", "deg", error_statistics(relative, degrees)}};

  std::printf("reference %s: %zu poses\nestimate  %s: %zu poses\n%zu pairs at most %g s apart\n",
              o.reference.string().c_str(), reference.size(), o.estimate.string().c_str(), estimate.size(),
              pairs.size(), o.max_difference);
  const Eigen::Vector3d turn = GroupTraits<Sophus::SO3d>::log(transform.rotation) / units::degree;
  const Eigen::Vector3d& move = transform.translation;
  std::printf("alignment %s: rotation vector (%.6g %.6g %.6g) deg, translation (%.6g %.6g %.6g) m, scale %.9g\n",
              o.align.c_str(), turn.x(), turn.y(), turn.z(), move.x(), move.y(), move.z(), transform.scale);
  std::printf("RPE over %g %s, %s pairs\n\n", o.delta, o.unit.c_str(), o.all_pairs ? "all" : "consecutive");
  std::puts("error                 count       rmse       mean     median        std        min        max        sse");
  for (const auto& [metric, part, unit, e] : rows) {
    std::printf("%s %-11s [%-3s] %5zu %10.4g %10.4g %10.4g %10.4g %10.4g %10.4g %10.4g\n", metric, part, unit, e.count,
                e.rmse, e.mean, e.median, e.standard_deviation, e.min, e.max, e.sse);
  }
  if (!o.csv.empty()) write_table(o.csv, rows);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Compares two trajectories and prints the statistics of absolute (ATE) and relative (RPE) errors, in metres and "
      "degrees, as evo_ape and evo_rpe define them.\n\n"
      "Poses are paired with the nearest in time; the estimate is aligned with the reference if you say how."};
  Options o;
  app.add_option("reference", o.reference, "TUM or EuRoC trajectory, recognised by its content")->required();
  app.add_option("estimate", o.estimate, "the same, to be compared with it")->required();
  app.add_option("--align", o.align,
                 "none; origin: the first poses coincide; se3, sim3: least squares of all positions, sim3 with scale")
      ->check(CLI::IsMember(alignments))
      ->capture_default_str();
  app.add_option("--max-difference", o.max_difference, "between the times of a pair [s]")->capture_default_str();
  app.add_option("--delta", o.delta, "that RPE is taken over: a number of frames, or metres of the estimate's path")
      ->capture_default_str();
  app.add_option("--delta-unit", o.unit, "of that")->check(CLI::IsMember({"frames", "m"}))->capture_default_str();
  app.add_flag("--all-pairs", o.all_pairs, "take RPE from every pose on, overlapping, not one after the other");
  app.add_option("--csv", o.csv, "also write the table to this file, with all digits");
  try {
    app.parse(argc, argv);
    run(o);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare_trajectories: %s\n", error.what());
    return 2;
  }
  return 0;
}
