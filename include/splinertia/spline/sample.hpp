// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/sample_rows.hpp>
#include <splinertia/group/parameters.hpp>
#include <splinertia/motion/motion.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/spline/detail/packed_samples.hpp>
#include <splinertia/spline/sample_times.hpp>
#include <utility>
#include <vector>

namespace splinertia {

/// The motion at many times, the result of sample<D>().
///
///   const auto samples = sample<1>(curve, curve.start(), 0.001, 10000);
///   samples[17].velocity;                     // a Motion, assembled from the numbers of one sample
///   samples.velocity().row(2);                // one component at all times, contiguous
///
/// Values of a group without ParameterLayout, such as your own, are stored as objects.
template <LieGroup G, int D>
class MotionSamples {
 public:
  using Scalar = ScalarOf<G>;
  static constexpr bool has_parameters = HasParameterLayout<G>;
  static constexpr int parameters = [] {
    if constexpr (has_parameters) return parameter_count<G>;
    return 0;
  }();
  static constexpr int dof = DofOf<G>;
  using Rows = detail::SampleRows<Scalar, parameters + D * dof>;

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  void resize(std::size_t size) {
    rows_.resize(size);
    if constexpr (!has_parameters) values_.resize(size, GroupTraits<G>::identity());
  }

  [[nodiscard]] Motion<G, D> operator[](std::size_t i) const {
    Motion<G, D> m;
    if constexpr (has_parameters) {
      m.value = read_parameters<G>(rows_.template column<parameters>(0, i).data());
    } else {
      m.value = values_[i];
    }
    if constexpr (D >= 1) m.velocity = rows_.template column<dof>(parameters, i);
    if constexpr (D >= 2) m.acceleration = rows_.template column<dof>(parameters + dof, i);
    if constexpr (D >= 3) m.jerk = rows_.template column<dof>(parameters + 2 * dof, i);
    return m;
  }
  [[nodiscard]] detail::SampleIterator<MotionSamples> begin() const { return {*this, 0}; }
  [[nodiscard]] detail::SampleIterator<MotionSamples> end() const { return {*this, size()}; }

  /// The parameters of all values (group/parameters.hpp), parameters × size(), and the derivatives, dof × size(). A
  /// view of the stored numbers, or, for a temporary, a copy.
  [[nodiscard]] auto value() const&
    requires has_parameters
  {
    return rows_.template rows<parameters>(0);
  }
  [[nodiscard]] auto value() &&
    requires has_parameters
  {
    return std::move(rows_).template rows<parameters>(0);
  }
  [[nodiscard]] auto velocity() const&
    requires(D >= 1)
  {
    return rows_.template rows<dof>(parameters);
  }
  [[nodiscard]] auto velocity() &&
    requires(D >= 1)
  {
    return std::move(rows_).template rows<dof>(parameters);
  }
  [[nodiscard]] auto acceleration() const&
    requires(D >= 2)
  {
    return rows_.template rows<dof>(parameters + dof);
  }
  [[nodiscard]] auto acceleration() &&
    requires(D >= 2)
  {
    return std::move(rows_).template rows<dof>(parameters + dof);
  }
  [[nodiscard]] auto jerk() const&
    requires(D >= 3)
  {
    return rows_.template rows<dof>(parameters + 2 * dof);
  }
  [[nodiscard]] auto jerk() &&
    requires(D >= 3)
  {
    return std::move(rows_).template rows<dof>(parameters + 2 * dof);
  }

  class Writer {
   public:
    explicit Writer(MotionSamples& samples) : rows_(samples.rows_), values_(samples.values_.data()) {}

    /// Writes sample i, or, if the scalar of H is a SIMD pack, samples i, i + 1, ….
    template <LieGroup H>
    void write(std::size_t i, const Motion<H, D>& m) const {
      if constexpr (has_parameters) {
        detail::FixedArray<ScalarOf<H>, parameters> numbers;
        write_parameters(m.value, numbers.data());
        rows_.template write<0, parameters>(i, numbers);
      } else {
        values_[i] = m.value;
      }
      if constexpr (D >= 1) rows_.template write<parameters, dof>(i, m.velocity);
      if constexpr (D >= 2) rows_.template write<parameters + dof, dof>(i, m.acceleration);
      if constexpr (D >= 3) rows_.template write<parameters + 2 * dof, dof>(i, m.jerk);
    }

   private:
    typename Rows::Writer rows_;
    G* values_;
  };

 private:
  Rows rows_;
  std::vector<G> values_;  // empty if the rows hold the values
};

/// Evaluates samples first … first + count − 1 of `times` into `samples`, whose memory is reused: long runs need
/// constant memory. Throws as sample() below.
template <int D, typename C>
  requires Trajectory<C, D>
void sample(const C& curve, const SampleTimes<typename C::Time>& times, std::size_t first, std::size_t count,
            MotionSamples<typename C::Group, D>& samples) {
  detail::check_sample_times(times, first + count, curve.start(), curve.end());
  samples.resize(count);
  const typename MotionSamples<typename C::Group, D>::Writer to(samples);
  detail::for_each_sample<D>(curve, times, first, count,
                             [first, to](std::size_t i, const auto& motion) { to.write(i - first, motion); });
}

/// Value and first D derivatives of a curve at `count` times from `start` on, `interval` apart. The results are those
/// of evaluate<D>(). A PackedCurve is evaluated at several times at once, which is several times as fast
/// (spline/detail/packed_samples.hpp); other curves are evaluated at one time after the other.
///
/// Throws std::invalid_argument unless the interval is positive and finite, and std::out_of_range if a time is outside
/// the domain of the curve. The last may exceed its end by rounding.
template <int D, typename C>
  requires Trajectory<C, D>
[[nodiscard]] MotionSamples<typename C::Group, D> sample(const C& curve, typename C::Time start,
                                                         typename C::Time interval, std::size_t count) {
  MotionSamples<typename C::Group, D> samples;
  sample<D>(curve, SampleTimes{start, interval}, 0, count, samples);
  return samples;
}

}  // namespace splinertia
