// SPDX-License-Identifier: MIT
#include "support/allan_report.hpp"

#include <cstdio>
#include <splinertia/errors/error_term.hpp>
#include <string>
#include <vector>

#include "support/formatted.hpp"
#include "support/noise_text.hpp"

using namespace splinertia;
using allan::Adequacy;
using allan::NoiseTerm;
using Estimate = allan::Estimate<double>;

namespace {

bool is_timed(NoiseTerm term) { return term == NoiseTerm::gauss_markov || term == NoiseTerm::warm_up; }

void print_table(const SensorNoise& sensor, const LogNoise& noise) {
  std::printf(
      "\n%s\nterm                   axis    estimate   %4.4g %% interval           unit                data sheet\n",
      std::string(sensor_name(sensor.kind)).c_str(), noise.options.confidence * 100);
  for (const NoiseTerm term : allan::noise_terms) {
    if (!noise.options.candidates.has(term)) continue;
    std::string label = formatted("%s  %s", std::string(symbol(term)).c_str(), std::string(name(term)).c_str());
    for (const auto& row : sensor.rows()) {
      const Estimate& estimate = (*row.noise)[term];
      if (is_timed(term) && !estimate.detected && !estimate.possible) continue;
      const bool holds = row.adequacy != Adequacy::inadequate && row.noise->considered.has(term);
      std::string found;
      if (estimate.detected && holds) {
        found =
            formatted("%11.5g   %10.4g ... %-10.4g", estimate.value, estimate.interval.lower, estimate.interval.upper);
      } else if (estimate.detected) {
        found = formatted("%11.5g   no interval: see below   ", estimate.value);
      } else if (estimate.possible) {
        found = holds && !row.disturbed
                    ? formatted("  perhaps %-9.4g   0 ... %-10.4g", estimate.value, estimate.interval.upper)
                    : "not determined: see below            ";
      } else {
        found = holds ? formatted(" not found   below %-14.4g    ", estimate.interval.upper)
                      : "not determined: see below            ";
      }
      const bool value = estimate.detected || (estimate.possible && holds && !row.disturbed);
      const bool limit = holds && !estimate.detected && !(estimate.possible && row.disturbed);
      const std::string sheet =
          value || limit ? data_sheet_text(term, sensor.kind, value ? estimate.value : estimate.interval.upper) : "";
      std::printf("%-22s %-4s %-37s %-18s%s%s\n", label.c_str(), row.name.c_str(), found.c_str(),
                  unit_of(term, sensor.kind).c_str(), value || sheet.empty() ? "  " : "< ", sheet.c_str());
      label.clear();
    }
  }
}

void print_meanings(const SensorNoise::Row& row, const SensorNoise& sensor, const LogNoise& noise) {
  const std::string who = row.name == "all" ? "all axes" : row.name;
  std::vector<std::string> missing;
  for (const NoiseTerm term : allan::noise_terms) {
    if (!noise.options.candidates.has(term)) continue;
    const Estimate& estimate = (*row.noise)[term];
    const auto& timed = term == NoiseTerm::warm_up ? row.noise->W : row.noise->G;
    if (estimate.detected) {
      std::string text = meaning(term, sensor.kind, sensor.rate, estimate.value, timed.time);
      if (is_timed(term)) {
        text += formatted(" (time constant %.3g ... %.3g s)", timed.time_interval.lower, timed.time_interval.upper);
      }
      if (term == NoiseTerm::random_walk) {
        text += formatted("; it may be bounded, with a correlation time of at least %.3g s",
                          row.noise->least_correlation_time);
      }
      std::printf("%s: %s: %s\n", who.c_str(), std::string(name(term)).c_str(), text.c_str());
    } else if (!estimate.possible && !is_timed(term) && row.noise->considered.has(term)) {
      missing.emplace_back(name(term));
    }
  }
  if (!missing.empty() && row.adequacy != Adequacy::inadequate) {
    std::printf("%s: not detected in %s: %s\n", who.c_str(), duration_text(sensor.duration).c_str(),
                list_of(missing).c_str());
  }
  std::printf("%s: adequacy: %s\n", who.c_str(), std::string(name(row.adequacy)).c_str());
  if (row.noise->fits && row.adequacy != Adequacy::inadequate) {
    std::printf("%s: the used part of the spectrum agrees with these terms (goodness of fit: p = %.2g)\n", who.c_str(),
                row.noise->fit_probability);
  }
}

void print_findings(const SensorNoise& sensor, const LogNoise& noise) {
  std::puts("");
  const auto rows = sensor.rows();
  for (const auto& row : rows) {
    if (!sensor.pooled || row.name == "all") print_meanings(row, sensor, noise);
  }
  if (rows.size() > 1) {
    std::puts(sensor.pooled ? "the axes agree"
                            : "the axes differ, or are not all described by their terms: no values for all axes");
  }
  if (sensor.pooled_finding) std::printf("all axes: %s\n", sensor.pooled_finding->text.c_str());
  for (const AxisNoise& axis : sensor.axes) {
    for (const Finding& finding : axis.findings) {
      // A good fit has already been printed. The descriptions of all axes together replace those of each axis.
      if (finding.kind == "fit" && !finding.warning) continue;
      if (finding.kind == "descriptions" && sensor.pooled) continue;
      std::printf("%c: %s\n", axis.name, finding.text.c_str());
    }
  }
}

}  // namespace

void print_report(const ImuLog& log, const LogNoise& noise) {
  std::printf("%s: %zu samples, %s\n", log.path.c_str(), log.samples, duration_text(noise.duration).c_str());
  for (const std::string& line : log.report) std::puts(line.c_str());
  std::printf("units: %s\n", log.units.c_str());
  for (const SensorNoise& sensor : noise.sensors) {
    print_table(sensor, noise);
    print_findings(sensor, noise);
  }
  std::puts("");
}
