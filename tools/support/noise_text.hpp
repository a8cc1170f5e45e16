// SPDX-License-Identifier: MIT
// Noise coefficients as text.
#pragma once

#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/imu/describe.hpp>
#include <string>
#include <vector>

/// The unit of a term's coefficient: rad/s/sqrt(Hz) …
[[nodiscard]] std::string unit_of(splinertia::allan::NoiseTerm term, splinertia::SensorKind kind);

/// A coefficient in units of data sheets; "" if they have none.
[[nodiscard]] std::string data_sheet_text(splinertia::allan::NoiseTerm term, splinertia::SensorKind kind, double value);

/// The effect of a coefficient in words, so that you can tell whether it matters. `rate` is in Hz, `time` the time
/// constant of a Gauss–Markov bias or a warm-up, s.
[[nodiscard]] std::string meaning(splinertia::allan::NoiseTerm term, splinertia::SensorKind kind, double rate,
                                  double value, double time);

/// The slow terms of a description with their values: "random walk K = 1e-4 rad/s^2/sqrt(Hz)", or "no slow noise".
[[nodiscard]] std::string slow_terms_text(const splinertia::allan::Description<double>& description,
                                          splinertia::SensorKind kind);

/// 1200 s, 2.5 h
[[nodiscard]] std::string duration_text(double seconds);
