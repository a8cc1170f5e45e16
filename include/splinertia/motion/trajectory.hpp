// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <splinertia/motion/motion.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

/// A curve on a Lie group that gives its value and its first D derivatives at any time from start() to end(), both
/// included. Every Spline is one, every analytic motion, and any type of yours with
///
///   using Group = …;                                    a LieGroup
///   using Time = …;                                     a TimePoint
///   Time start() const;  Time end() const;              −∞ and ∞ if the motion has no bounds
///   template <int D> Motion<Group, D> evaluate(Time t) const;
template <typename T, int D>
concept Trajectory =
    LieGroup<typename T::Group> && TimePoint<typename T::Time> && requires(const T& curve, typename T::Time t) {
      { curve.start() } -> std::convertible_to<typename T::Time>;
      { curve.end() } -> std::convertible_to<typename T::Time>;
      { curve.template evaluate<D>(t) } -> std::same_as<Motion<typename T::Group, D>>;
    };

}  // namespace splinertia
