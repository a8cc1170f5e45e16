// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <vector>

namespace splinertia::detail {

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

}  // namespace splinertia::detail
