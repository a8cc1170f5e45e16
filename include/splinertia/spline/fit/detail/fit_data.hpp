// SPDX-License-Identifier: MIT
/// Converts stamped poses to the group and the time type of a curve.
#pragma once

#include <concepts>
#include <cstddef>
#include <ranges>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/group/known_groups.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia::detail {

/// `pose` converted to the group G: itself, or the same three-dimensional pose.
template <LieGroup G, LieGroup From>
[[nodiscard]] G as_group(const From& pose) {
  if constexpr (std::same_as<G, From>) {
    return pose;
  } else {
    static_assert(Pose<G> && Pose<From>, "the group of the poses differs from that of the curve");
    return make_pose<G>(rotation(pose), position(pose));
  }
}

/// The poses converted to the group and the time type of Curve. Elements that have drifted off their group by up to
/// 0.001 (the norm of a quaternion) are normalised. Throws std::invalid_argument unless the poses are finite, on their
/// group and in strictly ascending order of time, and Time can represent the time that they span. The message names the
/// pose and the caller, `whose`.
template <typename Curve, StampedPoses Poses>
[[nodiscard]] PosesOf<Curve> fit_data(const Poses& poses, const char* whose) {
  using G = typename Curve::Group;
  using Time = typename Curve::Time;
  const auto fault = [&](std::size_t i, const auto&... text) {
    refuse<std::invalid_argument>(whose, ": pose ", i, text...);
  };
  std::vector<Stamped<G, Time>> data;
  data.reserve(std::ranges::size(poses));
  for (const auto& pose : poses) {
    const std::size_t i = data.size();
    const Time time = as_time<Time>(pose.time);
    if (!is_finite(pose.time)) fault(i, " is at time ", seconds_or_ticks(pose.time), ", expected a finite number");
    if (i > 0 && !(time > data.back().time)) {
      fault(i, " is at time ", seconds_or_ticks(time), ", expected a time after ", seconds_or_ticks(data.back().time),
            ", that of the pose before it");
    }
    G value = as_group<G>(pose.value);
    if constexpr (requires { GroupTraits<G>::normalized(value); }) {
      using Scalar = ScalarOf<G>;
      const Scalar drift = GroupTraits<G>::drift(value), tolerance = Scalar(1) / Scalar(1000);
      if (!(drift <= tolerance)) {
        fault(i, " is off its group by ", drift, ", expected at most ", tolerance, " (the norm of a rotation is 1)");
      }
      value = GroupTraits<G>::normalized(value);
    }
    const Tangent<G> coordinates = GroupTraits<G>::log(value);
    for (int row = 0; row < coordinates.size(); ++row) {
      if (!is_finite(coordinates[row])) fault(i, " is not finite");
    }
    data.push_back({time, value});
  }
  if (!data.empty()) check_span(whose, "poses", data.front().time, data.back().time);
  return data;
}

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
