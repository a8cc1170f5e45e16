// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/detail/require.hpp>
#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/detail/sample_window.hpp>
#include <splinertia/strapdown/preintegration/detail/imu_covariance.hpp>
#include <splinertia/strapdown/preintegration/preintegrated_imu.hpp>
#include <splinertia/strapdown/schemes/integration_scheme.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

/// Placeholder for "no noise": no covariance is computed.
struct Noiseless {};

/// A scheme whose steps can be linearized.
template <typename Scheme, typename Scalar, typename Time>
concept PreintegrationScheme =
    IntegrationScheme<Scheme, Scalar, Time> && LinearizableScheme<Scheme, Scalar, SchemeWindow<Scheme, Scalar, Time>>;

/// What preintegration with such noise results in.
template <typename Scalar, typename Noise>
using PreintegrationResult =
    PreintegratedImu<Scalar, std::conditional_t<std::is_same_v<Noise, Noiseless>, NoCovariance, ImuCovariance<Scalar>>>;

}  // namespace detail

/// Preintegrates the samples of an IMU one at a time, without heap:
///
///   Preintegrator preintegrator(Midpoint{}, time, bias, noise);
///   for (const auto& sample : samples) preintegrator.push(sample);
///   preintegrator.finish();
///   preintegrator.result();                    // PreintegratedImu: motion, bias Jacobians, covariance
///
/// preintegrate() does this for a range of samples.
///
/// Scheme has to be one that can be linearized: ZeroOrderHold, Euler, Midpoint, Trapezoid or Magnus4 for point samples,
/// RotationCorrectedIncrements or TwoSampleIncrements for increments. With Noiseless, the default, there is no
/// covariance.
template <typename Scheme, typename Scalar = double, TimePoint Time = double, typename Noise = detail::Noiseless>
  requires detail::PreintegrationScheme<Scheme, Scalar, Time>
class Preintegrator {
  static constexpr bool has_noise = std::derived_from<Noise, ImuNoise<Scalar>>;
  static_assert(
      has_noise || std::is_same_v<Noise, detail::Noiseless>,
      "the noise of preintegration is an ImuNoise of the samples' scalar: imu_noise(imu), for samples in float "
      "imu_noise<float>(imu); GapOptions come after it");

 public:
  using Result = detail::PreintegrationResult<Scalar, Noise>;
  using Covariance = std::remove_cvref_t<decltype(std::declval<const Result&>().covariance())>;

  /// Throws std::invalid_argument for a start or a bias that is not finite, for noise that is not finite or < 0, and
  /// unless the longest interval of `gaps` is > 0.
  explicit Preintegrator(Time start, const ImuBias<Scalar>& bias = {}, const Noise& noise = {},
                         const GapOptions<Scalar>& gaps = {})
      : result_(bias), noise_(noise), window_(start, gaps, "preintegrate") {
    detail::require_all_finite("preintegrate", "the gyroscope's bias", bias.gyro);
    detail::require_all_finite("preintegrate", "the accelerometer's bias", bias.accel);
    if constexpr (has_noise) {
      detail::require_non_negative("preintegrate", "the gyroscope's noise density", noise.gyro_density);
      detail::require_non_negative("preintegrate", "the accelerometer's noise density", noise.accel_density);
      detail::require_non_negative("preintegrate", "the random walk of the gyroscope's bias", noise.gyro_walk);
      detail::require_non_negative("preintegrate", "the random walk of the accelerometer's bias", noise.accel_walk);
    }
  }

  /// The same with the scheme as an argument, so that the type can be deduced.
  Preintegrator(Scheme, Time start, const ImuBias<Scalar>& bias = {}, const Noise& noise = {},
                const GapOptions<Scalar>& gaps = {})
      : Preintegrator(start, bias, noise, gaps) {}

  /// Adds a sample. Throws std::invalid_argument as Integrator does, in the name of preintegrate().
  template <typename Sample>
  void push(const Sample& sample) {
    const ImuBias<Scalar>& bias = result_.bias();
    if constexpr (!detail::check_sample<Scheme, Scalar, Time, Sample>()) {
      // check_sample() has already given the error message.
    } else if constexpr (Scheme::takes_increments) {
      const Scalar h = window_.since_last(sample.time);
      window_.push(ImuIncrement<Scalar, Time>{sample.time, sample.delta_angle - bias.gyro * h,
                                              sample.delta_velocity - bias.accel * h},
                   step());
    } else {
      window_.push(ImuSample<Scalar, Time>{sample.time, sample.gyro - bias.gyro, sample.accel - bias.accel}, step());
    }
  }

  /// Advances the result to the last sample; the scheme does without later samples. More samples may follow.
  void finish() { window_.finish(step()); }

  [[nodiscard]] const Result& result() const { return result_; }
  [[nodiscard]] std::size_t gaps() const { return window_.gaps(); }

 private:
  [[nodiscard]] auto step() {
    return [this](const auto& samples, std::size_t from, Time) {
      const auto step = detail::linearize_step<Scheme, Scalar>(samples, from);
      if constexpr (has_noise) {
        result_.append(step, Covariance(step, noise_));
      } else {
        result_.append(step);
      }
    };
  }

  Result result_;
  [[no_unique_address]] Noise noise_;
  detail::SampleWindow<Scheme, Scalar, Time> window_;
};

template <typename Scheme, TimePoint Time>
Preintegrator(Scheme, Time) -> Preintegrator<Scheme, double, Time>;
template <typename Scheme, TimePoint Time, typename Scalar, typename Noise = detail::Noiseless>
Preintegrator(Scheme, Time, const ImuBias<Scalar>&, const Noise& = {},
              const GapOptions<std::type_identity_t<Scalar>>& = {}) -> Preintegrator<Scheme, Scalar, Time, Noise>;

}  // namespace splinertia
