// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/strapdown/detail/sample_window.hpp>
#include <splinertia/strapdown/nav_state.hpp>
#include <splinertia/strapdown/schemes/integration_scheme.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>
#include <type_traits>

namespace splinertia {

/// Integrates the samples of an IMU one at a time, without heap, as in the loop of an estimator.
///
///   Integrator integrator(Midpoint{}, initial);    // or Integrator<Midpoint>(initial) for double
///   integrator.push(sample);
///   integrator.state();
///
/// Scheme is Euler, Midpoint, … for point samples, or one of coning_sculling.hpp for increments. Frame is InertialFrame
/// or RotatingFrame. With a scheme that looks ahead or advances by several samples, the state lags behind the last
/// sample until finish().
template <typename Scheme, typename Scalar = double, TimePoint Time = double, typename Frame = InertialFrame>
  requires IntegrationScheme<Scheme, Scalar, Time>
class Integrator {
 public:
  using State = NavState<Scalar, Time>;

  /// `gravity`: acceleration of free fall in the world, m/s². Throws std::invalid_argument unless it, the initial state
  /// and the frame are finite and the longest interval of `gaps` is > 0.
  explicit Integrator(const State& initial, const Eigen::Vector3<Scalar>& gravity = standard_gravity<Scalar>(),
                      const GapOptions<Scalar>& gaps = {}, const Frame& frame = {})
      : state_(initial), gravity_(gravity), window_(initial.time, gaps), frame_(frame) {
    detail::require_all_finite("integrate", "the initial attitude", initial.R_WB.unit_quaternion().coeffs());
    detail::require_all_finite("integrate", "the initial velocity", initial.v_WB);
    detail::require_all_finite("integrate", "the initial position", initial.p_WB);
    detail::require_all_finite("integrate", "gravity", gravity);
    if constexpr (requires { frame.rate; })
      detail::require_all_finite("integrate", "the angular rate of the world", frame.rate);
  }

  /// The same with the scheme as an argument, so that the type can be deduced.
  explicit Integrator(Scheme, const State& initial, const Eigen::Vector3<Scalar>& gravity = standard_gravity<Scalar>(),
                      const GapOptions<Scalar>& gaps = {}, const Frame& frame = {})
      : Integrator(initial, gravity, gaps, frame) {}

  /// Adds a sample, advances the state as far as the scheme can, and calls visit(state) after each step. Throws
  /// std::invalid_argument if the first point sample is not at the time of the initial state, for readings that are not
  /// finite or beyond largest_factor(), for a stamp that is not after the last one, and for a gap that is refused. Then
  /// nothing has changed.
  template <typename AnySample>
  SPLINERTIA_ALWAYS_INLINE void push(const AnySample& sample, const auto& visit) {
    if constexpr (detail::check_sample<Scheme, Scalar, Time, AnySample>()) window_.push(sample, step(visit));
  }
  template <typename AnySample>
  SPLINERTIA_ALWAYS_INLINE void push(const AnySample& sample) {
    push(sample, [](const State&) {});
  }

  /// Advances the state to the last sample; the scheme does without later samples. More samples may follow.
  void finish(const auto& visit) { window_.finish(step(visit)); }
  void finish() {
    finish([](const State&) {});
  }

  [[nodiscard]] const State& state() const { return state_; }
  /// The number of bridged gaps.
  [[nodiscard]] std::size_t gaps() const { return window_.gaps(); }

 private:
  [[nodiscard]] auto step(const auto& visit) {
    return [this, &visit](const auto& samples, std::size_t from, Time time) {
      const auto increment = detail::step_increment<Scheme, Scalar>(samples, from);
      state_ = detail::flattened<Scalar>([&] { return frame_.advance(state_, increment, gravity_, time); });
      visit(state_);
    };
  }

  State state_;
  Eigen::Vector3<Scalar> gravity_;
  detail::SampleWindow<Scheme, Scalar, Time> window_;
  [[no_unique_address]] Frame frame_;
};

template <typename Scheme, typename Scalar, TimePoint Time, typename Frame = InertialFrame>
Integrator(Scheme, const NavState<Scalar, Time>&, const Eigen::Vector3<std::type_identity_t<Scalar>>& = {},
           const GapOptions<std::type_identity_t<Scalar>>& = {},
           const Frame& = {}) -> Integrator<Scheme, Scalar, Time, Frame>;

}  // namespace splinertia
