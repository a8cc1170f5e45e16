// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <vector>

namespace splinertia::detail {

/// Residuals of `curve` at the poses. Requires all poses within its domain. Poses for which counts(i) is false get a
/// residual, but are excluded from the statistics.
template <typename Curve>
[[nodiscard]] FitResiduals<typename Curve::Group> residuals_of(const PosesOf<Curve>& data, const Curve& curve,
                                                               const auto& counts) {
  using std::sqrt;
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  FitResiduals<G> result{{}, Tangent<G>::Zero(), Tangent<G>::Zero(), Scalar(0), Scalar(0)};
  result.poses.reserve(data.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const Tangent<G> r = increment<G>(data[i].value, curve.template evaluate<0>(data[i].time).value);
    result.poses.push_back(r);
    if (!counts(i)) continue;
    ++count;
    result.component_rms += r.cwiseAbs2();
    result.component_max = result.component_max.cwiseMax(r.cwiseAbs());
    result.max = (std::max)(result.max, Scalar(r.norm()));
  }
  if (count == 0) return result;
  result.component_rms /= static_cast<Scalar>(count);
  result.rms = sqrt(result.component_rms.sum());
  result.component_rms = result.component_rms.cwiseSqrt();
  return result;
}

/// Component-wise maximum of |log(first⁻¹ pose)| over all poses.
template <LieGroup G, typename Time>
[[nodiscard]] Tangent<G> extent_of(const std::vector<Stamped<G, Time>>& data) {
  Tangent<G> extent = Tangent<G>::Zero();
  for (const auto& pose : data) {
    extent = extent.cwiseMax(increment<G>(data.front().value, pose.value).cwiseAbs());
  }
  return extent;
}

/// A robust estimate of the standard deviation of a pose, per component: 1.4826 (as for normal noise) · median
/// |residual| / √free_share, and at least `least`. `free_share` is the share of the data that the control points leave
/// free.
template <typename Curve>
[[nodiscard]] Tangent<typename Curve::Group> robust_deviation(const PosesOf<Curve>& data, const Curve& curve,
                                                              const auto& counts,
                                                              const typename Curve::Scalar& free_share,
                                                              const typename Curve::Scalar& least) {
  using std::abs;
  using std::sqrt;
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  const FitResiduals<G> residuals = residuals_of(data, curve, counts);
  Tangent<G> deviation;
  std::vector<Scalar> magnitudes;
  for (int row = 0; row < deviation.size(); ++row) {
    magnitudes.clear();
    for (std::size_t i = 0; i < data.size(); ++i) {
      if (counts(i)) magnitudes.push_back(abs(residuals.poses[i][row]));
    }
    if (magnitudes.empty()) magnitudes.push_back(least);
    const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
    std::nth_element(magnitudes.begin(), middle, magnitudes.end());
    deviation[row] = (std::max)(least, Scalar(1.4826f) * *middle / sqrt(free_share));
  }
  return deviation;
}

}  // namespace splinertia::detail
