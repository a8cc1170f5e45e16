// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ranges>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/time.hpp>
#include <type_traits>
#include <utility>

namespace splinertia {

/// A group element with a time stamp: one line of a trajectory. Time is `double` seconds or a std::chrono::duration.
template <LieGroup G, typename Time = std::chrono::nanoseconds>
struct Stamped {
  Time time;
  G value;
};

namespace detail {

/// Has a time and a value on a Lie group, as Stamped and what derives from it.
template <typename T>
concept StampedValue =
    WithTime<T> && requires(const T& t) { requires LieGroup<std::remove_cvref_t<decltype(t.value)>>; };

/// The group of that value.
template <StampedValue T>
using GroupOf = std::remove_cvref_t<decltype(std::declval<const T&>().value)>;

/// A trajectory: a random-access range of such elements, in order of time.
template <typename R>
concept StampedPoses = std::ranges::random_access_range<const R> && std::ranges::sized_range<const R> &&
                       StampedValue<std::ranges::range_value_t<R>>;

}  // namespace detail

}  // namespace splinertia
