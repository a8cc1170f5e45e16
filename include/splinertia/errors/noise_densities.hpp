// SPDX-License-Identifier: MIT
/// From what data sheets, logs and other programs give to the parameters of the error terms, and back.
///
/// WhiteNoise and RandomWalk take densities of continuous time: N² is the two-sided power spectral density of the white
/// noise (IEEE Std 952-1997, C.1.1), K² that of what the bias is the integral of (C.1.3). They do not depend on the
/// rate; what a sample or a step has does. docs/noise_densities.md explains, with worked examples.
#pragma once

#include <cmath>
#include <splinertia/detail/require.hpp>
#include <type_traits>

namespace splinertia {

/// The standard deviation of a sample of white noise of density N at `rate` samples a second: N·√rate.
/// N in unit/√Hz, rate in Hz, result in unit. Each function here throws std::invalid_argument unless a density,
/// standard deviation or floor is finite and >= 0, and a rate or bandwidth finite and > 0.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_sigma(const Scalar& density, const Hertz& rate) {
  using std::sqrt;
  require_non_negative("white_noise_sigma", "density", density);
  require_positive("white_noise_sigma", "rate", rate);
  return density * sqrt(static_cast<Scalar>(rate));
}

/// The density N of white noise whose samples have standard deviation `sigma` at `rate` samples a second: sigma/√rate.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_density(const Scalar& sigma, const Hertz& rate) {
  using std::sqrt;
  require_non_negative("white_noise_density", "sigma", sigma);
  require_positive("white_noise_density", "rate", rate);
  return sigma / sqrt(static_cast<Scalar>(rate));
}

/// The standard deviation of what a random walk of density K adds from one sample to the next: K/√rate.
/// K in unit/s/√Hz, rate in Hz, result in unit.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar random_walk_sigma(const Scalar& density, const Hertz& rate) {
  using std::sqrt;
  require_non_negative("random_walk_sigma", "density", density);
  require_positive("random_walk_sigma", "rate", rate);
  return density / sqrt(static_cast<Scalar>(rate));
}

/// The density K of a random walk whose steps have standard deviation `sigma` at `rate` steps a second: sigma·√rate.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar random_walk_density(const Scalar& sigma, const Hertz& rate) {
  using std::sqrt;
  require_non_negative("random_walk_density", "sigma", sigma);
  require_positive("random_walk_density", "rate", rate);
  return sigma * sqrt(static_cast<Scalar>(rate));
}

/// √(1/2), for any scalar.
template <typename Scalar>
[[nodiscard]] constexpr Scalar root_half() {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return static_cast<Scalar>(0.707106781186547524400844362104849039L);
  } else {
    using std::sqrt;
    return sqrt(Scalar(1) / Scalar(2));
  }
}

/// The density N of white noise from a one-sided spectral density, over √2. "Noise density" or "noise spectral density"
/// in a data sheet is one-sided: all power at positive frequencies. Angle and velocity random walks are N itself.
template <typename Scalar>
[[nodiscard]] constexpr Scalar white_noise_density_from_one_sided(const Scalar& one_sided) {
  require_non_negative("white_noise_density_from_one_sided", "one-sided density", one_sided);
  return one_sided * root_half<Scalar>();
}

/// The one-sided spectral density, as data sheets give it, of white noise of density N: N·√2.
template <typename Scalar>
[[nodiscard]] constexpr Scalar one_sided_density(const Scalar& density) {
  require_non_negative("one_sided_density", "density", density);
  return density * (Scalar(2) * root_half<Scalar>());
}

/// The standard deviation of white noise of density N behind a filter: N·√(2·bandwidth).
/// The noise bandwidth of a filter counts positive frequencies, Hz: that of the ideal low pass is its cutoff, that of
/// first order π/2 times as much, that of second order (Butterworth) 1.11 times. Sampling without aliasing at `rate`
/// has rate/2, which gives white_noise_sigma.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_rms(const Scalar& density, const Hertz& noise_bandwidth) {
  using std::sqrt;
  require_non_negative("white_noise_rms", "density", density);
  require_positive("white_noise_rms", "noise bandwidth", noise_bandwidth);
  return density * sqrt(Scalar(2) * static_cast<Scalar>(noise_bandwidth));
}

/// The density N of white noise that has standard deviation `rms` behind a filter of this noise bandwidth.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_density_from_rms(const Scalar& rms, const Hertz& noise_bandwidth) {
  using std::sqrt;
  require_non_negative("white_noise_density_from_rms", "rms", rms);
  require_positive("white_noise_density_from_rms", "noise bandwidth", noise_bandwidth);
  return rms / sqrt(Scalar(2) * static_cast<Scalar>(noise_bandwidth));
}

/// The noise bandwidth of a low pass of first order with this −3 dB frequency: π/2·cutoff. Both in Hz.
template <typename Hertz>
  requires(!std::is_integral_v<Hertz>)
[[nodiscard]] Hertz first_order_noise_bandwidth(const Hertz& cutoff) {
  using std::atan;
  require_positive("first_order_noise_bandwidth", "cutoff", cutoff);
  return Hertz(2) * atan(Hertz(1)) * cutoff;
}

/// √(2 ln 2/π) = 0.6643: what the Allan deviation of flicker noise is at its flat floor, over the coefficient B of the
/// bias instability. IEEE Std 952-1997, C.1.2.
template <typename Scalar>
[[nodiscard]] constexpr Scalar allan_floor_over_bias_instability() {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return static_cast<Scalar>(0.664282470267960019117402189155011749L);
  } else {
    using std::atan, std::log, std::sqrt;
    return sqrt(log(Scalar(2)) / (Scalar(2) * atan(Scalar(1))));
  }
}

/// The coefficient B from the lowest point of an Allan deviation, which is what data sheets call bias instability or
/// in-run bias stability: floor/0.6643. Both in unit.
template <typename Scalar>
[[nodiscard]] constexpr Scalar bias_instability_from_floor(const Scalar& floor) {
  require_non_negative("bias_instability_from_floor", "floor", floor);
  return floor / allan_floor_over_bias_instability<Scalar>();
}

/// The floor of the Allan deviation of bias instability B: 0.6643·B.
template <typename Scalar>
[[nodiscard]] constexpr Scalar allan_floor(const Scalar& bias_instability) {
  require_non_negative("allan_floor", "bias instability", bias_instability);
  return bias_instability * allan_floor_over_bias_instability<Scalar>();
}

}  // namespace splinertia
