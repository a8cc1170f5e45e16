// SPDX-License-Identifier: MIT
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

namespace splinertia {

namespace detail {

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

}  // namespace detail

/// The poses converted to the group and the time type of Curve. Elements that have drifted off their group by up to
/// 0.001 (the norm of a quaternion) are normalised. Throws std::invalid_argument unless the poses are finite, on their
/// group and in strictly ascending order of time, and Time can represent the time that they span. The message names the
/// pose and the caller, `whose`.
template <typename Curve, detail::StampedPoses Poses>
[[nodiscard]] PosesOf<Curve> convert_poses(const Poses& poses, const char* whose) {
  using G = typename Curve::Group;
  using Time = typename Curve::Time;
  const auto fault = [&](std::size_t i, const auto&... text) {
    detail::refuse<std::invalid_argument>(whose, ": pose ", i, text...);
  };
  std::vector<Stamped<G, Time>> data;
  data.reserve(std::ranges::size(poses));
  for (const auto& pose : poses) {
    const std::size_t i = data.size();
    const Time time = detail::as_time<Time>(pose.time);
    if (!detail::is_finite(pose.time))
      fault(i, " is at time ", detail::seconds_or_ticks(pose.time), ", expected a finite number");
    if (i > 0 && !(time > data.back().time)) {
      fault(i, " is at time ", detail::seconds_or_ticks(time), ", expected a time after ",
            detail::seconds_or_ticks(data.back().time), ", that of the pose before it");
    }
    G value = detail::as_group<G>(pose.value);
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
      if (!detail::is_finite(coordinates[row])) fault(i, " is not finite");
    }
    data.push_back({time, value});
  }
  if (!data.empty()) detail::check_span(whose, "poses", data.front().time, data.back().time);
  return data;
}

}  // namespace splinertia
