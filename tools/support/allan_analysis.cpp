// SPDX-License-Identifier: MIT
#include "support/allan_analysis.hpp"

#include <algorithm>
#include <array>
#include <splinertia/parallel.hpp>
#include <stdexcept>

#include "support/concat.hpp"

using namespace splinertia;
using allan::Adequacy;

namespace {

/// The estimates of all axes together, if the axes agree, each is described by its terms and none has steps.
std::optional<allan::NoiseEstimates<double>> pooled(const SensorNoise& sensor,
                                                    const std::vector<allan::DifferenceSpectrum<double>>& spectra,
                                                    const allan::IdentifyOptions<double>& options) {
  constexpr double least_agreement = 0.01;
  const bool sound = std::all_of(sensor.axes.begin(), sensor.axes.end(), [](const AxisNoise& axis) {
    return axis.analysis.adequacy() != Adequacy::inadequate && axis.analysis.steps.empty();
  });
  if (!sound || sensor.axes.size() < 2) return std::nullopt;
  auto all = allan::identify_pooled<double>(spectra, options);
  if (!all.fits || all.agreement_probability < least_agreement) return std::nullopt;
  return all;
}

/// Throws std::runtime_error as the analysis of a log does.
SensorNoise analyse_sensor(const SensorLog& sensor, const allan::IdentifyOptions<double>& options, unsigned threads) {
  const auto named = [&sensor](const std::string& axis, const auto& analysis) {
    try {
      return analysis();
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(concat(sensor.path, ": ", sensor_name(sensor.kind), axis, ": ", error.what(),
                                      " (- in --columns leaves an axis out)"));
    }
  };
  SensorNoise noise{sensor.kind,
                    sensor.rate,
                    static_cast<double>(sensor.samples) / sensor.rate,
                    std::vector<AxisNoise>(sensor.axes.size()),
                    {},
                    {}};
  std::vector<std::optional<allan::DifferenceSpectrum<double>>> found(sensor.axes.size());
  for_each_index(Parallel{threads}, sensor.axes.size(), [&](std::size_t i) {
    const AxisLog& axis = sensor.axes[i];
    noise.axes[i] = named(concat(' ', axis.name), [&] {
      const allan::IntegratedSignal<double> signal(axis.values, sensor.rate);
      found[i].emplace(signal);
      AxisNoise one{axis.name, allan::analyse(axis.values, signal, *found[i], options), {}};
      one.findings = findings_of(one.analysis, sensor);
      return one;
    });
  });
  std::vector<allan::DifferenceSpectrum<double>> spectra;
  for (auto& spectrum : found) spectra.push_back(std::move(*spectrum));
  noise.pooled = named("", [&] { return pooled(noise, spectra, options); });
  if (noise.pooled) noise.pooled_finding = descriptions_finding(*noise.pooled, sensor.kind);
  return noise;
}

}  // namespace

std::vector<SensorNoise::Row> SensorNoise::rows() const {
  std::vector<Row> rows;
  Adequacy least = Adequacy::adequate;
  for (const AxisNoise& axis : axes) {
    const Adequacy adequacy = axis.analysis.adequacy();
    const bool disturbed = !axis.analysis.steps.empty() || !axis.analysis.freezes.empty();
    rows.push_back({std::string(1, axis.name), &axis.noise(), adequacy, disturbed});
    least = std::max(least, adequacy);
  }
  if (pooled) rows.push_back({"all", &*pooled, least});
  return rows;
}

LogNoise analyse(const ImuLog& log, const allan::IdentifyOptions<double>& options, unsigned threads) {
  constexpr std::size_t fewest = 100;  // with fewer the intervals are too wide to be useful
  for (const SensorLog& sensor : log.sensors) {
    if (sensor.samples < fewest) {
      throw std::runtime_error(concat(sensor.path, ": ", sensor.samples, " samples, expected at least ", fewest));
    }
  }
  LogNoise result{log.path, log.rate, static_cast<double>(log.samples) / log.rate, options, {}, log.topic};
  for (const SensorLog& sensor : log.sensors) result.sensors.push_back(analyse_sensor(sensor, options, threads));
  return result;
}

std::string_view name(Adequacy adequacy) {
  return std::array<std::string_view, 3>{"adequate", "partial", "inadequate"}[static_cast<std::size_t>(adequacy)];
}
