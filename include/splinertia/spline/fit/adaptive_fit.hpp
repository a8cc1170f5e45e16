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

namespace detail {

/// The knots of a fit up to the end of its domain, with a knot at the middle pose of each span whose residuals exceed
/// the goal. See adaptive_fit().
template <typename Curve>
[[nodiscard]] std::vector<typename Curve::Time> split_spans(const Fit<Curve>& fitted, const PosesOf<Curve>& data,
                                                            const std::vector<typename Curve::Scalar>& weights,
                                                            const Tangent<typename Curve::Group>& goal) {
  using Scalar = typename Curve::Scalar;
  using Square = Tangent<typename Curve::Group>;
  constexpr auto k = static_cast<std::ptrdiff_t>(Curve::order);
  const auto& knots = fitted.spline.knots().knots;
  std::vector<typename Curve::Time> finer(knots.begin(), knots.begin() + k);
  std::size_t i = 0;
  for (auto knot = knots.begin() + k; knot != knots.end() - k + 1; ++knot) {
    const bool last = knot + k == knots.end();
    Square squares = Square::Zero();
    std::vector<std::size_t> inside;
    for (; i < data.size() && (data[i].time < *knot || last); ++i) {
      if (!weights.empty() && weights[i] == Scalar(0)) continue;
      inside.push_back(i);
      squares += fitted.residuals.poses[i].cwiseAbs2();
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
  return finer;
}

}  // namespace detail

/// fit() with knots that follow the motion. A span is split at its middle pose if in some component the mean square of
/// its residuals exceeds that of `goal`, an RMS, by more than chance (three standard deviations of the mean square).
/// This goes on until no span of four or more poses does, or a further split would give more control points than poses.
///
/// Needs NonUniformKnots; the knots are fit.spline.knots(). The options knots or knot_interval give the start (by
/// default, one segment per 256 poses). With a robust loss, outliers have no weight (search_options). Throws
/// std::invalid_argument for a goal that is not finite and positive, or as fit() does.
template <typename Curve, detail::StampedPoses Poses>
  requires std::same_as<detail::KnotsOf<Curve>, NonUniformKnots<typename Curve::Time>>
[[nodiscard]] Fit<Curve> adaptive_fit(const Poses& poses, const Tangent<typename Curve::Group>& goal,
                                      FitOptions<Curve> options = {}) {
  using G = typename Curve::Group;
  constexpr auto k = static_cast<std::ptrdiff_t>(Curve::order);
  detail::check_goal<G>("adaptive_fit", goal);
  const auto data = convert_poses<Curve>(poses, "adaptive_fit");
  if (!options.knot_interval && !options.knots && data.size() >= 2) {
    options.knot_interval =
        to_seconds<double>(data.back().time - data.front().time) / std::ceil(static_cast<double>(data.size()) / 256);
  }
  options = detail::search_options<Curve>(std::move(options), data, goal);
  for (;;) {
    Fit<Curve> result = fit<Curve>(data, options);
    const auto& knots = result.spline.knots().knots;
    auto finer = detail::split_spans<Curve>(result, data, options.weights, goal);
    // A split span has at least two poses on either side. Even so, there may be fewer poses than control points if
    // there are hardly more poses than the order.
    const bool same = finer.size() + static_cast<std::size_t>(k) - 1 == knots.size();
    if (same || finer.size() - 1 > data.size()) return result;
    finer.insert(finer.end(), knots.end() - k + 1, knots.end());
    options.knot_interval.reset();
    options.knots = detail::KnotsOf<Curve>{std::move(finer)};
  }
}

}  // namespace splinertia
