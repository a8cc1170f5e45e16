// SPDX-License-Identifier: MIT
#include "support/allan_files.hpp"

#include <array>
#include <cstdio>
#include <deque>
#include <limits>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <string>
#include <string_view>

#include "support/csv_table.hpp"
#include "support/estimator_noise.hpp"
#include "support/formatted.hpp"
#include "support/noise_text.hpp"
#include "support/yaml_text.hpp"

using namespace splinertia;
using allan::Adequacy;
using allan::NoiseTerm;
using Estimate = allan::Estimate<double>;

namespace {

void write_curves(AtomicFile& file, const LogNoise& noise) {
  CsvTable table(file, {"#sensor", "axis", "m", "tau [s]", "terms", "deviation", "lower", "upper", "alpha", "fitted"});
  for (const SensorNoise& sensor : noise.sensors) {
    for (const AxisNoise& axis : sensor.axes) {
      for (const auto& point : axis.analysis.curve.points) {
        table.row(sensor_name(sensor.kind), axis.name, point.factor, point.tau, point.terms, RealOrNan{point.deviation},
                  RealOrNan{point.interval.lower}, RealOrNan{point.interval.upper}, point.alpha,
                  RealOrNan{axis.noise().deviation(point.tau)});
      }
    }
  }
}

/// Writes the row of one term, unless it is one with a time and is absent.
void write_term(CsvTable& table, const SensorNoise& sensor, const SensorNoise::Row& row, NoiseTerm term) {
  const Estimate& estimate = (*row.noise)[term];
  const bool timed = term == NoiseTerm::gauss_markov || term == NoiseTerm::warm_up;
  if (timed && !estimate.detected && !estimate.possible) return;
  const bool known = row.noise->considered.has(term);
  const bool holds = row.adequacy != Adequacy::inadequate && known;
  const bool disturbed = row.disturbed && estimate.possible;
  const auto number = [](bool usable, double value) {
    return RealOrNan{usable ? value : std::numeric_limits<double>::quiet_NaN()};
  };
  std::array<std::optional<RealOrNan>, 3> times{};  // empty cells for the terms without a time
  if (timed) {
    const auto& with_time = term == NoiseTerm::warm_up ? row.noise->W : row.noise->G;
    times = {RealOrNan{with_time.time}, number(holds, with_time.time_interval.lower),
             number(holds, with_time.time_interval.upper)};
  }
  table.row(sensor_name(sensor.kind), row.name, symbol(term), estimate.detected,
            number(!disturbed && known, estimate.value), number(holds, estimate.interval.lower),
            number(holds, estimate.interval.upper), number(holds, estimate.standard_error()),
            unit_of(term, sensor.kind), times,
            estimate.detected   ? "detected"
            : estimate.possible ? "possible"
                                : "absent",
            name(row.adequacy));
}

void write_noise(AtomicFile& file, const LogNoise& noise) {
  CsvTable table(file, {"#sensor", "axis", "term", "detected", "estimate", "lower", "upper", "standard_error", "unit",
                        "time", "time_lower", "time_upper", "status", "adequacy"});
  for (const SensorNoise& sensor : noise.sensors) {
    for (const auto& row : sensor.rows()) {
      for (const NoiseTerm term : allan::noise_terms) {
        if (noise.options.candidates.has(term)) write_term(table, sensor, row, term);
      }
    }
  }
}

void write_spectrum(AtomicFile& file, const LogNoise& noise) {
  CsvTable table(file, {"#sensor", "axis", "frequency [Hz]", "density", "fitted", "count", "used"});
  for (const SensorNoise& sensor : noise.sensors) {
    for (const AxisNoise& axis : sensor.axes) {
      for (const auto& point : axis.noise().spectrum) {
        table.row(sensor_name(sensor.kind), axis.name, RealOrNan{point.frequency}, RealOrNan{point.density},
                  RealOrNan{point.expected}, RealOrNan{point.count}, point.used);
      }
    }
  }
}

/// A field of a csv file in quotation marks, with control characters escaped so that it stays on one line.
std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : escaped_line(text)) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + '"';
}

void write_findings(AtomicFile& file, const LogNoise& noise) {
  CsvTable table(file, {"#sensor", "axis", "kind", "from", "to", "unit", "text"});
  for (const SensorNoise& sensor : noise.sensors) {
    const std::string_view name = sensor_name(sensor.kind);
    table.row(name, "all", "log", 0, RealOrNan{sensor.duration}, "s",
              quoted(formatted("%s, %.6g Hz, %s", std::filesystem::path(noise.log).filename().c_str(), sensor.rate,
                               duration_text(sensor.duration).c_str())));
    const auto write = [&](const auto& axis, const Finding& finding) {
      table.row(name, axis, finding.kind, RealOrNan{finding.from}, RealOrNan{finding.to}, finding.unit,
                quoted(finding.text));
    };
    if (sensor.pooled_finding) write("all", *sensor.pooled_finding);
    for (const AxisNoise& axis : sensor.axes) {
      for (const Finding& finding : axis.findings) write(axis.name, finding);
    }
  }
}

}  // namespace

void write_files(const LogNoise& noise, OutputFolder& folder, const std::vector<Estimator>& for_estimators) {
  std::deque<AtomicFile> files;
  const auto add = [&](std::string_view name) -> AtomicFile& { return files.emplace_back(folder.path(name)); };
  write_curves(add("curves.csv"), noise);
  write_noise(add("noise.csv"), noise);
  write_spectrum(add("spectrum.csv"), noise);
  write_findings(add("findings.csv"), noise);
  const auto found = estimator_noise(noise);
  if (found) {
    for (const Estimator estimator : for_estimators) {
      add(file_name(estimator)).append(imu_noise_text(estimator, found->imu, found->comments));
    }
  }
  // curves.csv, which every reader needs, appears last.
  for (auto file = files.rbegin(); file != files.rend(); ++file) file->commit(folder.files());
  const std::string names = folder.commit();
  std::printf("wrote %s to %s\n", names.c_str(), folder.path().c_str());
  if (!found) std::puts("no files for estimators: they need N and K of both sensors");
}
