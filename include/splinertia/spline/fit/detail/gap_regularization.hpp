// SPDX-License-Identifier: MIT
/// Regularises a curve where there are no poses: a prior on its second derivative, as strong as the motion beside
/// suggests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <splinertia/spline/fit/detail/acceleration_density.hpp>
#include <splinertia/spline/fit/detail/smoothness.hpp>
#include <splinertia/spline/fit/detail/unmeasured_spans.hpp>
#include <splinertia/time.hpp>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// The sum of several SmoothnessTerms.
template <typename Curve>
struct SmoothnessTerms {
  std::vector<SmoothnessTerm<Curve>> terms;

  template <typename System>
  typename Curve::Scalar add(const Curve& curve, System& system) const {
    typename Curve::Scalar cost(0);
    for (const auto& term : terms) cost += term.add(curve, system);
    return cost;
  }
};

/// Makes the terms that regularise a curve where neither poses nor other measurements determine it.
template <typename Curve>
class GapRegularization {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  using Time = typename Curve::Time;

  /// `noise` is the standard deviation of a pose, `unit` the one that the residuals of poses are divided by. `share` is
  /// the share of the data that the control points take: the variance of a value of the curve over that of a pose.
  /// `others` are the ascending times of other measurements that determine the curve. Stores references to curve, spans
  /// and others.
  GapRegularization(std::reference_wrapper<const Curve> curve,
                    std::reference_wrapper<const std::vector<UnmeasuredSpan<Time>>> spans, const Tangent<G>& noise,
                    const Tangent<G>& unit, const Scalar& share, std::reference_wrapper<const std::vector<Time>> others)
      : curve_(curve),
        spans_(spans),
        parts_(measured_parts(curve_, spans_)),
        noise_(noise),
        unit_(unit),
        density_(curve, noise * sqrt_of(share)),
        others_(others) {}

  [[nodiscard]] SmoothnessTerms<Curve> terms(bool with_ends) {
    for (std::size_t i = 0; i < spans_.size(); ++i) regularize_gap(i);
    if (with_ends) regularize_ends();
    return std::move(terms_);
  }

 private:
  static constexpr int derivative = Curve::order > 2 ? 2 : 1;

  [[nodiscard]] static Scalar sqrt_of(const Scalar& value) {
    using std::sqrt;
    return sqrt(value);
  }

  /// Adds the prior over span i. Its density is that of the motion on both sides at the time scale of the span or of
  /// the knots, whichever is smaller.
  void regularize_gap(std::size_t i) {
    const auto& span = spans_[i];
    const double length = to_seconds<double>(span.end - span.start);
    const auto before = static_cast<std::ptrdiff_t>(i);
    const auto anchors = [&](double step) {
      return Anchors{anchors_beside(parts_, before, -1, step, span.knot_interval),
                     anchors_beside(parts_, before + 1, 1, step, span.knot_interval)};
    };
    auto density = density_.around(anchors(length));
    const auto nearby = density_.at_scale_of(anchors(span.knot_interval));
    if (density && nearby) density = density->cwiseMin(*nearby).eval();
    regularize(density, span.start, span.end, span.knot_interval, true);
  }

  /// Adds a weak prior over the outermost Order − 2 segments, where a single pose bends the curve freely. It allows
  /// accelerations up to three times those of the rest, noise included.
  void regularize_ends() {
    const auto& knots = curve_.knots();
    const std::size_t segments = curve_.segments(), reach = Curve::order > 2 ? Curve::order - 2 : 1;
    if (segments < 4 * reach) return;
    regularize_end(curve_.start(), knots.knot(reach, Curve::order), 1);
    regularize_end(knots.knot(segments - reach, Curve::order), curve_.end(), -1);
  }

  void regularize_end(Time from, Time to, int direction) {
    const double knot_interval = to_seconds<double>(to - from) / (Curve::order > 2 ? Curve::order - 2 : 1);
    const double edge = to_seconds<double>((direction > 0 ? to : from) - curve_.start());
    // The measured parts of the curve without the segments of this end.
    std::vector<MeasuredPart> inner;
    for (const MeasuredPart& part : parts_) {
      const MeasuredPart rest = direction > 0 ? MeasuredPart{(std::max)(part.start, edge), part.end}
                                              : MeasuredPart{part.start, (std::min)(part.end, edge)};
      if (rest.start <= rest.end) inner.push_back(rest);
    }
    if (inner.empty() || !(knot_interval > 0)) return;
    const std::ptrdiff_t first = direction > 0 ? 0 : std::ssize(inner) - 1;
    const Anchors anchors{anchors_beside(inner, first, direction, knot_interval, knot_interval), {}};
    regularize(density_.around(anchors), from, to, knot_interval, false);
  }

  /// Adds the prior over [from, to] where other measurements are more than 1.5 knot intervals apart. Its amplitude is
  /// three times as large, i.e. the prior is weaker, if poses determine the curve, too (`needed` is false).
  void regularize(const std::optional<Tangent<G>>& found, Time from, Time to, double knot_interval, bool needed) {
    const Scalar amplitude = needed ? Scalar(1) : Scalar(3);
    const auto length = to_seconds<Scalar>(to - from);
    // If nothing is beside the span: a motion within it that the noise could hide.
    const Scalar unseen = derivative == 2 ? 9 / (length * length * length) : 4 / length;
    const Tangent<G> density = found.value_or(unseen * noise_.cwiseAbs2());
    Tangent<G> root = amplitude * density.cwiseSqrt().cwiseQuotient(noise_);
    if (needed) {
      // The prior weighs at least √eps relative to a pose, otherwise the equations would be singular.
      const auto interval = static_cast<Scalar>(knot_interval);
      const Scalar weakest = Scalar(1) / sqrt_of(sqrt_of(std::numeric_limits<Scalar>::epsilon())) /
                             (derivative == 2 ? interval * sqrt_of(interval) : sqrt_of(interval));
      root = root.cwiseMin(weakest).eval();
    }
    root = root.cwiseProduct(unit_).eval();
    const auto add = [&](Time first, Time last, double least) {
      if (to_seconds<double>(last - first) > least) terms_.terms.emplace_back(derivative, root, first, last);
    };
    auto other = std::upper_bound(others_.begin(), others_.end(), from);
    if (other == others_.end() || *other >= to) return add(from, to, 0);
    Time before = from;
    for (; other != others_.end() && *other < to; ++other) {
      add(before, *other, 1.5 * knot_interval);
      before = *other;
    }
    add(before, to, 1.5 * knot_interval);
  }

  const Curve& curve_;
  const std::vector<UnmeasuredSpan<Time>>& spans_;
  std::vector<MeasuredPart> parts_;
  Tangent<G> noise_, unit_;
  AccelerationDensity<Curve> density_;
  const std::vector<Time>& others_;
  SmoothnessTerms<Curve> terms_;
};

}  // namespace splinertia::detail
