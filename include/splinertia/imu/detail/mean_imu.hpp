// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <splinertia/imu/imu_measurement.hpp>
#include <splinertia/time.hpp>

namespace splinertia::detail {

/// A curve that can tell where its segments end, as Spline does.
template <typename C>
concept HasSegments = requires(const C& curve, std::size_t s) {
  { curve.knots().segment(curve.start(), s, C::order) } -> std::convertible_to<std::size_t>;
  { curve.knots().knot(s, C::order) } -> std::convertible_to<typename C::Time>;
  { curve.segments() } -> std::convertible_to<std::size_t>;
};

/// The means of what a perfect IMU measures over an interval, in its turning axes: ∫ω dt/h and ∫f dt/h.
///
/// Gauss–Legendre quadrature with four nodes in each panel; panels end at the knots of a spline. Over a panel of
/// length h, the mean of a reading f is wrong by at most 5.7e-10 h⁸ max|f⁽⁸⁾|. Hence for a reading that oscillates with ω rad/s
/// the error is at most 5.7e-10 (ωh)⁸ of the amplitude. Nodes at integer times are rounded symmetrically to the middle
/// of the panel, so that the rounding of a reading of constant slope cancels.
template <typename C>
class MeanImu {
 public:
  using Scalar = ScalarOf<typename C::Group>;
  using Time = typename C::Time;

  MeanImu() {
    using std::sqrt;
    const Scalar inner = sqrt(Scalar(6) / Scalar(5)) * (Scalar(2) / Scalar(7)), middle = Scalar(3) / Scalar(7);
    node_ = {(Scalar(1) - sqrt(middle + inner)) / Scalar(2), (Scalar(1) - sqrt(middle - inner)) / Scalar(2)};
    const Scalar root = sqrt(Scalar(30));
    weight_ = {(Scalar(18) - root) / Scalar(72), (Scalar(18) + root) / Scalar(72)};
  }

  /// ideal(t): the measurement at time t. Requires begin < end, both in the domain of the curve.
  [[nodiscard]] ImuMeasurement<Scalar> operator()(const C& curve, Time begin, Time end, const auto& ideal) const {
    ImuMeasurement<Scalar> mean{Eigen::Vector3<Scalar>::Zero(), Eigen::Vector3<Scalar>::Zero()};
    const Scalar whole = to_seconds<Scalar>(end - begin);
    const auto add = [&](Time from, Time to) {
      const Scalar share = to_seconds<Scalar>(to - from) / whole;
      for (std::size_t i = 0; i < node_.size(); ++i) {
        const Time offset = part_of(to - from, node_[i]);
        for (const Time t : {from + offset, to - offset}) {
          const auto at = ideal(t);
          mean.gyro += at.gyro * (weight_[i] * share);
          mean.accel += at.accel * (weight_[i] * share);
        }
      }
    };
    if constexpr (HasSegments<C>) {
      std::size_t s = curve.knots().segment(begin, curve.control_points().size(), C::order);
      for (Time from = begin; from < end; ++s) {
        const Time to = s + 1 < curve.segments() ? (std::min)(end, Time(curve.knots().knot(s + 1, C::order))) : end;
        if (to > from) add(from, to);
        from = (std::max)(from, to);
      }
    } else {
      add(begin, end);
    }
    return mean;
  }

 private:
  // share · length, to the nearest tick.
  [[nodiscard]] static Time part_of(Time length, const Scalar& share) {
    if constexpr (std::floating_point<Time>) {
      return static_cast<Time>(share) * length;
    } else {
      return Time(static_cast<typename Time::rep>(
          std::llround(static_cast<double>(share) * static_cast<double>(length.count()))));
    }
  }

  std::array<Scalar, 2> node_, weight_;  // of one half; the other is its mirror image
};

}  // namespace splinertia::detail
