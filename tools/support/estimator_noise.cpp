// SPDX-License-Identifier: MIT
#include "support/estimator_noise.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "support/concat.hpp"
#include "support/formatted.hpp"
#include "support/noise_text.hpp"

using namespace splinertia;
using allan::Adequacy;
using allan::NoiseTerm;
using Estimate = allan::Estimate<double>;

namespace {

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

/// Sets the two densities of a sensor, and adds a comment on each. Returns how many of them are known.
int take_densities(const SensorNoise& sensor, const LogNoise& noise, EstimatorNoise& result) {
  const bool gyro = sensor.kind == SensorKind::gyro;
  int found = 0;
  const auto take = [&](NoiseTerm term, const char* key, double& density) {
    if (!noise.options.candidates.has(term)) return;
    const Choice choice = choose(sensor, term, noise.options.confidence);
    density = choice.value;
    if (density > 0) ++found;
    result.comments.push_back(concat(sensor_name(sensor.kind), '_', key, ": ", choice.comment));
  };
  take(NoiseTerm::white, "noise_density", gyro ? result.imu.gyro_noise_density : result.imu.accel_noise_density);
  take(NoiseTerm::random_walk, "random_walk", gyro ? result.imu.gyro_random_walk : result.imu.accel_random_walk);
  return found;
}

/// Adds lines on what the two densities of a sensor do not say.
void add_remarks(const SensorNoise& sensor, std::vector<std::string>& lines) {
  const std::string sensor_text(sensor_name(sensor.kind));
  for (const auto& row : sensor.rows()) {
    if (sensor.pooled && row.name != "all") continue;
    if (row.adequacy != Adequacy::adequate) {
      lines.push_back(concat(sensor_text, ' ', row.name, ": adequacy ", name(row.adequacy)));
    }
    for (const NoiseTerm term : {NoiseTerm::bias_instability, NoiseTerm::rate_ramp, NoiseTerm::warm_up}) {
      const Estimate& estimate = (*row.noise)[term];
      if (!estimate.detected) continue;
      lines.push_back(formatted("%s %s: %s %s = %.4g %s is also in the log, but in no value here", sensor_text.c_str(),
                                row.name.c_str(), std::string(name(term)).c_str(), std::string(symbol(term)).c_str(),
                                estimate.value, unit_of(term, sensor.kind).c_str()));
    }
  }
  if (sensor.pooled_finding) lines.push_back(concat(sensor_text, ": ", sensor.pooled_finding->text));
  for (const AxisNoise& axis : sensor.axes) {
    for (const Finding& finding : axis.findings) {
      if (finding.warning || (finding.kind == "descriptions" && !sensor.pooled)) {
        lines.push_back(concat(finding.warning ? "WARNING " : "", sensor_text, ' ', axis.name, ": ", finding.text));
      }
    }
  }
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
    found += take_densities(sensor, noise, result);
    add_remarks(sensor, below);
  }
  if (found < 4) return std::nullopt;
  result.comments.insert(result.comments.end(), below.begin(), below.end());
  return result;
}
