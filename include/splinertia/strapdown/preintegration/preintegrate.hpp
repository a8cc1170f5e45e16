// SPDX-License-Identifier: MIT
#pragma once

#include <ranges>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

/// The scalar of a sample or of an increment.
template <typename Sample>
struct SampleScalar {
  using type = typename std::remove_cvref_t<decltype(std::declval<const Sample&>().gyro)>::Scalar;
};
template <ImuIncrementLike Increment>
struct SampleScalar<Increment> {
  using type = typename std::remove_cvref_t<decltype(std::declval<const Increment&>().delta_angle)>::Scalar;
};

/// A range of ImuSamples or ImuIncrements.
template <typename Samples>
concept ImuSampleRange = std::ranges::input_range<Samples> && (ImuSampleLike<std::ranges::range_value_t<Samples>> ||
                                                               ImuIncrementLike<std::ranges::range_value_t<Samples>>);

/// The scalar of such a range.
template <ImuSampleRange Samples>
using ScalarOfSamples = typename SampleScalar<std::ranges::range_value_t<Samples>>::type;

/// The motion that the samples from `sample` to `end` have measured since `start`. Does not compile with a scheme that
/// cannot be linearized.
template <typename Scheme, typename Time, typename Scalar, typename Noise>
[[nodiscard]] auto preintegrated(Time start, auto sample, const auto& end, const ImuBias<Scalar>& bias,
                                 const Noise& noise, const GapOptions<Scalar>& gaps) {
  constexpr bool good = PreintegrationScheme<Scheme, Scalar, Time>;
  static_assert(
      good,
      "preintegrate() takes the schemes ZeroOrderHold, Euler, Midpoint, Trapezoid and Magnus4 for point samples, "
      "RotationCorrectedIncrements and TwoSampleIncrements for increments, and those of your own with moments()");
  if constexpr (good) {
    Preintegrator<Scheme, Scalar, Time, Noise> preintegrator(start, bias, noise, gaps);
    for (; sample != end; ++sample) preintegrator.push(*sample);
    preintegrator.finish();
    return preintegrator.result();
  } else {
    return PreintegrationResult<Scalar, Noise>();
  }
}

}  // namespace detail

/// The motion that samples have measured from `start` to the last of them (PreintegratedImu), with the biases
/// subtracted:
///
///   const auto motion = preintegrate<TwoSampleIncrements>(start, increments, bias, noise);
///   motion.delta();                    // and .jacobians(), .covariance(): ImuCovariance, or none without `noise`
///
/// Scheme and errors are those of Preintegrator. The first point sample has to be at `start`; the first increment
/// begins there. `noise` is an ImuNoise of the samples' scalar.
template <typename Scheme, detail::ImuSampleRange Samples, typename Noise = detail::Noiseless>
[[nodiscard]] auto preintegrate(detail::TimeOf<std::ranges::range_value_t<Samples>> start, Samples&& samples,
                                const ImuBias<detail::ScalarOfSamples<Samples>>& bias = {}, const Noise& noise = {},
                                const GapOptions<detail::ScalarOfSamples<Samples>>& gaps = {}) {
  return detail::preintegrated<Scheme>(start, std::ranges::begin(samples), std::ranges::end(samples), bias, noise,
                                       gaps);
}

/// The same from the first to the last of the point samples:
///
///   preintegrate<Midpoint>(samples, bias, imu_noise(presets::euroc))
///
/// Throws std::invalid_argument if there are none. Increments need a start.
template <typename Scheme, detail::ImuSampleRange Samples, typename Noise = detail::Noiseless>
[[nodiscard]] auto preintegrate(Samples&& samples, const ImuBias<detail::ScalarOfSamples<Samples>>& bias = {},
                                const Noise& noise = {},
                                const GapOptions<detail::ScalarOfSamples<Samples>>& gaps = {}) {
  constexpr bool tell_their_start = ImuSampleLike<std::ranges::range_value_t<Samples>>;
  static_assert(tell_their_start,
                "increments do not tell when the first of them began: preintegrate<TwoSampleIncrements>(start, "
                "increments, bias, noise)");
  if constexpr (tell_their_start) {
    auto first = std::ranges::begin(samples);
    const auto end = std::ranges::end(samples);
    if (first == end) detail::refuse<std::invalid_argument>("preintegrate: no samples, expected at least one");
    const auto start = (*first).time;
    return detail::preintegrated<Scheme>(start, std::move(first), end, bias, noise, gaps);
  } else {
    return detail::PreintegrationResult<detail::ScalarOfSamples<Samples>, Noise>();
  }
}

}  // namespace splinertia
