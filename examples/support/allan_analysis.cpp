// SPDX-License-Identifier: MIT
#include "support/allan_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <optional>
#include <splinertia/imu/error_term.hpp>
#include <splinertia/imu/noise_densities.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/message.hpp>
#include <splinertia/parallel.hpp>
#include <splinertia/units.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "support/formatted.hpp"

using namespace splinertia;
using allan::NoiseTerm;
using Estimate = allan::Estimate<double>;

namespace {

/// The unit of a term's coefficient.
std::string unit_of(NoiseTerm term, SensorKind kind) {
  constexpr std::array<SensorUnit, 5> units{SensorUnit{0, true}, SensorUnit{1, true}, SensorUnit{}, SensorUnit{-1},
                                            SensorUnit{1}};  // N, K, B, Q, R
  return unit_text(units[static_cast<std::size_t>(term)], kind);
}

/// The name of an axis with its estimates: the axes, then all together.
std::vector<std::pair<std::string, const allan::NoiseEstimates<double>*>> rows_of(const SensorNoise& sensor) {
  std::vector<std::pair<std::string, const allan::NoiseEstimates<double>*>> rows;
  for (const AxisNoise& axis : sensor.axes) rows.emplace_back(std::string(1, axis.name), &axis.noise);
  rows.emplace_back("all", &sensor.pooled);
  return rows;
}

/// Whether some two axes have intervals without a common value.
bool axes_differ(const SensorNoise& sensor, NoiseTerm term) {
  double highest_lower = 0, lowest_upper = sensor.axes.front().noise[term].interval.upper;
  for (const AxisNoise& axis : sensor.axes) {
    highest_lower = std::max(highest_lower, axis.noise[term].interval.lower);
    lowest_upper = std::min(lowest_upper, axis.noise[term].interval.upper);
  }
  return highest_lower > lowest_upper;
}

/// What to take a coefficient for if it must not be zero.
double value_or_limit(const Estimate& estimate) { return estimate.detected ? estimate.value : estimate.interval.upper; }

const AxisNoise& noisiest(const SensorNoise& sensor, NoiseTerm term) {
  return *std::max_element(sensor.axes.begin(), sensor.axes.end(), [&](const AxisNoise& a, const AxisNoise& b) {
    return value_or_limit(a.noise[term]) < value_or_limit(b.noise[term]);
  });
}

std::string percent(double share) { return message(share * 100, " %"); }

void write_curves(AtomicFile& file, const LogNoise& noise) {
  file.append("#sensor,axis,m,tau [s],terms,deviation,lower,upper,alpha,fitted\n");
  for (const SensorNoise& sensor : noise.sensors) {
    for (const AxisNoise& axis : sensor.axes) {
      for (const auto& point : axis.curve.points) {
        file.append(message(sensor_name(sensor.kind), ',', axis.name, ',', point.factor, ','));
        file.append_real(point.tau);
        file.append(',');
        file.append_integer(point.terms);
        for (const double value : {point.deviation, point.interval.lower, point.interval.upper}) {
          file.append(',');
          file.append_real(value);
        }
        file.append(',');
        file.append_integer(point.alpha);
        file.append(',');
        file.append_real(axis.noise.deviation(point.tau));
        file.append('\n');
      }
    }
  }
}

void write_noise(AtomicFile& file, const LogNoise& noise) {
  file.append("#sensor,axis,term,detected,estimate,lower,upper,standard_error,unit\n");
  for (const SensorNoise& sensor : noise.sensors) {
    for (const auto& [axis, estimates] : rows_of(sensor)) {
      for (const NoiseTerm term : allan::noise_terms) {
        if (!noise.options.candidates.has(term)) continue;
        const Estimate& estimate = (*estimates)[term];
        file.append(message(sensor_name(sensor.kind), ',', axis, ',', symbol(term), ',', estimate.detected ? 1 : 0));
        for (const double value :
             {estimate.value, estimate.interval.lower, estimate.interval.upper, estimate.standard_error()}) {
          file.append(',');
          file.append_real(value);
        }
        file.append(message(',', unit_of(term, sensor.kind), '\n'));
      }
    }
  }
}

/// A coefficient in units of data sheets; "" if they have none.
std::string data_sheet_text(NoiseTerm term, SensorKind kind, double value) {
  const bool gyro = kind == SensorKind::gyro;
  std::array<char, 100> text{};
  if (term == NoiseTerm::white) {
    // A random walk is N itself, a noise density is one-sided: docs/noise_densities.md.
    const double one_sided = one_sided_density(value);
    std::snprintf(
        text.data(), text.size(),
        gyro ? "%.4g deg/sqrt(h), one-sided %.4g deg/s/sqrt(Hz)" : "%.4g m/s/sqrt(h), one-sided %.4g ug/sqrt(Hz)",
        value / (gyro ? units::degree_per_root_hour : units::meter_per_second_per_root_hour),
        one_sided / (gyro ? units::degree_per_second_per_root_hertz : units::micro_g_per_root_hertz));
  } else if (term == NoiseTerm::random_walk) {
    std::snprintf(text.data(), text.size(), gyro ? "%.4g deg/h/sqrt(h)" : "%.4g ug/sqrt(h)",
                  value / (gyro ? units::degree_per_hour_per_root_hour : units::micro_g_per_root_hour));
  } else if (term == NoiseTerm::bias_instability) {
    std::snprintf(text.data(), text.size(), gyro ? "floor %.4g deg/h" : "floor %.4g ug",
                  allan_floor(value) / (gyro ? units::degree_per_hour : units::micro_g));
  }
  return text.data();
}

void print_table(const SensorNoise& sensor, const LogNoise& noise) {
  std::printf(
      "\n%s\nterm                   axis    estimate   %4.4g %% interval           unit                data sheet\n",
      std::string(sensor_name(sensor.kind)).c_str(), noise.options.confidence * 100);
  for (const NoiseTerm term : allan::noise_terms) {
    if (!noise.options.candidates.has(term)) continue;
    std::string label = message(symbol(term), "  ", name(term));
    for (const auto& [axis, estimates] : rows_of(sensor)) {
      if (estimates == &sensor.pooled && sensor.axes.size() == 1) continue;  // the same again
      const Estimate& estimate = (*estimates)[term];
      std::array<char, 100> found{};
      if (estimate.detected) {
        std::snprintf(found.data(), found.size(), "%11.5g   %10.4g ... %-10.4g", estimate.value,
                      estimate.interval.lower, estimate.interval.upper);
      } else {
        std::snprintf(found.data(), found.size(), " not found   below %-14.4g    ", estimate.interval.upper);
      }
      const std::string sheet = data_sheet_text(term, sensor.kind, value_or_limit(estimate));
      std::printf("%-22s %-4s %s %-18s%s%s\n", label.c_str(), axis.c_str(), found.data(),
                  unit_of(term, sensor.kind).c_str(), estimate.detected || sheet.empty() ? "  " : "< ", sheet.c_str());
      label.clear();
    }
  }
}

/// What a detected coefficient does, so that one can tell whether it matters.
std::string meaning(NoiseTerm term, const SensorNoise& sensor, double value) {
  const SensorKind kind = sensor.kind;
  const std::string unit = unit_text(SensorUnit{}, kind);
  std::array<char, 120> text{};
  switch (term) {
    case NoiseTerm::white:
      std::snprintf(text.data(), text.size(), "a sample at %.6g Hz has a standard deviation of %.4g %s", sensor.rate,
                    white_noise_sigma(value, sensor.rate), unit.c_str());
      break;
    case NoiseTerm::random_walk:
      std::snprintf(text.data(), text.size(), "the bias moves by %.4g %s in an hour", value * std::sqrt(units::hour),
                    unit.c_str());
      break;
    case NoiseTerm::bias_instability:
      std::snprintf(text.data(), text.size(), "no average is better than the floor 0.664 B = %.4g %s",
                    allan_floor(value), unit.c_str());
      break;
    case NoiseTerm::quantization:
      std::snprintf(text.data(), text.size(), "the integral is off by %.4g %s, however short the time", value,
                    unit_of(term, kind).c_str());
      break;
    case NoiseTerm::rate_ramp:
      std::snprintf(text.data(), text.size(), "the bias drifts by %.4g %s in an hour, as with temperature",
                    value * units::hour, unit.c_str());
      break;
  }
  return text.data();
}

std::string duration_text(double seconds) {
  return seconds >= units::hour ? message(std::round(seconds / 36) / 100, " h") : message(std::round(seconds), " s");
}

/// The band where observed and expected power disagree the most beyond doubt: by a fifth, or where white noise rules by
/// what identification itself takes for a misfit. None if there is none.
const allan::BandFit<double>* misfit(const allan::NoiseEstimates<double>& noise) {
  const auto doubt = [](const allan::BandFit<double>& band) { return std::abs(band.ratio - 1) / band.standard_error; };
  const auto worst = std::max_element(noise.bands.begin(), noise.bands.end(),
                                      [&](const auto& a, const auto& b) { return doubt(a) < doubt(b); });
  if (worst == noise.bands.end()) return nullptr;
  const bool beyond_doubt = doubt(*worst) > 6 && std::abs(worst->ratio - 1) > 0.2;
  return beyond_doubt || !noise.fits ? &*worst : nullptr;
}

void print_findings(const SensorNoise& sensor, const LogNoise& noise) {
  const std::string unit = unit_text(SensorUnit{}, sensor.kind);
  std::puts("");
  bool alike = true;
  for (const NoiseTerm term : allan::noise_terms) {
    if (!noise.options.candidates.has(term)) continue;
    const Estimate& estimate = sensor.pooled[term];
    const std::string title(name(term));
    if (estimate.detected) {
      std::printf("%s: %s\n", title.c_str(), meaning(term, sensor, estimate.value).c_str());
    } else {
      std::printf("%s: not detected in %s; below %.3g %s with %s confidence\n", title.c_str(),
                  duration_text(sensor.duration).c_str(), estimate.interval.upper, unit_of(term, sensor.kind).c_str(),
                  percent(noise.options.confidence).c_str());
    }
    if (axes_differ(sensor, term)) {
      alike = false;
      const AxisNoise& axis = noisiest(sensor, term);
      std::printf("  the axes differ by more than their intervals; %c is the noisiest, %.4g times all together\n",
                  axis.name, value_or_limit(axis.noise[term]) / value_or_limit(estimate));
    }
  }
  if (alike && sensor.axes.size() > 1) std::puts("no two axes differ by more than their intervals");
  const allan::NoiseEstimates<double>& pooled = sensor.pooled;
  // Half a bin below the end is the end.
  if (pooled.highest_frequency < 0.499 * sensor.rate) {
    std::printf("above %.4g Hz: left out, %s\n", pooled.highest_frequency,
                noise.options.highest_frequency > 0 ? "as --highest-frequency says"
                                                    : "not white (a low-pass filter, vibration, hum)");
  }
  if (const auto* band = misfit(pooled)) {
    std::printf(
        "THESE TERMS DO NOT DESCRIBE IT: from %.3g to %.3g Hz it has %.3g times the power they give; leave out "
        "what is above a filter's cutoff or vibrates (--highest-frequency)\n",
        band->frequencies.lower, band->frequencies.upper, band->ratio);
  }
}

}  // namespace

LogNoise analyse(const ImuLog& log, const allan::IdentifyOptions<double>& options, unsigned threads) {
  constexpr std::size_t fewest = 100;  // fewer have intervals so wide that nobody could use them
  for (const SensorLog& sensor : log.sensors) {
    if (sensor.samples < fewest) {
      throw std::runtime_error(message(sensor.path, ": ", sensor.samples, " samples, expected at least ", fewest));
    }
  }
  const auto named = [](const SensorLog& sensor, const std::string& axis, const auto& analysis) {
    try {
      return analysis();
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(message(sensor.path, ": ", sensor_name(sensor.kind), axis, ": ", error.what()));
    }
  };
  LogNoise result{log.path, log.rate, static_cast<double>(log.samples) / log.rate, options, {}};
  for (const SensorLog& sensor : log.sensors) {
    SensorNoise noise{sensor.kind,
                      sensor.rate,
                      static_cast<double>(sensor.samples) / sensor.rate,
                      std::vector<AxisNoise>(sensor.axes.size()),
                      {}};
    std::vector<std::optional<allan::DifferenceSpectrum<double>>> found(sensor.axes.size());
    for_each_index(Parallel{threads}, sensor.axes.size(), [&](std::size_t i) {
      const AxisLog& axis = sensor.axes[i];
      noise.axes[i] = named(sensor, message(' ', axis.name), [&] {
        const allan::IntegratedSignal<double> signal(axis.values, sensor.rate);
        found[i].emplace(signal);
        return AxisNoise{axis.name, allan::curve<allan::OverlappingAllanDeviation>(signal),
                         allan::identify_pooled<double>({*found[i]}, options)};
      });
    });
    std::vector<allan::DifferenceSpectrum<double>> spectra;
    for (auto& spectrum : found) spectra.push_back(std::move(*spectrum));
    noise.pooled = named(sensor, "", [&] {
      return noise.axes.size() == 1 ? noise.axes[0].noise : allan::identify_pooled<double>(spectra, options);
    });
    result.sensors.push_back(std::move(noise));
  }
  return result;
}

std::optional<EstimatorNoise> estimator_noise(const LogNoise& noise) {
  EstimatorNoise result;
  result.comments.push_back(message("Noise of ", noise.log, ", at rest for ", noise.duration, " s."));
  result.imu.update_rate = noise.rate;
  if (noise.topic) result.imu.topic = *noise.topic;
  int found = 0;
  for (const SensorNoise& sensor : noise.sensors) {
    const bool gyro = sensor.kind == SensorKind::gyro;
    const auto choose = [&](NoiseTerm term, const char* key, double& density) {
      const bool differ = axes_differ(sensor, term);
      const Estimate& estimate = differ ? noisiest(sensor, term).noise[term] : sensor.pooled[term];
      density = value_or_limit(estimate);
      if (density > 0) ++found;
      std::string comment;
      if (!estimate.detected) {
        comment +=
            message(": not detected, this is the upper limit with ", percent(noise.options.confidence), " confidence");
      }
      if (differ) comment += message(": the axes differ, this is of axis ", noisiest(sensor, term).name);
      if (!comment.empty()) result.comments.push_back(message(sensor_name(sensor.kind), '_', key, comment));
    };
    choose(NoiseTerm::white, "noise_density", gyro ? result.imu.gyro_noise_density : result.imu.accel_noise_density);
    choose(NoiseTerm::random_walk, "random_walk", gyro ? result.imu.gyro_random_walk : result.imu.accel_random_walk);
  }
  if (found < 4) return std::nullopt;
  return result;
}

void write_files(const LogNoise& noise, const std::filesystem::path& folder,
                 const std::vector<Estimator>& for_estimators) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(message(folder.string(), ": cannot create this folder: ", error.message()));
  AtomicFile curves(folder / "curves.csv"), table(folder / "noise.csv");
  std::deque<AtomicFile> files;  // which cannot be moved
  std::vector<std::string> names{"curves.csv", "noise.csv"};
  write_curves(curves, noise);
  write_noise(table, noise);
  const auto found = estimator_noise(noise);
  if (found) {
    for (const Estimator estimator : for_estimators) {
      names.emplace_back(file_name(estimator));
      files.emplace_back(folder / names.back()).append(imu_noise_text(estimator, found->imu, found->comments));
    }
  }
  curves.commit();
  table.commit();
  for (AtomicFile& file : files) file.commit();
  std::printf("wrote %s to %s\n", list_of(names).c_str(), folder.string().c_str());
  if (!found) std::puts("no files for estimators: they want N and K of both sensors");
}

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
