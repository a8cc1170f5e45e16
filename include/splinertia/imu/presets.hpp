// SPDX-License-Identifier: MIT
/// Error models of known IMUs, to simulate with or to copy from:
///
///   simulate(curve, presets::adis16448, {.rate = 200, .seed = 42})
///
/// The figures of data sheets are used as follows:
/// - Angle and velocity random walk are the density of the white noise. If only a noise density is given, it is taken
///   as one-sided and divided by √2.
/// - In-run bias stability is the Allan floor, 0.664 of BiasInstability's B.
/// - Bias repeatability is the standard deviation of the turn-on bias.
///
/// Data sheets describe typical parts at 25 °C at rest. Left out is what calibration removes, what differs from part to
/// part and what has no figure: scale factor, misalignment, temperature, vibration, rate random walk K. Nobody
/// publishes K for the three sensors: add a RandomWalk if you know it.
#pragma once

#include <splinertia/errors/bias/turn_on_bias.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/bias_instability.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/noise_densities.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/imu/imu.hpp>
#include <splinertia/units.hpp>

namespace splinertia::presets {

/// Consumer MEMS sensor: InvenSense (TDK) MPU-6000 and MPU-6050 in their widest ranges (FS_SEL = 3, AFS_SEL = 3).
/// Product Specification PS-MPU-6000A-00, rev. 3.4 (2013), 6.1 and 6.2. The tolerances of the offsets (±20 °/s; ±50 mg,
/// z ±80 mg) are taken as three standard deviations. The specification gives no bias instability.
inline constexpr Imu mpu6050{
    ErrorModel{TurnOnBias{20.0 / 3 * units::degree_per_second},
               WhiteNoise{white_noise_density_from_one_sided(0.005 * units::degree_per_second_per_root_hertz)},
               Quantization{units::degree_per_second / 16.4}, Saturation{2000 * units::degree_per_second}},
    ErrorModel{
        TurnOnBias{PerAxis<double>(50.0 / 3 * units::milli_g, 50.0 / 3 * units::milli_g, 80.0 / 3 * units::milli_g)},
        WhiteNoise{white_noise_density_from_one_sided(400 * units::micro_g_per_root_hertz)},
        Quantization{units::standard_g / 2048}, Saturation{16 * units::standard_g}}};

/// Industrial sensor of EuRoC's visual-inertial unit: Analog Devices ADIS16448 in its range of ±1000 °/s.
/// Data Sheet rev. H (2019), Table 1, from secondary sources: gyro bias and noise as quoted with that table, velocity
/// random walk as in ethz-asl/kalibr issue 63, the accelerometer's turn-on bias as in ethz-asl/rotors_simulator,
/// resolutions as in Linux' adis16400 driver. The accelerometer's in-run stability was not available and is left out.
inline constexpr Imu adis16448{
    ErrorModel{TurnOnBias{0.5 * units::degree_per_second},
               BiasInstability{bias_instability_from_floor(14.5 * units::degree_per_hour)},
               WhiteNoise{0.66 * units::degree_per_root_hour}, Quantization{0.04 * units::degree_per_second},
               Saturation{1000 * units::degree_per_second}},
    ErrorModel{TurnOnBias{20 * units::milli_g}, WhiteNoise{0.11 * units::meter_per_second_per_root_hour},
               Quantization{units::standard_g / 1200}, Saturation{18 * units::standard_g}}};

/// Tactical-grade MEMS unit: Sensonor (Safran) STIM300 with accelerometers of ±10 g.
/// Data sheet TS1524, from secondary sources: bias instabilities, random walks and the accelerometer's turn-on bias as
/// quoted by NavToolkit's stim300_model() (revision 31 gives quieter accelerometers), the gyro's turn-on bias and
/// resolution as in the AOGNCS Handbook's model. The accelerometer's resolution was not available and is left out.
inline constexpr Imu stim300{
    ErrorModel{TurnOnBias{4 * units::degree_per_hour},
               BiasInstability{bias_instability_from_floor(0.5 * units::degree_per_hour)},
               WhiteNoise{0.15 * units::degree_per_root_hour}, Quantization{0.22 * units::degree_per_hour},
               Saturation{400 * units::degree_per_second}},
    ErrorModel{TurnOnBias{0.75 * units::milli_g}, BiasInstability{bias_instability_from_floor(0.05 * units::milli_g)},
               WhiteNoise{0.06 * units::meter_per_second_per_root_hour}, Saturation{10 * units::standard_g}}};

/// White noise and random walk of imu0 (an ADIS16448) of the EuRoC MAV data set, from its sensor.yaml. Most
/// visual-inertial estimators are tuned with these. Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 35
/// (2016).
inline constexpr Imu euroc{ErrorModel{RandomWalk{1.9393e-5}, WhiteNoise{1.6968e-4}},
                           ErrorModel{RandomWalk{3.0e-3}, WhiteNoise{2.0e-3}}};

/// The noise of a course's simulator (vio_data_simulation), also used in the README: 80 times (gyroscope) and 10 times
/// (accelerometer) that of the ADIS16448.
inline constexpr Imu course{ErrorModel{RandomWalk{5e-5}, WhiteNoise{0.015}},
                            ErrorModel{RandomWalk{5e-4}, WhiteNoise{0.019}}};

/// A quieter set from the same simulator. It belongs to no sensor.
inline constexpr Imu course_quiet{ErrorModel{RandomWalk{1e-5}, WhiteNoise{0.005}},
                                  ErrorModel{RandomWalk{1e-4}, WhiteNoise{3e-4}}};

}  // namespace splinertia::presets
