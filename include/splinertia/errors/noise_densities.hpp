// SPDX-License-Identifier: MIT
/// Conversions between figures of data sheets, logs and other programs and the parameters of the error terms.
///
/// WhiteNoise and RandomWalk take densities of continuous time. N² is the two-sided power spectral density of the white
/// noise (IEEE Std 952-1997, C.1.1). K² is that of the noise whose integral is the bias (C.1.3). Densities do not
/// depend on the sampling rate; the standard deviations of samples and steps do. docs/noise_densities.md explains this
/// with examples.
#pragma once

#include <cmath>
#include <splinertia/detail/require.hpp>
#include <type_traits>

namespace splinertia {

/// The standard deviation of a sample of white noise of density N at `rate` samples per second: N·√rate.
/// N in unit/√Hz, rate in Hz, result in unit.
/// Every function of this header throws std::invalid_argument unless each density, standard deviation and floor is
/// finite and >= 0, and each rate and bandwidth is finite and > 0.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_sigma(const Scalar& density, const Hertz& rate) {
  using std::sqrt;
  detail::require_non_negative("white_noise_sigma", "density", density);
  detail::require_positive("white_noise_sigma", "rate", rate);
  return density * sqrt(static_cast<Scalar>(rate));
}

/// The density N of white noise whose samples have standard deviation `sigma` at `rate` samples per second:
/// sigma/√rate.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_density(const Scalar& sigma, const Hertz& rate) {
  using std::sqrt;
  detail::require_non_negative("white_noise_density", "sigma", sigma);
  detail::require_positive("white_noise_density", "rate", rate);
  return sigma / sqrt(static_cast<Scalar>(rate));
}

/// The standard deviation of the step of a random walk of density K from one sample to the next: K/√rate.
/// K in unit/s/√Hz, rate in Hz, result in unit.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar random_walk_sigma(const Scalar& density, const Hertz& rate) {
  using std::sqrt;
  detail::require_non_negative("random_walk_sigma", "density", density);
  detail::require_positive("random_walk_sigma", "rate", rate);
  return density / sqrt(static_cast<Scalar>(rate));
}

/// The density K of a random walk whose steps have standard deviation `sigma` at `rate` steps per second: sigma·√rate.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar random_walk_density(const Scalar& sigma, const Hertz& rate) {
  using std::sqrt;
  detail::require_non_negative("random_walk_density", "sigma", sigma);
  detail::require_positive("random_walk_density", "rate", rate);
  return sigma * sqrt(static_cast<Scalar>(rate));
}

namespace detail {

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

}  // namespace detail

/// The density N of white noise from a one-sided spectral density: one_sided/√2. The "noise density" or "noise spectral
/// density" of a data sheet is one-sided: all power is at positive frequencies. Angle and velocity random walks are N
/// itself.
template <typename Scalar>
[[nodiscard]] constexpr Scalar white_noise_density_from_one_sided(const Scalar& one_sided) {
  detail::require_non_negative("white_noise_density_from_one_sided", "one-sided density", one_sided);
  return one_sided * detail::root_half<Scalar>();
}

/// The one-sided spectral density of white noise of density N, as in data sheets: N·√2.
template <typename Scalar>
[[nodiscard]] constexpr Scalar one_sided_density(const Scalar& density) {
  detail::require_non_negative("one_sided_density", "density", density);
  return density * (Scalar(2) * detail::root_half<Scalar>());
}

/// The standard deviation of white noise of density N after a filter: N·√(2·bandwidth).
/// The noise bandwidth of a filter counts positive frequencies, Hz. It is the cutoff of an ideal low pass, π/2 times
/// the cutoff for first order, 1.11 times for second order (Butterworth). Sampling without aliasing at `rate` has
/// rate/2, which gives white_noise_sigma.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_rms(const Scalar& density, const Hertz& noise_bandwidth) {
  using std::sqrt;
  detail::require_non_negative("white_noise_rms", "density", density);
  detail::require_positive("white_noise_rms", "noise bandwidth", noise_bandwidth);
  return density * sqrt(Scalar(2) * static_cast<Scalar>(noise_bandwidth));
}

/// The density N of white noise with standard deviation `rms` after a filter of this noise bandwidth.
template <typename Scalar, typename Hertz>
[[nodiscard]] Scalar white_noise_density_from_rms(const Scalar& rms, const Hertz& noise_bandwidth) {
  using std::sqrt;
  detail::require_non_negative("white_noise_density_from_rms", "rms", rms);
  detail::require_positive("white_noise_density_from_rms", "noise bandwidth", noise_bandwidth);
  return rms / sqrt(Scalar(2) * static_cast<Scalar>(noise_bandwidth));
}

/// The noise bandwidth of a first-order low pass with this −3 dB frequency: π/2·cutoff. Both in Hz.
template <typename Hertz>
  requires(!std::is_integral_v<Hertz>)
[[nodiscard]] Hertz first_order_noise_bandwidth(const Hertz& cutoff) {
  using std::atan;
  detail::require_positive("first_order_noise_bandwidth", "cutoff", cutoff);
  return Hertz(2) * atan(Hertz(1)) * cutoff;
}

namespace detail {

/// √(2 ln 2/π) = 0.6643: the flat floor of the Allan deviation of flicker noise, divided by the coefficient B of the
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

}  // namespace detail

/// The coefficient B from the minimum of an Allan deviation: floor/0.6643. Data sheets call the minimum bias
/// instability or in-run bias stability. Both in unit.
template <typename Scalar>
[[nodiscard]] constexpr Scalar bias_instability_from_floor(const Scalar& floor) {
  detail::require_non_negative("bias_instability_from_floor", "floor", floor);
  return floor / detail::allan_floor_over_bias_instability<Scalar>();
}

/// The floor of the Allan deviation for the bias instability coefficient B: 0.6643·B.
template <typename Scalar>
[[nodiscard]] constexpr Scalar allan_floor(const Scalar& bias_instability) {
  detail::require_non_negative("allan_floor", "bias instability", bias_instability);
  return bias_instability * detail::allan_floor_over_bias_instability<Scalar>();
}

}  // namespace splinertia
