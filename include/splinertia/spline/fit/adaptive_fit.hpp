// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <splinertia/spline/fit/choose_knots.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <utility>
#include <vector>

namespace splinertia {

/// fit() with knots that follow the motion: where the RMS of a component of the residuals within a span exceeds `goal`
/// by more than chance (three standard deviations of that RMS), the span is halved, until none does or has fewer than
/// four poses. Needs NonUniformKnots; the knots are fit.spline.knots(). Of the options, knots or knot_interval is where
/// it starts (by default, a segment for every 256 poses); with a robust loss, outliers have no weight (search_options).
/// Throws std::invalid_argument for a goal that is not finite and positive, or as fit() does.
template <typename Curve, StampedPoses Poses>
  requires std::same_as<KnotsOf<Curve>, NonUniformKnots<typename Curve::Time>>
[[nodiscard]] Fit<Curve> adaptive_fit(const Poses& poses, const Tangent<typename Curve::Group>& goal,
                                      FitOptions<Curve> options = {}) {
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  constexpr auto k = static_cast<std::ptrdiff_t>(Curve::order);
  check_goal<G>("adaptive_fit", goal);
  const auto data = fit_data<Curve>(poses, "adaptive_fit");
  if (!options.knot_interval && !options.knots && data.size() >= 2) {
    options.knot_interval =
        to_seconds<double>(data.back().time - data.front().time) / std::ceil(static_cast<double>(data.size()) / 256);
  }
  options = search_options<Curve>(std::move(options), data, goal);
  for (;;) {
    Fit<Curve> result = fit<Curve>(data, options);
    const auto& knots = result.spline.knots().knots;
    std::vector<typename Curve::Time> finer(knots.begin(), knots.begin() + k);
    std::size_t i = 0;
    for (auto knot = knots.begin() + k; knot != knots.end() - k + 1; ++knot) {
      const bool last = knot + k == knots.end();
      Tangent<G> squares = Tangent<G>::Zero();
      std::vector<std::size_t> inside;
      for (; i < data.size() && (data[i].time < *knot || last); ++i) {
        if (!options.weights.empty() && options.weights[i] == Scalar(0)) continue;
        inside.push_back(i);
        squares += result.residuals.poses[i].cwiseAbs2();
      }
      if (inside.size() >= 4) {
        const auto count = static_cast<Scalar>(inside.size());
        const Scalar chance = Scalar(1) + Scalar(3) * std::sqrt(Scalar(2) / count);
        if ((squares.array() > count * chance * goal.array().square()).any()) {
          finer.push_back(data[inside[inside.size() / 2]].time);
        }
      }
      finer.push_back(*knot);
    }
    // A span that is halved keeps two poses on either side, which is still too few for the control points in all where
    // there are hardly more of them than the order.
    const bool same = finer.size() + static_cast<std::size_t>(k) - 1 == knots.size();
    if (same || finer.size() - 1 > data.size()) return result;
    finer.insert(finer.end(), knots.end() - k + 1, knots.end());
    options.knot_interval.reset();
    options.knots = KnotsOf<Curve>{std::move(finer)};
  }
}

}  // namespace splinertia
