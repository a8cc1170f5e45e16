// SPDX-License-Identifier: MIT
#include "support/noise_text.hpp"

#include <array>
#include <cmath>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/noise_densities.hpp>
#include <splinertia/units.hpp>

#include "support/concat.hpp"
#include "support/formatted.hpp"

using namespace splinertia;
using allan::NoiseTerm;

std::string unit_of(NoiseTerm term, SensorKind kind) {
  constexpr std::array<SensorUnit, 7> units{SensorUnit{0, true}, SensorUnit{1, true}, SensorUnit{}, SensorUnit{-1},
                                            SensorUnit{1},       SensorUnit{},        SensorUnit{}};  // N, K, B, Q, R …
  return unit_text(units[static_cast<std::size_t>(term)], kind);
}

std::string data_sheet_text(NoiseTerm term, SensorKind kind, double value) {
  const bool gyro = kind == SensorKind::gyro;
  if (term == NoiseTerm::white) {
    // In data sheets an angle or velocity random walk is N, but a noise density is one-sided: docs/noise_densities.md.
    const double one_sided = one_sided_density(value);
    return gyro ? formatted("%.4g deg/sqrt(h), one-sided %.4g deg/s/sqrt(Hz)", value / units::degree_per_root_hour,
                            one_sided / units::degree_per_second_per_root_hertz)
                : formatted("%.4g m/s/sqrt(h), one-sided %.4g ug/sqrt(Hz)",
                            value / units::meter_per_second_per_root_hour, one_sided / units::micro_g_per_root_hertz);
  }
  if (term == NoiseTerm::random_walk) {
    return gyro ? formatted("%.4g deg/h/sqrt(h)", value / units::degree_per_hour_per_root_hour)
                : formatted("%.4g ug/sqrt(h)", value / units::micro_g_per_root_hour);
  }
  if (term == NoiseTerm::bias_instability) {
    return gyro ? formatted("floor %.4g deg/h", allan_floor(value) / units::degree_per_hour)
                : formatted("floor %.4g ug", allan_floor(value) / units::micro_g);
  }
  return "";
}

std::string meaning(NoiseTerm term, SensorKind kind, double rate, double value, double time) {
  const std::string unit = unit_text(SensorUnit{}, kind);
  switch (term) {
    case NoiseTerm::white:
      return formatted("a sample at %.6g Hz has a standard deviation of %.4g %s", rate, white_noise_sigma(value, rate),
                       unit.c_str());
    case NoiseTerm::random_walk:
      return formatted("the bias moves by %.4g %s in an hour", value * std::sqrt(units::hour), unit.c_str());
    case NoiseTerm::bias_instability:
      return formatted("no average is better than the floor 0.664 B = %.4g %s", allan_floor(value), unit.c_str());
    case NoiseTerm::quantization:
      return formatted("the integral has an error of %.4g %s, however short the time", value,
                       unit_of(term, kind).c_str());
    case NoiseTerm::rate_ramp:
      return formatted("the bias drifts by %.4g %s in an hour, as with temperature", value * units::hour, unit.c_str());
    case NoiseTerm::gauss_markov:
      return formatted(
          "the bias has a standard deviation of %.4g %s and a correlation time of %.3g s; over shorter times it is a "
          "random walk of K = %.4g %s",
          value, unit.c_str(), time, value * std::sqrt(2 / time), unit_of(NoiseTerm::random_walk, kind).c_str());
    case NoiseTerm::warm_up:
      return formatted(
          "the bias settles by %.4g %s with a time constant of %.3g s: let the sensor warm up before you record, or "
          "leave out the beginning (--skip)",
          value, unit.c_str(), time);
  }
  return "";
}

std::string slow_terms_text(const allan::Description<double>& description, SensorKind kind) {
  std::vector<std::string> texts;
  for (const NoiseTerm term : allan::noise_terms) {
    if (term == NoiseTerm::white || term == NoiseTerm::quantization || !description.terms.has(term)) continue;
    std::string text = formatted("%s %s = %.3g %s", std::string(name(term)).c_str(), std::string(symbol(term)).c_str(),
                                 description.value(term), unit_of(term, kind).c_str());
    if (term == NoiseTerm::gauss_markov) text += formatted(" correlated over %.3g s", description.correlation_time);
    if (term == NoiseTerm::warm_up) text += formatted(" with time constant %.3g s", description.decay_time);
    texts.push_back(text);
  }
  return texts.empty() ? "no slow noise" : list_of(texts);
}

std::string duration_text(double seconds) {
  return seconds >= units::hour ? concat(std::round(seconds / 36) / 100, " h") : concat(std::round(seconds), " s");
}
