// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <splinertia/detail/inline.hpp>
#include <splinertia/strapdown/detail/stencil.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// Order 4: the Magnus expansion on the Galilean group for the cubic through four neighbouring samples, two on either
/// side of the step; in the first and the last step of a run, the nearest four. The weights are exact for cubics at any
/// stamps; for regular stamps they are constant.
///
/// Very unequal intervals: the weights of φ and ν differ from the trapezoid's by at most h in absolute sum, so noise is
/// at most doubled (Σ|w| ≤ 2h). If those of the cubic differ by more, the parabola through the step's two samples and
/// the neighbouring one across the longer interval is used. If those of the parabola do, too, the straight line is
/// used. Between inner samples the cubic is kept while no neighbouring interval is below a third of the step's (0.27 of
/// it if both are equal). Intervals within a factor of three of each other therefore keep order 4. A run of two samples
/// is integrated with the line, one of three with the parabola.
///
/// Limits: order 4 requires a signal that is smooth to third order. A cubic spline is not, since its third derivative
/// jumps at knots. For samples of one, and with noise, this scheme is no better than Midpoint.
struct Magnus4 : PointScheme<4, 1, 1> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::StepMoments<Scalar> moments(const Window& window, std::size_t from) {
    const Scalar h = step_interval<Scalar>(window, from);
    if (from != 1 || !regular<Scalar>(window, h)) [[unlikely]]
      return moments_anywhere<Scalar>(window, from, h);
    // regular_weights(), using their symmetry.
    const Scalar a = h / Scalar(24), b = h / Scalar(720);
    const auto &w0 = window[0], &w1 = window[1], &w2 = window[2], &w3 = window[3];
    return {(Scalar(13) * (w1.gyro + w2.gyro) - (w0.gyro + w3.gyro)) * a,
            (Scalar(13) * (w1.accel + w2.accel) - (w0.accel + w3.accel)) * a,
            (Scalar(63) * (w2.gyro - w1.gyro) + (w0.gyro - w3.gyro)) * b,
            (Scalar(63) * (w2.accel - w1.accel) + (w0.accel - w3.accel)) * b, h};
  }

  /// ∫A dt = Σ mean_j A_j and ∫sA dt/h = Σ moment_j A_j over the step, with the time s from its middle.
  template <typename Scalar>
  struct Weights {
    std::array<Scalar, 4> mean, moment;
  };

  /// Whether all three intervals are h to within 1e-6 h, which changes no weight by more than 3e-6 of its value.
  template <typename Scalar, typename Window>
  [[nodiscard]] static bool regular(const Window& window, const Scalar& h) {
    using std::abs;
    const Scalar tolerance = h * Scalar(1e-6F);
    return abs(step_interval<Scalar>(window, 0) - h) <= tolerance &&
           abs(step_interval<Scalar>(window, 1) - h) <= tolerance &&
           abs(step_interval<Scalar>(window, 2) - h) <= tolerance;
  }

  template <typename Scalar, typename Window>
  [[nodiscard]] static Weights<Scalar> weights(const Window& window, std::size_t from, const Scalar& h) {
    if (regular<Scalar>(window, h)) return regular_weights(from, h);
    return general_weights(detail::times_from<Scalar>(window, from), from, h);
  }

  template <typename Scalar>
  [[nodiscard]] static Weights<Scalar> regular_weights(std::size_t from, const Scalar& h) {
    const Scalar a = h / Scalar(24), b = h / Scalar(720);
    if (from == 1) return {{-a, Scalar(13) * a, Scalar(13) * a, -a}, {b, Scalar(-63) * b, Scalar(63) * b, -b}};
    if (from == 0) {
      return {{Scalar(9) * a, Scalar(19) * a, Scalar(-5) * a, a}, {Scalar(-59) * b, Scalar(57) * b, Scalar(3) * b, -b}};
    }
    return {{a, Scalar(-5) * a, Scalar(19) * a, Scalar(9) * a}, {b, Scalar(-3) * b, Scalar(-57) * b, Scalar(59) * b}};
  }

  /// The weights for samples at any four times, s.
  template <typename Scalar>
  [[nodiscard]] static Weights<Scalar> general_weights(const std::array<Scalar, 4>& times, std::size_t from,
                                                       const Scalar& h) {
    const auto s = detail::centred(times, from, h);
    // ∫p and ∫s·p over s from −1/2 to 1/2, of p = c₀ + c₁s + c₂s² + c₃s³.
    const Scalar a = h / Scalar(12), b = h / Scalar(80);
    const auto integrals = [&](const std::array<Scalar, 4>& c) {
      return std::array<Scalar, 2>{c[0] * h + c[2] * a, c[1] * a + c[3] * b};
    };
    const auto both = [](const auto& of) { return Weights<Scalar>{of[0], of[1]}; };
    // For such intervals stable_weights() would return the cubic as well.
    const Scalar mild = Scalar(1) / Scalar(3);
    if (from == 1 && s[1] - s[0] >= mild && s[3] - s[2] >= mild) [[likely]]
      return both(detail::lagrange_weights(s, detail::Nodes<4>{0}, integrals));
    const bool before = from == 2 || (from == 1 && s[1] - s[0] > s[3] - s[2]);
    return both(
        detail::stable_weights(s, detail::Nodes<2>{from}, detail::Nodes<3>{before ? from - 1 : from}, integrals, h));
  }

 private:
  // The first and the last steps of a run, and irregular ones; not inlined, because they are rare.
  template <typename Scalar, typename Window>
  [[nodiscard]] SPLINERTIA_COLD static detail::StepMoments<Scalar> moments_anywhere(Window window, std::size_t from,
                                                                                    Scalar h) {
    const Weights<Scalar> w = weights<Scalar>(window, from, h);
    detail::StepMoments<Scalar> m{Eigen::Vector3<Scalar>::Zero(), Eigen::Vector3<Scalar>::Zero(),
                                  Eigen::Vector3<Scalar>::Zero(), Eigen::Vector3<Scalar>::Zero(), h};
    for (std::size_t j = 0; j < 4; ++j) {
      m.phi += w.mean[j] * window[j].gyro;
      m.nu += w.mean[j] * window[j].accel;
      m.phi_moment += w.moment[j] * window[j].gyro;
      m.nu_moment += w.moment[j] * window[j].accel;
    }
    return m;
  }
};

}  // namespace splinertia
