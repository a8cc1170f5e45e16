// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/error_term.hpp>
#include <tuple>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

/// Whether there is a function check_together(a, b). It throws std::invalid_argument if the two terms are incompatible.
template <typename A, typename B>
inline constexpr bool are_checked_together = requires(const A& a, const B& b) { check_together(a, b); };

}  // namespace detail

/// The error terms of one sensor, applied in the order written:
///
///   ErrorModel gyro{RandomWalk{5e-5}, WhiteNoise{0.015}};
///   ErrorModel ideal{};                                     // an empty type that does nothing
///
/// An ErrorModel can also hold the errors of a clock's time stamps:
/// ErrorModel stamps{ClockOffset{0.003}, DroppedSamples{0.01}}. Terms that are not in the model cost nothing. A model
/// serves sensors of any number of axes, unless a parameter has one value for each axis. simulate() and ImuErrors apply
/// it to an IMU, SensorErrors to any other sensor. See error_term.hpp for terms of your own. The constructor calls
/// check_together(a, b) or check_together(b, a), if there is one, to reject incompatible terms.
template <typename... Terms>
class ErrorModel {
  static_assert((detail::check_error_term<Terms>() && ...));
  static_assert(
      (SensorTerm<Terms> && ...) || (ClockTerm<Terms> && ...) || !(ErrorTerm<Terms> && ...),
      "an ErrorModel holds the terms of either a sensor or a clock: errors of time stamps (ClockOffset, StampJitter, "
      "…) need a model of their own, Imu{gyro, accel, stamps}");

 public:
  /// What changes from sample to sample, for one sensor of so many axes (a clock has 1) in one run.
  template <BitGenerator Generator = Xoshiro256, int Axes = 3>
  using State = std::tuple<StateOf<Terms, Axes, Generator>...>;

  /// Throws std::invalid_argument for incompatible terms.
  constexpr ErrorModel(Terms... terms) : terms_(std::move(terms)...) {
    if constexpr ((are_any_checked_with<Terms> || ...)) check_all(indices);
  }

  /// The state before the first sample. Each term has its own random streams under the key `sensor`, named by the term
  /// and by the number of terms of the same name before it.
  template <int Axes = 3, BitGenerator Generator = Xoshiro256>
  [[nodiscard]] State<Generator, Axes> start(StreamKey sensor) const {
    return [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      return State<Generator, Axes>{start_term<Index, Axes, Generator>(sensor)...};
    }(indices);
  }

  /// Applies all terms, in their order, to a sample (a SensorSample or a Stamp).
  template <typename AnySample, typename AnyState>
    requires(detail::AppliesTo<Terms, AnySample&, StateOf<Terms, AnySample::axes>> && ...)
  SPLINERTIA_ALWAYS_INLINE void apply(AnySample& sample, AnyState& state) const {
    apply_all(sample, state, indices);
  }

  [[nodiscard]] constexpr const std::tuple<Terms...>& terms() const { return terms_; }

  /// This model followed by more terms.
  template <typename... More>
  [[nodiscard]] constexpr ErrorModel<Terms..., More...> with(const More&... more) const {
    return std::apply([&](const auto&... term) { return ErrorModel<Terms..., More...>(term..., more...); }, terms_);
  }

 private:
  static constexpr auto indices = std::index_sequence_for<Terms...>{};

  template <std::size_t Index>
  using Term = std::tuple_element_t<Index, std::tuple<Terms...>>;

  template <std::size_t... Index>
  SPLINERTIA_ALWAYS_INLINE void apply_all(auto& sample, auto& state, std::index_sequence<Index...>) const {
    (std::get<Index>(terms_).apply(sample, std::get<Index>(state)), ...);
  }

  // are_checked_together is one variable for each pair of types: compilers reuse it from model to model.
  template <typename T>
  static constexpr bool are_any_checked_with = (detail::are_checked_together<T, Terms> || ...);

  template <std::size_t... Index>
  constexpr void check_all(std::index_sequence<Index...>) const {
    (check_beside<Index>(indices), ...);
  }
  template <std::size_t Index, std::size_t... J>
  constexpr void check_beside(std::index_sequence<J...>) const {
    (check_pair<Index, J>(), ...);
  }
  template <std::size_t Index, std::size_t J>
  constexpr void check_pair() const {
    if constexpr (Index != J && detail::are_checked_together<Term<Index>, Term<J>>) {
      check_together(std::get<Index>(terms_), std::get<J>(terms_));
    }
  }

  // The number of terms before the I-th that have its name.
  template <std::size_t Index>
  static constexpr std::uint64_t occurrence() {
    return []<std::size_t... J>(std::index_sequence<J...>) {
      [[maybe_unused]] const auto same = []<std::size_t j>() {
        if constexpr (StochasticTerm<Term<j>>) {
          return Term<j>::name == Term<Index>::name;
        } else {
          return false;
        }
      };
      return (std::uint64_t{0} + ... + (same.template operator()<J>() ? 1U : 0U));
    }(std::make_index_sequence<Index>{});
  }

  template <std::size_t Index, int Axes, typename Generator>
  static auto start_term(StreamKey sensor) {
    if constexpr (StochasticTerm<Term<Index>>) {
      return StateOf<Term<Index>, Axes, Generator>(sensor / Term<Index>::name / occurrence<Index>());
    } else {
      return StateOf<Term<Index>, Axes, Generator>{};
    }
  }

  [[no_unique_address]] std::tuple<Terms...> terms_;
};

static_assert(std::is_empty_v<ErrorModel<>>);

namespace detail {

/// The state of a model before the first sample of a run.
template <typename Model, int Axes = 3, BitGenerator Generator = Xoshiro256>
using StateOfModel = decltype(std::declval<const Model&>().template start<Axes, Generator>(std::declval<StreamKey>()));

/// The errors of a sensor, or of its clock: an ErrorModel, or a type of your own with start() and apply().
template <typename Model>
concept SensorModel = AppliesToSensor<Model, StateOfModel<Model>>;
template <typename Model>
concept ClockModel = AppliesToClock<Model, StateOfModel<Model, Stamp<double>::axes>>;

}  // namespace detail

}  // namespace splinertia
