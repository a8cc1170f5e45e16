// SPDX-License-Identifier: MIT
// A type-erased trajectory: code that takes it, for instance a simulator, is compiled once for all trajectories.
#pragma once

#include <chrono>
#include <concepts>
#include <memory>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/motion/split_motion.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/time.hpp>
#include <utility>

/// Converts the motion of a rigid body on any pose group to one on SO(3) × R³.
template <int D, splinertia::Pose G>
[[nodiscard]] splinertia::Motion<splinertia::SO3xR3<double>, D> as_split_motion(const splinertia::Motion<G, D>& m) {
  if constexpr (splinertia::SplitPose<G>) {
    return m;
  } else {
    const Eigen::Vector3d nothing = Eigen::Vector3d::Zero();
    const Eigen::Quaterniond& q_WB = splinertia::rotation(m.value).unit_quaternion();
    splinertia::RigidBodyState<double> state{q_WB, splinertia::position(m.value), nothing, nothing, nothing, nothing};
    if constexpr (D >= 1) {
      state.omega = splinertia::angular_velocity(m);
      state.v_WB = splinertia::world_velocity(m);
    }
    if constexpr (D >= 2) {
      state.alpha = splinertia::angular_acceleration(m);
      state.a_WB = q_WB * splinertia::specific_force(m, nothing);  // R Rᵀ(p̈ − 0)
    }
    return splinertia::split_motion<D>(state);
  }
}

/// Holds a trajectory whose time is nanoseconds or seconds. Each evaluation is one virtual call.
class AnyTrajectory {
 public:
  using Group = splinertia::SO3xR3<double>;
  using Time = std::chrono::nanoseconds;

  /// Empty. Must not be evaluated.
  AnyTrajectory() = default;

  /// A curve from its start to its end.
  template <typename Curve>
    requires std::same_as<typename Curve::Time, Time>
  explicit AnyTrajectory(Curve curve)
      : start_(curve.start()), end_(curve.end()), motion_(std::make_shared<Held<Curve>>(std::move(curve))) {}

  /// A motion in seconds, which may have no bounds, from `start` to `end`.
  template <typename Curve>
    requires std::same_as<typename Curve::Time, double>
  AnyTrajectory(Curve curve, Time start, Time end)
      : start_(start), end_(end), motion_(std::make_shared<Held<Curve>>(std::move(curve))) {}

  [[nodiscard]] Time start() const { return start_; }
  [[nodiscard]] Time end() const { return end_; }

  template <int D>
    requires(0 <= D && D <= 2)
  [[nodiscard]] splinertia::Motion<Group, D> evaluate(Time t) const {
    splinertia::Motion<Group, D> motion;
    motion_->evaluate(t, motion);
    return motion;
  }

 private:
  struct Interface {
    virtual ~Interface() = default;
    virtual void evaluate(Time t, splinertia::Motion<Group, 0>& motion) const = 0;
    virtual void evaluate(Time t, splinertia::Motion<Group, 1>& motion) const = 0;
    virtual void evaluate(Time t, splinertia::Motion<Group, 2>& motion) const = 0;
  };

  template <typename Curve>
  struct Held final : Interface {
    Curve curve;

    explicit Held(Curve curve_) : curve(std::move(curve_)) {}
    void evaluate(Time t, splinertia::Motion<Group, 0>& motion) const override { motion = at<0>(t); }
    void evaluate(Time t, splinertia::Motion<Group, 1>& motion) const override { motion = at<1>(t); }
    void evaluate(Time t, splinertia::Motion<Group, 2>& motion) const override { motion = at<2>(t); }

    template <int D>
    splinertia::Motion<Group, D> at(Time t) const {
      if constexpr (std::same_as<typename Curve::Time, double>) {
        return as_split_motion(curve.template evaluate<D>(splinertia::to_seconds<double>(t)));
      } else {
        return as_split_motion(curve.template evaluate<D>(t));
      }
    }
  };

  Time start_{}, end_{};
  std::shared_ptr<const Interface> motion_;
};

static_assert(splinertia::Trajectory<AnyTrajectory, 0> && splinertia::Trajectory<AnyTrajectory, 2>);
