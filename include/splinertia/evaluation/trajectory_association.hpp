// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <ranges>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/message.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

namespace splinertia {

/// The pose T_WB at one time from two sources.
template <Pose G, TimePoint Time = std::chrono::nanoseconds>
struct PosePair {
  Time time;  ///< of the estimate
  G reference, estimate;
};

namespace detail {

/// Throws std::invalid_argument if there are no poses, if a pose is not finite, or if times do not increase.
template <StampedPoses Poses>
  requires Pose<GroupOf<std::ranges::range_value_t<Poses>>>
void check_poses(const Poses& poses, std::string_view name) {
  const auto count = std::ranges::ssize(poses);
  if (count == 0) refuse<std::invalid_argument>("associate: the ", name, " has no poses");
  const auto first = std::ranges::begin(poses);
  for (auto i = count - count; i < count; ++i) {
    const auto& time = first[i].time;
    const auto& pose = first[i].value;
    if (!all_finite(position(pose)) || !all_finite(rotation(pose).unit_quaternion().coeffs())) {
      refuse<std::invalid_argument>("associate: pose ", i, " of the ", name, " is not finite");
    }
    if (!is_finite(time) || (i > 0 && !(time > first[i - 1].time))) {
      refuse<std::invalid_argument>("associate: pose ", i, " of the ", name, " is at ", seconds_or_ticks(time),
                                    ", expected increasing times");
    }
  }
}

/// The pose nearest in time; of two at the same distance, the earlier one. Requires at least one pose.
template <StampedPoses Poses, TimePoint Time>
[[nodiscard]] const auto& nearest_pose(const Poses& poses, Time time) {
  const auto first = std::ranges::begin(poses);
  const auto end = first + std::ranges::ssize(poses);
  const auto after = std::lower_bound(first, end, time, [](const auto& stamped, Time t) { return stamped.time < t; });
  if (after == first) return *after;
  const auto before = after - 1;
  return after == end || time_between(before->time, time) <= time_between(time, after->time) ? *before : *after;
}

}  // namespace detail

/// Pairs two trajectories by time: each pose of the one with fewer poses (of the estimate, if both have as many) with
/// the nearest of the other, if that is at most `max_difference` seconds away. Poses without a partner are left out. A
/// pose of the longer trajectory is in several pairs if it is the nearest of several. Grupp's evo (nearest_time) does
/// the same on times rounded to double seconds. If epoch stamps differ by max_difference to within 2e-7 s, it may
/// therefore decide otherwise. Throws std::invalid_argument for what check_poses refuses, if max_difference is negative
/// or not finite, and if there are no pairs.
template <detail::StampedPoses Reference, detail::StampedPoses Estimate>
  requires std::same_as<std::ranges::range_value_t<Reference>, std::ranges::range_value_t<Estimate>>
[[nodiscard]] auto associate(const Reference& reference, const Estimate& estimate, double max_difference = 0.01) {
  using Value = std::ranges::range_value_t<Reference>;
  if (!(max_difference >= 0) || !detail::is_finite(max_difference)) {
    detail::refuse<std::invalid_argument>("associate: maximum difference ", max_difference, " s, expected >= 0 s");
  }
  detail::check_poses(reference, "reference");
  detail::check_poses(estimate, "estimate");

  std::vector<PosePair<decltype(Value::value), decltype(Value::time)>> pairs;
  const auto add = [&](const Value& r, const Value& e) {
    const double difference = std::abs(to_seconds<double>(detail::time_between(r.time, e.time)));
    if (difference <= max_difference) pairs.push_back({e.time, r.value, e.value});
  };
  if (std::ranges::size(estimate) > std::ranges::size(reference)) {
    for (const Value& pose : reference) add(pose, detail::nearest_pose(estimate, pose.time));
  } else {
    for (const Value& pose : estimate) add(detail::nearest_pose(reference, pose.time), pose);
  }
  if (pairs.empty()) {
    const auto span = [](const auto& poses) {
      return detail::message(detail::seconds_or_ticks(std::ranges::begin(poses)->time), " to ",
                             detail::seconds_or_ticks(std::ranges::begin(poses)[std::ranges::ssize(poses) - 1].time));
    };
    detail::refuse<std::invalid_argument>("associate: no pose of the estimate (", span(estimate), ") is within ",
                                          max_difference, " s of one of the reference (", span(reference), ")");
  }
  return pairs;
}

}  // namespace splinertia
