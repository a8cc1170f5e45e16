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

}  // namespace detail

/// The motion that samples have measured from `start` to the last of them (PreintegratedImu), with the biases
/// subtracted:
///
///   const auto motion = preintegrate<TwoSampleIncrements>(start, increments, bias, noise);
///   motion.delta();                    // and .jacobians(), .covariance(): ImuCovariance, or none without `noise`
///
/// Scheme and errors are those of Preintegrator. The first point sample has to be at `start`; the first increment
/// begins there.
template <typename Scheme, detail::ImuSampleRange Samples, typename Noise = detail::Noiseless>
[[nodiscard]] auto preintegrate(detail::TimeOf<std::ranges::range_value_t<Samples>> start, Samples&& samples,
                                const ImuBias<detail::ScalarOfSamples<Samples>>& bias = {}, const Noise& noise = {},
                                const GapOptions<detail::ScalarOfSamples<Samples>>& gaps = {}) {
  using Time = detail::TimeOf<std::ranges::range_value_t<Samples>>;
  Preintegrator<Scheme, detail::ScalarOfSamples<Samples>, Time, Noise> preintegrator(start, bias, noise, gaps);
  for (const auto& sample : samples) preintegrator.push(sample);
  preintegrator.finish();
  return preintegrator.result();
}

/// The same from the first to the last of the point samples:
///
///   preintegrate<Midpoint>(samples, bias, imu_noise(presets::euroc))
///
/// Throws std::invalid_argument if there are none.
template <typename Scheme, detail::ImuSampleRange Samples, typename Noise = detail::Noiseless>
  requires ImuSampleLike<std::ranges::range_value_t<Samples>>
[[nodiscard]] auto preintegrate(Samples&& samples, const ImuBias<detail::ScalarOfSamples<Samples>>& bias = {},
                                const Noise& noise = {},
                                const GapOptions<detail::ScalarOfSamples<Samples>>& gaps = {}) {
  using Time = detail::TimeOf<std::ranges::range_value_t<Samples>>;
  auto sample = std::ranges::begin(samples);
  const auto end = std::ranges::end(samples);
  if (sample == end) detail::refuse<std::invalid_argument>("preintegrate: no samples, expected at least one");
  Preintegrator<Scheme, detail::ScalarOfSamples<Samples>, Time, Noise> preintegrator((*sample).time, bias, noise, gaps);
  for (; sample != end; ++sample) preintegrator.push(*sample);
  preintegrator.finish();
  return preintegrator.result();
}

}  // namespace splinertia
