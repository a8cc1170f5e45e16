// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/sample_rows.hpp>
#include <splinertia/group/parameters.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/spline/detail/packed_samples.hpp>
#include <splinertia/spline/sample_times.hpp>
#include <utility>

namespace splinertia {

namespace detail {

/// What a perfect IMU measures at one time, and the body's pose.
template <Pose G, TimePoint Time = double>
struct ImuSampleAtPose : ImuSample<ScalarOf<G>, Time> {
  G pose;  ///< T_WB
};

}  // namespace detail

/// What a perfect IMU measures at many times, with the poses of the body, as sample_imu() returns it.
///
///   const auto samples = sample_imu(curve, curve.start(), 0.001, 10000);
///   samples[17].gyro;                         // and .time, .accel, .pose: of one sample
///   samples.accel().row(2);                   // the z axis at all times, contiguous
template <Pose G, TimePoint T = double>
class ImuSamples {
 public:
  using Scalar = ScalarOf<G>;
  using Time = T;
  static constexpr int parameters = parameter_count<G>;

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// Makes room for samples first … first + count − 1 of `times`.
  void resize(const SampleTimes<Time>& times, std::size_t first, std::size_t count) {
    rows_.resize(count);
    times_ = times;
    first_ = first;
  }

  [[nodiscard]] Time time(std::size_t i) const { return times_(first_ + i); }

  [[nodiscard]] detail::ImuSampleAtPose<G, Time> operator[](std::size_t i) const {
    return {{time(i), rows_.template column<3>(0, i), rows_.template column<3>(3, i)},
            read_parameters<G>(rows_.template column<parameters>(6, i).data())};
  }
  [[nodiscard]] detail::SampleIterator<ImuSamples> begin() const { return {*this, 0}; }
  [[nodiscard]] detail::SampleIterator<ImuSamples> end() const { return {*this, size()}; }

  /// Angular velocity (rad/s) and specific force (m/s²) in the IMU's axes (B without a mounting), 3 × size(): a view
  /// of the rows, or a copy if the object is a temporary.
  [[nodiscard]] auto gyro() const& { return rows_.template rows<3>(0); }
  [[nodiscard]] auto gyro() && { return std::move(rows_).template rows<3>(0); }
  [[nodiscard]] auto accel() const& { return rows_.template rows<3>(3); }
  [[nodiscard]] auto accel() && { return std::move(rows_).template rows<3>(3); }
  /// The parameters of the poses (group/parameters.hpp), parameters × size().
  [[nodiscard]] auto pose() const& { return rows_.template rows<parameters>(6); }
  [[nodiscard]] auto pose() && { return std::move(rows_).template rows<parameters>(6); }

  class Writer {
   public:
    explicit Writer(ImuSamples& samples) : rows_(samples.rows_) {}

    /// Writes sample i or, if H is G over SIMD packs, the samples from i on.
    template <Pose H>
    void write(std::size_t i, const ImuMeasurement<ScalarOf<H>>& imu, const H& pose) const {
      detail::FixedArray<ScalarOf<H>, parameters> numbers;
      write_parameters(pose, numbers.data());
      rows_.template write<0, 3>(i, imu.gyro);
      rows_.template write<3, 3>(i, imu.accel);
      rows_.template write<6, parameters>(i, numbers);
    }

   private:
    typename detail::SampleRows<Scalar, 6 + parameters>::Writer rows_;
  };

 private:
  detail::SampleRows<Scalar, 6 + parameters> rows_;
  SampleTimes<Time> times_{};
  std::size_t first_ = 0;
};

namespace detail {

/// What sample_imu() returns for a curve.
template <typename C>
using ImuSamplesOf = ImuSamples<typename C::Group, typename C::Time>;

}  // namespace detail

/// Computes samples first … first + count − 1 of `times` into memory that can be used again: long runs in constant
/// memory. With a Mounting as the last argument, the IMU is mounted so. All else as for sample_imu() below.
template <typename C, typename... Mount>
  requires(Trajectory<C, 2> && Pose<typename C::Group> && sizeof...(Mount) <= 1)
void sample_imu(const C& curve, const SampleTimes<typename C::Time>& times, std::size_t first, std::size_t count,
                detail::ImuSamplesOf<C>& samples, const Eigen::Vector3<ScalarOf<typename C::Group>>& gravity,
                const Mount&... mounting) {
  detail::check_sample_times(times, first + count, curve.start(), curve.end());
  samples.resize(times, first, count);
  const typename detail::ImuSamplesOf<C>::Writer to(samples);
  detail::for_each_sample<2>(
      curve, times, first, count, [first, to, gravity, mounting...](std::size_t i, const auto& motion) {
        using S = ScalarOf<typename std::remove_cvref_t<decltype(motion)>::Group>;
        if constexpr (detail::is_simd_pack<S>) {
          to.write(i - first, ideal_imu(motion, detail::with_scalar<S>(gravity), detail::with_scalar<S>(mounting)...),
                   motion.value);
        } else {
          to.write(i - first, ideal_imu(motion, gravity, mounting...), motion.value);
        }
      });
}

/// What a perfect IMU at the body's origin measures along a curve, and the poses, at `count` times from `start` on,
/// `interval` apart. The results are those of ideal_imu() of evaluate<2>() at each time. For a PackedCurve (splines),
/// several samples are computed at once, several times as fast (spline/detail/packed_samples.hpp). `gravity`:
/// acceleration of free fall in the world, m/s². Throws std::invalid_argument unless the interval is positive. Throws
/// std::out_of_range for times at which the curve is not defined; the last may exceed its end by rounding.
template <typename C>
  requires(Trajectory<C, 2> && Pose<typename C::Group>)
[[nodiscard]] detail::ImuSamplesOf<C> sample_imu(
    const C& curve, typename C::Time start, typename C::Time interval, std::size_t count,
    const Eigen::Vector3<ScalarOf<typename C::Group>>& gravity = standard_gravity<ScalarOf<typename C::Group>>()) {
  detail::ImuSamplesOf<C> samples;
  sample_imu(curve, SampleTimes{start, interval}, 0, count, samples, gravity);
  return samples;
}

/// The same for an IMU that is mounted on the body (ideal_imu.hpp). The poses are those of the body.
template <typename C>
  requires(Trajectory<C, 2> && Pose<typename C::Group>)
[[nodiscard]] detail::ImuSamplesOf<C> sample_imu(const C& curve, typename C::Time start, typename C::Time interval,
                                                 std::size_t count,
                                                 const Eigen::Vector3<ScalarOf<typename C::Group>>& gravity,
                                                 const Mounting<ScalarOf<typename C::Group>>& mounting) {
  detail::ImuSamplesOf<C> samples;
  sample_imu(curve, SampleTimes{start, interval}, 0, count, samples, gravity, mounting);
  return samples;
}

}  // namespace splinertia
