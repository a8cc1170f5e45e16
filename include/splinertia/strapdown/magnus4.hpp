// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <splinertia/strapdown/scheme.hpp>

namespace splinertia {

/// Fourth order: the Magnus expansion on the Galilean group of the cubic through four neighbouring samples, two before
/// and two after the step; in the first and the last step of a run, the nearest four. Any intervals: the weights are
/// exact for cubics on the stamps as they are (regular ones have constant weights).
///
/// What limits it: samples must be of a signal that is smooth to third order. Samples of a cubic spline are not (their
/// third derivative jumps at knots): there, and with noise, it is no better than Midpoint.
struct Magnus4 : PointScheme<4, 1, 1> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static StepMoments<Scalar> moments(const Window& window, std::size_t from) {
    const Scalar h = step_interval<Scalar>(window, from);
    if (from != 1 || !regular<Scalar>(window, h)) [[unlikely]]
      return moments_anywhere<Scalar>(window, from, h);
    // regular_weights, with what their symmetry saves.
    const Scalar a = h / Scalar(24), b = h / Scalar(720);
    const auto &w0 = window[0], &w1 = window[1], &w2 = window[2], &w3 = window[3];
    return {(Scalar(13) * (w1.gyro + w2.gyro) - (w0.gyro + w3.gyro)) * a,
            (Scalar(13) * (w1.accel + w2.accel) - (w0.accel + w3.accel)) * a,
            (Scalar(63) * (w2.gyro - w1.gyro) + (w0.gyro - w3.gyro)) * b,
            (Scalar(63) * (w2.accel - w1.accel) + (w0.accel - w3.accel)) * b, h};
  }

  /// ∫A dt = Σ mean_j A_j and ∫sA dt/h = Σ moment_j A_j over the step.
  template <typename Scalar>
  struct Weights {
    std::array<Scalar, 4> mean, moment;
  };

  /// Whether all three intervals are h, to a tolerance that puts an error of at most as much into the smallest weight.
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
    const Scalar before = step_interval<Scalar>(window, 0), middle = step_interval<Scalar>(window, 1),
                 after = step_interval<Scalar>(window, 2);
    return general_weights(std::array<Scalar, 4>{Scalar(0), before, before + middle, before + middle + after}, from, h);
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

  /// The moments of Lagrange's cubics: with s = (t − middle of the step)/h and l_j(s) = (s³ − e₁s² + e₂s − e₃)/D over
  /// s from −1/2 to 1/2, ∫l_j = −(e₁/12 + e₃)/D and ∫s l_j = (1/80 + e₂/12)/D.
  template <typename Scalar>
  [[nodiscard]] static Weights<Scalar> general_weights(const std::array<Scalar, 4>& times, std::size_t from,
                                                       const Scalar& h) {
    std::array<Scalar, 4> s;
    for (std::size_t j = 0; j < 4; ++j) s[j] = (times[j] - times[from]) / h - Scalar(1) / Scalar(2);
    Weights<Scalar> w;
    for (std::size_t j = 0; j < 4; ++j) {
      const Scalar a = s[(j + 1) % 4], b = s[(j + 2) % 4], c = s[(j + 3) % 4];
      const Scalar scale = h / ((s[j] - a) * (s[j] - b) * (s[j] - c));
      w.mean[j] = -((a + b + c) / Scalar(12) + a * b * c) * scale;
      w.moment[j] = (Scalar(1) / Scalar(80) + (a * b + b * c + c * a) / Scalar(12)) * scale;
    }
    return w;
  }

 private:
  // The first and the last steps of a run, and irregular ones: out of the way of the others.
  template <typename Scalar, typename Window>
  [[nodiscard, gnu::noinline, gnu::cold]] static StepMoments<Scalar> moments_anywhere(Window window, std::size_t from,
                                                                                      Scalar h) {
    const Weights<Scalar> w = weights<Scalar>(window, from, h);
    StepMoments<Scalar> m{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero(),
                          Vector3<Scalar>::Zero(), h};
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
