// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <splinertia/spline/fit/choose_knots.hpp>
#include <splinertia/spline/fit/detail/split_spans.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <utility>
#include <vector>

namespace splinertia {

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
