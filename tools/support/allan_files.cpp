// SPDX-License-Identifier: MIT
#include "support/allan_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <splinertia/io/atomic_file.hpp>
#include <string_view>

#include "support/concat.hpp"
#include "support/formatted.hpp"
#include "support/noise_text.hpp"
#include "support/yaml_text.hpp"

using namespace splinertia;
using allan::Adequacy;
using allan::NoiseTerm;
using Estimate = allan::Estimate<double>;

namespace {

void write_reals(AtomicFile& file, std::initializer_list<double> values) {
  for (const double value : values) {
    file.append(',');
    std::isnan(value) ? file.append("nan") : file.append_real(value);
  }
}

void write_curves(AtomicFile& file, const LogNoise& noise) {
  file.append("#sensor,axis,m,tau [s],terms,deviation,lower,upper,alpha,fitted\n");
  for (const SensorNoise& sensor : noise.sensors) {
    for (const AxisNoise& axis : sensor.axes) {
      for (const auto& point : axis.analysis.curve.points) {
        file.append(concat(sensor_name(sensor.kind), ',', axis.name, ',', point.factor, ','));
        file.append_real(point.tau);
        file.append(',');
        file.append_integer(point.terms);
        write_reals(file, {point.deviation, point.interval.lower, point.interval.upper});
        file.append(',');
        file.append_integer(point.alpha);
        write_reals(file, {axis.noise().deviation(point.tau)});
        file.append('\n');
      }
    }
  }
}

void write_noise(AtomicFile& file, const LogNoise& noise) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  file.append(
      "#sensor,axis,term,detected,estimate,lower,upper,standard_error,unit,time,time_lower,time_upper,status,"
      "adequacy\n");
  for (const SensorNoise& sensor : noise.sensors) {
    for (const auto& row : sensor.rows()) {
      for (const NoiseTerm term : allan::noise_terms) {
        if (!noise.options.candidates.has(term)) continue;
        const Estimate& estimate = (*row.noise)[term];
        const bool timed = term == NoiseTerm::gauss_markov || term == NoiseTerm::warm_up;
        if (timed && !estimate.detected && !estimate.possible) continue;
        file.append(concat(sensor_name(sensor.kind), ',', row.name, ',', symbol(term), ',', estimate.detected ? 1 : 0));
        const bool known = row.noise->considered.has(term);
        const bool holds = row.adequacy != Adequacy::inadequate && known;
        const bool disturbed = row.disturbed && estimate.possible;
        write_reals(file, {disturbed || !known ? nan : estimate.value, holds ? estimate.interval.lower : nan,
                           holds ? estimate.interval.upper : nan, holds ? estimate.standard_error() : nan});
        file.append(concat(',', unit_of(term, sensor.kind)));
        if (timed) {
          const auto& with_time = term == NoiseTerm::warm_up ? row.noise->W : row.noise->G;
          write_reals(file, {with_time.time, holds ? with_time.time_interval.lower : nan,
                             holds ? with_time.time_interval.upper : nan});
        } else {
          file.append(",,,");
        }
        file.append(concat(',',
                           estimate.detected   ? "detected"
                           : estimate.possible ? "possible"
                                               : "absent",
                           ',', name(row.adequacy), '\n'));
      }
    }
  }
}

void write_spectrum(AtomicFile& file, const LogNoise& noise) {
  file.append("#sensor,axis,frequency [Hz],density,fitted,count,used\n");
  for (const SensorNoise& sensor : noise.sensors) {
    for (const AxisNoise& axis : sensor.axes) {
      for (const auto& point : axis.noise().spectrum) {
        file.append(concat(sensor_name(sensor.kind), ',', axis.name));
        write_reals(file, {point.frequency, point.density, point.expected, point.count});
        file.append(point.used ? ",1\n" : ",0\n");
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
  file.append("#sensor,axis,kind,from,to,unit,text\n");
  for (const SensorNoise& sensor : noise.sensors) {
    const std::string name(sensor_name(sensor.kind));
    file.append(concat(name, ",all,log,0"));
    write_reals(file, {sensor.duration});
    file.append(",s," +
                quoted(formatted("%s, %.6g Hz, %s", std::filesystem::path(noise.log).filename().c_str(), sensor.rate,
                                 duration_text(sensor.duration).c_str())) +
                '\n');
    const auto write = [&](const std::string& axis, const Finding& finding) {
      file.append(concat(name, ',', axis, ',', finding.kind));
      write_reals(file, {finding.from, finding.to});
      file.append(',' + finding.unit + ',' + quoted(finding.text) + '\n');
    };
    if (sensor.pooled_finding) write("all", *sensor.pooled_finding);
    for (const AxisNoise& axis : sensor.axes) {
      for (const Finding& finding : axis.findings) write(std::string(1, axis.name), finding);
    }
  }
}

/// The value of a term for estimators, and a comment on where it comes from.
struct Choice {
  double value = 0;
  std::string comment;
};

/// The value of a term from one axis or from all axes. `rank` says how well it is known: axes that their terms describe
/// rank above others; among these, detected terms rank above possible ones, and these above absent ones.
struct Candidate {
  int rank;
  double value;
  std::string axis, comment;
};

Candidate candidate(const SensorNoise::Row& row, NoiseTerm term, double confidence) {
  const Estimate& estimate = (*row.noise)[term];
  const auto& bias = row.noise->G;
  const int described = row.adequacy == Adequacy::inadequate ? 0 : 3;
  Candidate result{described, estimate.interval.upper, row.name,
                   concat("not detected, this is the upper limit with ", confidence * 100, " % confidence")};
  if (estimate.detected) {
    result = {described + 2, estimate.value, row.name, ""};
  } else if (term == NoiseTerm::random_walk && bias.detected) {
    result = {described + 2, bias.value * std::sqrt(2 / bias.time), row.name,
              formatted("of a Gauss-Markov bias of %.3g, which is a random walk over times shorter than its %.3g s",
                        bias.value, bias.time)};
  } else if (estimate.possible && !row.disturbed) {
    result = {described + 1, estimate.value, row.name,
              formatted("possible, not detected: the best estimate, with the upper limit %.3g (see below)",
                        estimate.interval.upper)};
  }
  if (described == 0)
    result.comment +=
        concat(result.comment.empty() ? "" : "; ", "the terms do not describe the log, this is only a rough value");
  return result;
}

Choice choose(const SensorNoise& sensor, NoiseTerm term, double confidence) {
  std::vector<Candidate> candidates;
  for (const auto& row : sensor.rows()) candidates.push_back(candidate(row, term, confidence));
  const auto worst = sensor.pooled
                         ? std::prev(candidates.end())
                         : std::max_element(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
                             return std::pair(a.rank, a.value) < std::pair(b.rank, b.value);
                           });
  std::string comment =
      sensor.pooled ? "from all axes, which agree"
      : candidates.size() > 1
          ? concat("from axis ", worst->axis, ", the largest known value: the axes differ or are not all described")
          : concat("from axis ", worst->axis, ", the only one");
  if (!worst->comment.empty()) comment += "; " + worst->comment;
  return {worst->value, comment};
}

}  // namespace

std::optional<EstimatorNoise> estimator_noise(const LogNoise& noise) {
  EstimatorNoise result;
  result.comments.push_back(concat("Noise of ", noise.log, ", at rest for ", noise.duration, " s."));
  result.imu.update_rate = noise.rate;
  if (noise.topic) result.imu.topic = *noise.topic;
  int found = 0;
  std::vector<std::string> below;
  for (const SensorNoise& sensor : noise.sensors) {
    const std::string sensor_text(sensor_name(sensor.kind));
    const bool gyro = sensor.kind == SensorKind::gyro;
    const auto take = [&](NoiseTerm term, const char* key, double& density) {
      if (!noise.options.candidates.has(term)) return;
      const Choice choice = choose(sensor, term, noise.options.confidence);
      density = choice.value;
      if (density > 0) ++found;
      result.comments.push_back(concat(sensor_text, '_', key, ": ", choice.comment));
    };
    take(NoiseTerm::white, "noise_density", gyro ? result.imu.gyro_noise_density : result.imu.accel_noise_density);
    take(NoiseTerm::random_walk, "random_walk", gyro ? result.imu.gyro_random_walk : result.imu.accel_random_walk);
    for (const auto& row : sensor.rows()) {
      if (sensor.pooled && row.name != "all") continue;
      if (row.adequacy != Adequacy::adequate) {
        below.push_back(concat(sensor_text, ' ', row.name, ": adequacy ", name(row.adequacy)));
      }
      for (const NoiseTerm term : {NoiseTerm::bias_instability, NoiseTerm::rate_ramp, NoiseTerm::warm_up}) {
        const Estimate& estimate = (*row.noise)[term];
        if (!estimate.detected) continue;
        below.push_back(formatted("%s %s: %s %s = %.4g %s is also in the log, but in no value here",
                                  sensor_text.c_str(), row.name.c_str(), std::string(name(term)).c_str(),
                                  std::string(symbol(term)).c_str(), estimate.value,
                                  unit_of(term, sensor.kind).c_str()));
      }
    }
    if (sensor.pooled_finding) below.push_back(concat(sensor_text, ": ", sensor.pooled_finding->text));
    for (const AxisNoise& axis : sensor.axes) {
      for (const Finding& finding : axis.findings) {
        if (finding.warning || (finding.kind == "descriptions" && !sensor.pooled)) {
          below.push_back(concat(finding.warning ? "WARNING " : "", sensor_text, ' ', axis.name, ": ", finding.text));
        }
      }
    }
  }
  if (found < 4) return std::nullopt;
  result.comments.insert(result.comments.end(), below.begin(), below.end());
  return result;
}

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
