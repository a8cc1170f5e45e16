// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/strapdown/detail/stencil.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

namespace detail {

/// The motion over h by the classical Runge–Kutta method of order 4, from rate (gyro) and force (accel) at the
/// beginning, middle and end. The attitude is integrated in the Lie algebra, φ' = J_r⁻¹(φ) ω (Munthe-Kaas), with
/// J_r⁻¹ ≈ I + φ^/2 + φ^²/12, whose next term contributes at fifth order. The exponential of φ is exact.
template <typename Scalar>
[[nodiscard]] NavIncrement<Scalar> runge_kutta4_step(const std::array<Eigen::Vector3<Scalar>, 3>& gyro,
                                                     const std::array<Eigen::Vector3<Scalar>, 3>& accel,
                                                     const Scalar& h) {
  const auto rate = [](const Eigen::Vector3<Scalar>& phi,
                       const Eigen::Vector3<Scalar>& omega) -> Eigen::Vector3<Scalar> {
    const Eigen::Vector3<Scalar> once = phi.cross(omega);
    return omega + once / Scalar(2) + phi.cross(once) / Scalar(12);
  };
  const Scalar half = h / Scalar(2), sixth = h / Scalar(6);
  const Eigen::Vector3<Scalar> k1 = gyro[0];
  const Eigen::Vector3<Scalar> k2 = rate(k1 * half, gyro[1]);
  const Eigen::Vector3<Scalar> phi2 = k2 * half;
  const Eigen::Vector3<Scalar> k3 = rate(phi2, gyro[1]);
  const Eigen::Vector3<Scalar> phi3 = k3 * h;
  const Eigen::Vector3<Scalar> k4 = rate(phi3, gyro[2]);
  const auto rotation = rotation_exp<Scalar>((k1 + (k2 + k3) * Scalar(2) + k4) * sixth);
  // Accelerations at the stages; velocity and position are quadratures of them.
  const Eigen::Vector3<Scalar> a2 = rotate<Scalar>(rotation_exp<Scalar>(k1 * half), accel[1]);
  const Eigen::Vector3<Scalar> a3 = rotate<Scalar>(rotation_exp<Scalar>(phi2), accel[1]);
  const Eigen::Vector3<Scalar> a4 = rotate<Scalar>(rotation_exp<Scalar>(phi3), accel[2]);
  return {rotation, (accel[0] + (a2 + a3) * Scalar(2) + a4) * sixth, (accel[0] + a2 + a3) * (sixth * h), h};
}

}  // namespace detail

/// The Runge–Kutta method of order 4 with linear interpolation between the two samples of a step, as in many
/// estimators. The interpolation limits it to order 2.
struct RungeKutta4 : PointScheme<2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    const auto& first = window[from];
    const auto& second = window[from + 1];
    const Scalar half = Scalar(1) / Scalar(2);
    return detail::runge_kutta4_step<Scalar>({first.gyro, (first.gyro + second.gyro) * half, second.gyro},
                                             {first.accel, (first.accel + second.accel) * half, second.accel},
                                             step_interval<Scalar>(window, from));
  }
};

/// The Runge–Kutta method of order 4 over two intervals at a time, with the sample between them as the middle. Order 4,
/// without interpolation. For unequal intervals, and for a single interval left at the end of a run, the middle is
/// interpolated by the cubic through four samples.
///
/// Very unequal intervals: the weights of the middle differ from those of the straight line between the two samples
/// about it by at most 5/2 in absolute sum. If those of the cubic differ by more, the parabola through the samples of
/// the step is used. If those of the parabola do, too, the line is used. Noise is then at most about twice Midpoint's
/// for any stamps. Intervals within a factor of two of each other always keep the cubic, and so order 4; within a
/// factor of three nearly all do. A run of two samples is integrated with the line, one of three with the parabola.
struct RungeKutta4DoubleStep : PointScheme<4, 2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    const std::size_t end = from == 2 ? 3 : from + 2;
    const Scalar h = to_seconds<Scalar>(window[end].time - window[from].time);
    const Scalar offset = step_interval<Scalar>(window, from) - h / Scalar(2);  // of the sample in between
    using std::abs;
    if (abs(offset) <= h * Scalar(1e-9F)) {
      const auto& sample = window[from + 1];
      return detail::runge_kutta4_step<Scalar>({window[from].gyro, sample.gyro, window[end].gyro},
                                               {window[from].accel, sample.accel, window[end].accel}, h);
    }
    const Scalar zero(0);
    const std::size_t line = from == 2 || offset > zero ? from : from + 1;
    const auto middle = [](const std::array<Scalar, 4>& c) { return std::array<Scalar, 1>{c[0]}; };
    const auto s = detail::centred(detail::times_from<Scalar>(window, from), from, h);
    const auto w =
        detail::stable_weights(s, detail::Nodes<2>{line}, detail::Nodes<3>{end - 2}, middle, Scalar(5) / Scalar(2))[0];
    const Eigen::Vector3<Scalar> gyro =
        w[0] * window[0].gyro + w[1] * window[1].gyro + w[2] * window[2].gyro + w[3] * window[3].gyro;
    const Eigen::Vector3<Scalar> accel =
        w[0] * window[0].accel + w[1] * window[1].accel + w[2] * window[2].accel + w[3] * window[3].accel;
    return detail::runge_kutta4_step<Scalar>({window[from].gyro, gyro, window[end].gyro},
                                             {window[from].accel, accel, window[end].accel}, h);
  }
};

}  // namespace splinertia
