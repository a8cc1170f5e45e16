// SPDX-License-Identifier: MIT
#include "support/allan_findings.hpp"

#include <algorithm>
#include <cmath>
#include <splinertia/allan/record/unit_check.hpp>
#include <splinertia/errors/error_term.hpp>

#include "support/formatted.hpp"
#include "support/noise_text.hpp"

using namespace splinertia;
using allan::NoiseTerm;

namespace {

class Findings {
 public:
  Findings(const allan::Analysis<double>& analysis, const SensorLog& sensor)
      : analysis_(analysis), noise_(analysis.noise), sensor_(sensor), kind_(sensor.kind), rate_(sensor.rate) {
    steps();
    freezes();
    saturation();
    disturbances();
    bands();
    misfits();
    fit();
    resolution();
    white_noise();
    descriptions();
  }

  [[nodiscard]] std::vector<Finding> all() && { return std::move(all_); }

 private:
  /// Seconds since the beginning of the log.
  [[nodiscard]] double time(std::int64_t sample) const { return sensor_.time_of(static_cast<std::size_t>(sample)); }

  void steps() {
    constexpr std::size_t most = 5;
    for (const allan::Step& step : analysis_.steps) {
      const double begin = time(std::max<std::int64_t>(step.sample - step.duration, 0)), end = time(step.sample);
      const double margin = 1 + (end - begin) / 2;
      std::string text =
          formatted("a step of %.3g %s near %.0f s", step.height, unit_text(SensorUnit{}, kind_).c_str(), begin);
      if (step.duration > 0) text += formatted(" (it takes %.3g s, until %.0f s)", end - begin, end);
      const bool late = static_cast<double>(step.sample) > noise_.duration * rate_ / 2;
      const double until = std::floor(std::max(begin - margin, 0.0)), skip = std::ceil(end + margin);
      text += late ? formatted(": leave out the part after it with --until %.0f, or the part before with --skip %.0f",
                               until, skip)
                   : formatted(": leave out the part before it with --skip %.0f, or the part after with --until %.0f",
                               skip, until);
      if (all_.size() == most && analysis_.steps.size() > most) {
        all_.push_back({"withheld", 0, 0, "", formatted("and %zu more steps", analysis_.steps.size() - most), true});
        break;
      }
      all_.push_back({"step", begin, end, "s", text, true});
    }
    if (!analysis_.steps.empty()) {
      all_.push_back(
          {"withheld", 0, 0, "", "a step looks like a random walk: no slow term is reported as detected", true});
    }
  }

  void freezes() {
    for (const allan::SampleSpan& span : analysis_.freezes) {
      const double begin = time(span.begin), end = time(span.end);
      all_.push_back({"freeze", begin, end, "s",
                      formatted("constant for %.3g s from %.0f s on: leave this out with --leave-out %.0f-%.0f",
                                end - begin, begin, std::floor(begin), std::ceil(end)),
                      true});
    }
  }

  void saturation() {
    const std::int64_t samples = analysis_.saturation.samples();
    if (samples == 0) return;
    all_.push_back({"saturation", 0, 0, "",
                    formatted("it saturates: %lld samples (%.2g %%) have its lowest or highest value",
                              static_cast<long long>(samples),
                              100 * static_cast<double>(samples) / static_cast<double>(analysis_.curve.samples)),
                    true});
  }

  void disturbances() {
    const allan::Stillness& still = analysis_.stillness;
    if (still.disturbed == 0) return;
    const double worst = time(still.worst);
    all_.push_back({"disturbance", worst, worst + 1, "s",
                    formatted("not at rest? In %lld of %lld overlapping blocks of about a second the standard or "
                              "largest deviation is more than noise explains, the worst from %.0f s on (%.3g times "
                              "the usual): leave it out with --leave-out %.0f-%.0f",
                              static_cast<long long>(still.disturbed), static_cast<long long>(still.blocks), worst,
                              still.worst_ratio, std::max(std::floor(worst) - 1, 0.0), std::ceil(worst) + 2),
                    true});
  }

  void bands() {
    for (const auto& band : noise_.excluded) {
      all_.push_back({"excluded", band.frequencies.lower, band.frequencies.upper, "Hz",
                      formatted("%.3g to %.3g Hz is left out%s: the power there is %.3g times that of these terms",
                                band.frequencies.lower, band.frequencies.upper,
                                band.ratio > 0.8 && band.ratio < 1.25 ? ", as requested or beside a line"
                                : band.ratio > 1                      ? " (a line, vibration, hum)"
                                                                      : "",
                                band.ratio),
                      true});
    }
    if (!analysis_.used_to_the_end()) {
      all_.push_back(
          {"unused", noise_.highest_frequency, rate_ / 2, "Hz",
           formatted("the spectrum above %.4g Hz is left out, as requested or because it is not white (a low-pass "
                     "filter, vibration, hum); N is that of averages longer than %.2g s, Q is unknown",
                     noise_.highest_frequency, 1 / (2 * noise_.highest_frequency)),
           true});
    }
  }

  void misfits() {
    for (const auto& misfit : analysis_.misfits) {
      all_.push_back({"misfit", misfit.shortest, misfit.longest, "s",
                      formatted("at averaging times of %.3g to %.3g s the deviation is, at worst, %.3g times that of "
                                "these terms",
                                misfit.shortest, misfit.longest, misfit.ratio),
                      true});
    }
  }

  void fit() {
    if (noise_.fits) {
      all_.push_back({"fit", 0, 0, "",
                      formatted("the used part of the spectrum agrees with these terms (goodness of fit: p = %.2g)",
                                noise_.fit_probability),
                      false});
      return;
    }
    std::string where;
    const auto doubt = [](const auto& band) { return std::abs(band.ratio - 1) / band.standard_error; };
    const auto worst = std::max_element(noise_.bands.begin(), noise_.bands.end(),
                                        [&](const auto& a, const auto& b) { return doubt(a) < doubt(b); });
    if (worst != noise_.bands.end()) {
      where = formatted(": from %.3g to %.3g Hz the power is %.3g times that of the terms", worst->frequencies.lower,
                        worst->frequencies.upper, worst->ratio);
    }
    all_.push_back(
        {"fit", 0, 0, "",
         formatted("THESE TERMS DO NOT DESCRIBE THE LOG (goodness of fit: p = %.1g)%s; intervals do not hold",
                   noise_.fit_probability, where.c_str()),
         true});
  }

  void resolution() {
    if (!analysis_.resolution || analysis_.rounding == allan::RoundingEffect::none) return;
    const std::string unit = unit_text(SensorUnit{}, kind_);
    const double resolution = *analysis_.resolution, deviation = noise_.N.value * std::sqrt(rate_);
    std::string text = formatted("its resolution of %.3g %s is coarse: %.2g times the standard deviation of a sample",
                                 resolution, unit.c_str(), resolution / deviation);
    const bool invalid = analysis_.rounding == allan::RoundingEffect::invalid;
    text += invalid ? "; N is not that of the sensor, because rounding removes most of it or adds to it"
                    : formatted("; without rounding N is about %.4g",
                                allan::white_noise_before_rounding(noise_.N.value, resolution, rate_));
    all_.push_back({"resolution", 0, 0, "", text, invalid});
  }

  void white_noise() {
    const bool gyro = kind_ == SensorKind::gyro;
    const auto check = gyro ? allan::check_gyroscope_white_noise(noise_.N.value)
                            : allan::check_accelerometer_white_noise(noise_.N.value);
    if (!noise_.N.detected || check == allan::WhiteNoiseCheck::plausible) return;
    const bool large = check == allan::WhiteNoiseCheck::too_large;
    all_.push_back({"white_noise", 0, 0, "",
                    formatted("no %s has a white noise of %.3g %s: %s", gyro ? "gyroscope" : "accelerometer",
                              noise_.N.value, unit_of(NoiseTerm::white, kind_).c_str(),
                              large ? (gyro ? "the log is in deg/s (--gyro-unit deg/s), or not at rest"
                                            : "the log is in another unit (--accel-unit), or not at rest")
                                    : (gyro ? "the log is simulated, filtered, or in another unit (--gyro-unit)"
                                            : "the log is simulated, filtered, or in g (--accel-unit g)")),
                    true});
  }

  void descriptions() {
    if (noise_.G.possible && noise_.descriptions.size() == 1 && !noise_.excluded.empty()) {
      all_.push_back(
          {"descriptions", 0, 0, "", "the Gauss-Markov bias may only be the tail of a band that is left out", false});
    }
    if (noise_.W.possible && noise_.descriptions.size() == 1 && !noise_.excluded.empty()) {
      all_.push_back(
          {"descriptions", 0, 0, "", "the warm-up may only be an end effect of a line that is left out", false});
    }
    if (const auto finding = descriptions_finding(noise_, kind_)) all_.push_back(*finding);
    if (noise_.G.possible && noise_.descriptions.size() == 1 && noise_.excluded.empty() && !noise_.may_be_drift) {
      all_.push_back({"descriptions", 0, 0, "",
                      formatted("its correlation time is %.2g s or less: a filter or a vibration rather than a bias",
                                noise_.G.time),
                      false});
    }
  }

  const allan::Analysis<double>& analysis_;
  const allan::NoiseEstimates<double>& noise_;
  const SensorLog& sensor_;
  SensorKind kind_;
  double rate_;
  std::vector<Finding> all_;
};

}  // namespace

std::optional<Finding> descriptions_finding(const allan::NoiseEstimates<double>& noise, SensorKind kind) {
  std::vector<std::string> texts;
  for (const auto& description : noise.descriptions) {
    std::string text = slow_terms_text(description, kind);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(std::move(text));
  }
  if (noise.may_be_drift) {
    std::string text = "a smooth drift, as with temperature";
    if (!noise.step_times.empty()) {
      text = noise.step_times.size() == 1 ? "a step near" : formatted("%zu steps near", noise.step_times.size());
      const char* separator = " ";
      for (const double time : noise.step_times) {
        text += formatted("%s%.0f s", separator, time);
        separator = ", ";
      }
      text += " after the beginning of the analysed part";
    }
    texts.push_back(text);
  }
  if (texts.size() < 2) return std::nullopt;
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : "; or ") + text;
  return Finding{"descriptions", 0, 0, "", "cannot be told apart in this log: " + list, false};
}

std::vector<Finding> findings_of(const allan::Analysis<double>& analysis, const SensorLog& sensor) {
  return Findings(analysis, sensor).all();
}
