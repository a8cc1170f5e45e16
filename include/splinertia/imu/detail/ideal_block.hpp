// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <numeric>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/sample_rows.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/spline/detail/packed_samples.hpp>
#include <type_traits>

namespace splinertia::detail {

/// A block of ideal measurements, computed ahead in constant memory. It is for curves that can be evaluated at several
/// times at once (PackedCurve), if the measurements are read in order.
template <PackedCurve C>
  requires Pose<typename C::Group>
class IdealImuBlock {
 public:
  using Scalar = typename C::Scalar;
  using Time = typename C::Time;
  static constexpr std::size_t capacity = 64;  // several SIMD packs per segment of most curves; 4 KiB with the times

  /// Computes the measurements at time(first), …, time(first + count − 1), count <= capacity. The times ascend and are
  /// about 1/rate seconds apart. `gravity` in the world, m/s²; `mounting`: a Mounting or NotMounted. Returns
  /// true if all are finite; false can also mean that their sums overflow.
  template <typename Mount>
  [[nodiscard]] SPLINERTIA_NOINLINE bool fill(const C& curve, const Eigen::Vector3<Scalar>& gravity,
                                              const Mount& mounting, double rate, std::size_t first, std::size_t count,
                                              const auto& time) {
    first_ = first;
    end_ = first + count;
    for (std::size_t i = 0; i < count; ++i) times_[i] = time(first + i);
    std::fill(times_.begin() + static_cast<std::ptrdiff_t>(count), times_.end(), times_[count - 1]);
    const typename Rows::Writer to(rows_);
    using L = typename PackedSegment<C>::L;
    L sum(Scalar(0));
    evaluate_packed<2>(curve, Times{times_.data(), rate}, 0, count,
                       [to, gravity, mounting, &sum](std::size_t i, const auto& motion) {
                         static_cast<void>(mounting);  // else unused where the IMU is not mounted
                         const auto imu = [&] {
                           if constexpr (std::is_same_v<Mount, NotMounted>) {
                             return ideal_imu(motion, with_scalar<L>(gravity));
                           } else {
                             return ideal_imu(motion, with_scalar<L>(gravity), with_scalar<L>(mounting));
                           }
                         }();
                         sum += finiteness(imu);
                         to.template write<0, 3>(i, imu.gyro);
                         to.template write<3, 3>(i, imu.accel);
                       });
    std::array<Scalar, lanes> sums;
    sum.store(sums.data());
    return is_finite(std::accumulate(sums.begin(), sums.end(), Scalar(0)));
  }

  /// Whether the block holds sample i, for i >= first.
  [[nodiscard]] bool holds(std::size_t i) const { return i < end_; }
  [[nodiscard]] Time time(std::size_t i) const { return times_[i - first_]; }
  [[nodiscard]] ImuMeasurement<Scalar> operator[](std::size_t i) const {
    return {rows_.template column<3>(0, i - first_), rows_.template column<3>(3, i - first_)};
  }

 private:
  static constexpr std::size_t lanes = static_cast<std::size_t>(PackedSegment<C>::L::size);
  using Rows = SampleRows<Scalar, 6, static_cast<int>(capacity)>;

  struct Times {
    const Time* times;
    double rate;

    [[nodiscard]] Time operator()(std::size_t i) const { return times[i]; }
    template <typename L>
    [[nodiscard]] L lanes(std::size_t i) const
      requires std::same_as<Time, double>
    {
      return L::load(times + i);
    }
    [[nodiscard]] double intervals(Time duration) const { return to_seconds<double>(duration) * rate; }
  };

  Rows rows_;
  std::array<Time, capacity + lanes> times_;
  std::size_t first_ = 0, end_ = 0;
};

}  // namespace splinertia::detail
