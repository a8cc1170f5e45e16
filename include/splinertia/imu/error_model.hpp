// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <splinertia/imu/error_term.hpp>
#include <tuple>
#include <type_traits>
#include <utility>

namespace splinertia {

/// The error terms of one three-axis sensor, applied in the order written:
///
///   ErrorModel gyro{RandomWalk{5e-5}, WhiteNoise{0.015}};
///   ErrorModel ideal{};                                     // an empty type that does nothing
///
/// What is not named costs nothing. See error_term.hpp for terms of your own.
template <ErrorTerm... Terms>
class ErrorModel {
 public:
  /// What changes from sample to sample, for one sensor in one run.
  using State = std::tuple<typename Terms::State...>;

  constexpr ErrorModel(Terms... terms) : terms_(std::move(terms)...) {}

  /// The state before the first sample. Each term has random streams of its own under `sensor`, named by the term and
  /// by how many of the same name stand before it.
  [[nodiscard]] State start(StreamKey sensor) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) { return State{start_term<I>(sensor)...}; }(indices);
  }

  /// Puts all errors into a sample.
  template <typename Scalar>
  void apply(Sample<Scalar>& sample, State& state) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (std::get<I>(terms_).apply(sample, std::get<I>(state)), ...);
    }(indices);
  }

  [[nodiscard]] constexpr const std::tuple<Terms...>& terms() const { return terms_; }

 private:
  static constexpr auto indices = std::index_sequence_for<Terms...>{};

  template <std::size_t I>
  using Term = std::tuple_element_t<I, std::tuple<Terms...>>;

  template <typename Term>
  static constexpr bool draws = std::constructible_from<typename Term::State, StreamKey>;

  // How many terms before the I-th have its name.
  template <std::size_t I>
  static constexpr std::uint64_t occurrence() {
    return []<std::size_t... J>(std::index_sequence<J...>) {
      [[maybe_unused]] const auto same = []<std::size_t j>() {
        if constexpr (draws<Term<j>>) {
          return Term<j>::name == Term<I>::name;
        } else {
          return false;
        }
      };
      return (std::uint64_t{0} + ... + (same.template operator()<J>() ? 1U : 0U));
    }(std::make_index_sequence<I>{});
  }

  template <std::size_t I>
  static auto start_term(StreamKey sensor) {
    if constexpr (draws<Term<I>>) {
      return typename Term<I>::State(sensor / Term<I>::name / occurrence<I>());
    } else {
      return typename Term<I>::State{};
    }
  }

  [[no_unique_address]] std::tuple<Terms...> terms_;
};

static_assert(std::is_empty_v<ErrorModel<>>);

}  // namespace splinertia
