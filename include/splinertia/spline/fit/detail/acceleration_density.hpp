// SPDX-License-Identifier: MIT
/// The spectral density of a curve's acceleration beside a span without poses. It sets the prior that bridges the span.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/spline/fit/detail/unmeasured_spans.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia::detail {

/// Times on both sides of a span, s from the start of the curve, nearest first.
struct Anchors {
  std::vector<double> before{}, behind{};
};

/// Times on the measured parts of a curve to one side of a span, nearest first, at most 9. `direction` is −1 towards
/// the start of the curve and 1 towards its end; `from` is the index of the measured part beside the span.
///
/// The times in a part are one step apart: at most `longest_step`, but at least `knot_interval`. The first is up to
/// one knot interval away from the near end of the part, so that one wrong pose there affects none of them. A measured
/// part shorter than a step has one time, in its middle.
[[nodiscard]] inline std::vector<double> anchors_beside(const std::vector<MeasuredPart>& parts, std::ptrdiff_t from,
                                                        int direction, double longest_step, double knot_interval) {
  constexpr std::size_t most = 9;
  std::vector<double> anchors;
  double step = 0;
  for (std::ptrdiff_t i = from; i >= 0 && i < std::ssize(parts) && anchors.size() < most; i += direction) {
    const auto& part = parts[static_cast<std::size_t>(i)];
    const double length = part.end - part.start, guard = (std::min)(knot_interval, length / 3);
    if (i == from) step = (std::max)(knot_interval, (std::min)(longest_step, (length - guard) / 2));
    if (length < step) {
      anchors.push_back(part.start + length / 2);
      continue;
    }
    for (double inside = guard; inside <= length && anchors.size() < most; inside += step) {
      anchors.push_back(direction > 0 ? part.start + inside : part.end - inside);
    }
  }
  return anchors;
}

/// Estimates the spectral density of the second derivative (order 2: first derivative) of a curve at the time scale of
/// a span, per component: m²/s⁴/Hz and rad²/s⁴/Hz. If the second derivative is white noise of density S, the mean
/// slopes over two neighbouring intervals of lengths τ₁ and τ₂ differ by
///
///   D = x₂₁/τ₂ − x₁₀/τ₁,   E D² = S (τ₁ + τ₂)/3 + σ² (1/τ₁² + 1/τ₂² + (1/τ₁ + 1/τ₂)²)
///
/// where σ is the standard deviation of a value of the curve. The result is the largest of four estimates of S: the
/// mean over the changes of slope before the span, the mean over those after it, and the changes of slope into and out
/// of the span. It is at least the S at which the motion would be as large as the noise, because less is not
/// observable.
template <typename Curve>
class AccelerationDensity {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// `deviation` is σ. Stores a reference to the curve.
  AccelerationDensity(std::reference_wrapper<const Curve> curve, const Tangent<G>& deviation)
      : curve_(curve), variance_(deviation.cwiseAbs2()) {}

  /// The density at the scale of the anchors. Empty if there are too few anchors for any change of slope.
  [[nodiscard]] std::optional<Tangent<G>> around(const Anchors& anchors) {
    start();
    add_side(anchors.before);
    add_side(anchors.behind);
    if constexpr (changes_of_slope) {
      const auto &l = anchors.before, &r = anchors.behind;
      if (l.size() > 1 && !r.empty()) add({l[1], l[0], r[0]});
      if (r.size() > 1 && !l.empty()) add({l[0], r[0], r[1]});
    } else if (!anchors.before.empty() && !anchors.behind.empty()) {
      add({anchors.before[0], anchors.behind[0]});
    }
    if (!any_) return std::nullopt;
    return largest_.cwiseMax(noise_);
  }

  /// The density at the time scale of `nearby`, anchors closer together than the span is long: the largest of the S of
  /// both sides and the S of the acceleration that the cubic across the span has at its ends. Motion that is smooth
  /// within the span changes its slope over short times by less than a white second derivative would. Empty unless
  /// there is a change of slope on both sides, and for order 2.
  [[nodiscard]] std::optional<Tangent<G>> at_scale_of(const Anchors& nearby) {
    if (!changes_of_slope || nearby.before.size() < times || nearby.behind.size() < times) return std::nullopt;
    start();
    add_side(nearby.before);
    add_side(nearby.behind);
    const double l1 = nearby.before[1], l0 = nearby.before[0], r0 = nearby.behind[0], r1 = nearby.behind[1];
    const Tangent<G> in = slope(l1, l0), across = slope(l0, r0), out = slope(r0, r1);
    const auto length = static_cast<Scalar>(r0 - l0), step = static_cast<Scalar>((std::max)(l0 - l1, r1 - r0));
    const Tangent<G> first = (6 * across - 4 * in - 2 * out) / length, last = (2 * in + 4 * out - 6 * across) / length;
    largest_ = largest_.cwiseMax(Scalar(3) / 2 * step * first.cwiseAbs2().cwiseMax(last.cwiseAbs2())).eval();
    return largest_.cwiseMax(noise_);
  }

 private:
  static constexpr bool changes_of_slope = Curve::order > 2;
  static constexpr std::size_t times = changes_of_slope ? 3 : 2;

  void start() {
    any_ = false;
    largest_.setZero();
    noise_.setZero();
  }

  [[nodiscard]] G value(double time) const {
    const auto t = std::clamp(after(curve_.start(), time), curve_.start(), curve_.end());
    return curve_.template evaluate<0>(t).value;
  }

  [[nodiscard]] Tangent<G> slope(double from, double to) const {
    return increment<G>(value(from), value(to)) / static_cast<Scalar>(to - from);
  }

  /// S of one change of slope without the share of the noise, and that share.
  struct Change {
    Tangent<G> density, noise;
  };
  [[nodiscard]] Change change(const std::array<double, times>& t) const {
    const Scalar first = Scalar(1) / static_cast<Scalar>(t[1] - t[0]);
    if constexpr (changes_of_slope) {
      const Scalar second = Scalar(1) / static_cast<Scalar>(t[2] - t[1]), both = first + second;
      const Scalar to_density = Scalar(3) / static_cast<Scalar>(t[2] - t[0]);
      const Tangent<G> noise = variance_ * (to_density * (first * first + second * second + both * both));
      return {Tangent<G>(slope(t[1], t[2]) - slope(t[0], t[1])).cwiseAbs2() * to_density - noise, noise};
    } else {
      const Tangent<G> noise = variance_ * (2 * first);
      return {slope(t[0], t[1]).cwiseAbs2() / first - noise, noise};
    }
  }

  void add(const std::array<double, times>& t) {
    const Change c = change(t);
    take(c.density, c.noise);
  }

  /// Adds the mean over the changes of slope on one side.
  void add_side(const std::vector<double>& anchors) {
    Tangent<G> density = Tangent<G>::Zero(), noise = Tangent<G>::Zero();
    std::size_t count = 0;
    for (; count + times <= anchors.size(); ++count) {
      std::array<double, times> t;
      std::copy_n(anchors.begin() + static_cast<std::ptrdiff_t>(count), times, t.begin());
      std::sort(t.begin(), t.end());
      const Change c = change(t);
      density += c.density;
      noise += c.noise;
    }
    if (count > 0) take(density / static_cast<Scalar>(count), noise / static_cast<Scalar>(count));
  }

  void take(const Tangent<G>& density, const Tangent<G>& noise) {
    largest_ = largest_.cwiseMax(density);
    noise_ = any_ ? Tangent<G>(noise_.cwiseMin(noise)) : noise;
    any_ = true;
  }

  const Curve& curve_;
  Tangent<G> variance_;
  bool any_ = false;
  Tangent<G> largest_, noise_;
};

}  // namespace splinertia::detail
