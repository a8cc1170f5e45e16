// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia::detail {

/// The pose at `time`, interpolated between its neighbours: x₀ exp((time − t₀)/(t₁ − t₀) · log(x₀⁻¹ x₁)). Before all
/// poses it is the first, after them the last. The search starts at index `from`, which is set to where it ends: calls
/// must be in ascending order of time, and then take constant time each.
template <LieGroup G, typename Time>
[[nodiscard]] G pose_between(const std::vector<Stamped<G, Time>>& poses, Time time, std::size_t& from) {
  using Scalar = ScalarOf<G>;
  if (time <= poses.front().time) return poses.front().value;
  if (time >= poses.back().time) return poses.back().value;
  while (poses[from + 1].time <= time) ++from;
  const auto& [t0, x0] = poses[from];
  const auto& [t1, x1] = poses[from + 1];
  const Scalar share = to_seconds<Scalar>(time - t0) / to_seconds<Scalar>(t1 - t0);
  return GroupTraits<G>::compose(x0, GroupTraits<G>::exp(share * increment<G>(x0, x1)));
}

}  // namespace splinertia::detail
