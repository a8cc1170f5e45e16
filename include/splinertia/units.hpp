// SPDX-License-Identifier: MIT
/// The units of IMU data sheets. A data sheet's figure times its unit is the value in this library's units (SI,
/// radians, densities of continuous time). Divide by the unit to convert back:
///
///   WhiteNoise{0.66 * units::degree_per_root_hour}      // angle random walk 0.66 °/√h
///
/// For the meaning of a figure (one-sided density? Allan floor?) see errors/noise_densities.hpp.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <numbers>

namespace splinertia::units {

inline constexpr double hour = 3600;  ///< h → s

// Ratios: scale factor, nonlinearity, misalignment.
inline constexpr double percent = 1e-2;  ///< %
inline constexpr double ppm = 1e-6;      ///< parts per million

// Angles: misalignment.
inline constexpr double degree = std::numbers::pi / 180;  ///< ° → rad
inline constexpr double milliradian = 1e-3;               ///< mrad → rad

// Gyroscope: range, resolution, bias.
inline constexpr double degree_per_second = degree;       ///< °/s (dps) → rad/s
inline constexpr double degree_per_hour = degree / hour;  ///< °/h → rad/s

// Gyroscope, white noise N. √h = 60 √s, and rad/√s = rad/s/√Hz: an angle random walk is a density.
inline constexpr double degree_per_root_hour = degree / 60;                      ///< °/√h → rad/s/√Hz
inline constexpr double degree_per_second_per_root_hertz = degree_per_second;    ///< °/s/√Hz → rad/s/√Hz
inline constexpr double milli_degree_per_second_per_root_hertz = 1e-3 * degree;  ///< mdps/√Hz → rad/s/√Hz
inline constexpr double degree_per_hour_per_root_hertz = degree_per_hour;        ///< °/h/√Hz → rad/s/√Hz

// Gyroscope, random walk K. rad/s/√s = rad/s²/√Hz.
inline constexpr double degree_per_hour_per_root_hour = degree_per_hour / 60;  ///< °/h/√h → rad/s²/√Hz

// Accelerometer: range, resolution, bias. The g of data sheets is standard gravity (ISO 80000-3), not the local one.
inline constexpr double standard_g = 9.80665;         ///< g → m/s²
inline constexpr double milli_g = 1e-3 * standard_g;  ///< mg → m/s²
inline constexpr double micro_g = 1e-6 * standard_g;  ///< µg → m/s²

// Accelerometer, white noise N. m/s/√s = m/s²/√Hz: a velocity random walk is a density.
inline constexpr double meter_per_second_per_root_hour = 1.0 / 60;  ///< m/s/√h → m/s²/√Hz
inline constexpr double milli_g_per_root_hertz = milli_g;           ///< mg/√Hz → m/s²/√Hz
inline constexpr double micro_g_per_root_hertz = micro_g;           ///< µg/√Hz → m/s²/√Hz

// Accelerometer, random walk K. m/s²/√s = m/s³/√Hz.
inline constexpr double micro_g_per_root_hour = micro_g / 60;  ///< µg/√h → m/s³/√Hz

// Gyroscope, sensitivity to acceleration.
inline constexpr double degree_per_second_per_g = degree_per_second / standard_g;  ///< °/s/g → rad/s per m/s²
inline constexpr double degree_per_hour_per_g = degree_per_hour / standard_g;      ///< °/h/g → rad/s per m/s²

}  // namespace splinertia::units
