// SPDX-License-Identifier: MIT
/// Checks of parameters.
#pragma once

#include <algorithm>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <stdexcept>

namespace splinertia::detail {

/// Throws std::invalid_argument unless `good`. The message names the owner of the parameter (an error term, a
/// function), the parameter, its value and what was expected.
template <typename Scalar>
constexpr void require(bool good, const char* whose, const char* parameter, const Scalar& value, const char* expected) {
  if (!good) refuse<std::invalid_argument>(whose, ": ", parameter, " is ", value, ", expected ", expected);
}

template <typename Scalar>
constexpr void require_finite(const char* whose, const char* parameter, const Scalar& value) {
  require(is_finite(value), whose, parameter, value, "a finite number");
}

/// Checks each component of a vector.
template <typename Vector>
constexpr void require_all_finite(const char* whose, const char* parameter, const Vector& values) {
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    if (!is_finite(values[i])) {
      refuse<std::invalid_argument>(whose, ": ", parameter, '[', i, "] is ", values[i], ", expected a finite number");
    }
  }
}

template <typename Scalar>
constexpr void require_non_negative(const char* whose, const char* parameter, const Scalar& value) {
  require(is_finite(value) && value >= Scalar(0), whose, parameter, value, "a finite number >= 0");
}

template <typename Scalar>
constexpr void require_positive(const char* whose, const char* parameter, const Scalar& value) {
  require(is_finite(value) && value > Scalar(0), whose, parameter, value, "a finite number > 0");
}

/// A power of two: three numbers of at most this magnitude can be multiplied without overflow.
template <typename Scalar>
[[nodiscard]] constexpr Scalar largest_factor() {
  Scalar factor(1);
  for (int i = 0; i < (std::min)(std::numeric_limits<Scalar>::max_exponent, 1024) / 3; ++i) factor *= Scalar(2);
  return factor;
}

/// Checks a parameter that is multiplied with others and with a reading: its third power must not overflow.
template <typename Scalar>
constexpr void require_factor(const char* whose, const char* parameter, const Scalar& value) {
  require_finite(whose, parameter, value);
  constexpr auto most = largest_factor<Scalar>;
  require(-most() <= value && value <= most(), whose, parameter, value, "a number whose third power does not overflow");
}

/// Checks the density or the standard deviation of a noise, which is multiplied with random numbers and with intervals.
template <typename Scalar>
constexpr void require_noise_factor(const char* whose, const char* parameter, const Scalar& value) {
  require_non_negative(whose, parameter, value);
  require_factor(whose, parameter, value);
}

}  // namespace splinertia::detail
