// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

namespace splinertia {

/// What an error model belongs to, which decides its units.
enum class SensorKind { gyro, accel, clock };

// Declared only: this header serves descriptions without error terms, too.
template <typename... Terms>
class ErrorModel;

namespace detail {

/// Whether a term, or all terms of a model, can be those of such a sensor. A term for one kind of sensor only has a
/// `static constexpr SensorKind sensor`.
template <typename Errors, SensorKind kind>
inline constexpr bool is_for = true;
template <typename Term, SensorKind kind>
  requires requires { requires std::same_as<decltype(Term::sensor), const SensorKind>; }
inline constexpr bool is_for<Term, kind> = Term::sensor == kind;
template <typename... Terms, SensorKind kind>
inline constexpr bool is_for<ErrorModel<Terms...>, kind> = (is_for<Terms, kind> && ...);

}  // namespace detail

}  // namespace splinertia
