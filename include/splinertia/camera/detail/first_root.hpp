// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/bisect.hpp>

namespace splinertia::detail {

/// a[0] + a[1] x + … .
template <typename Scalar, std::size_t Size>
[[nodiscard]] inline Scalar polynomial_at(const std::array<Scalar, Size>& a, const Scalar& x) {
  Scalar sum = a[Size - 1];
  for (std::size_t i = Size - 1; i-- > 0;) sum = sum * x + a[i];
  return sum;
}

/// The positions in (0, end), ascending, where the polynomial changes sign. They lie between those of its derivative,
/// where it is monotone. A root at which it only touches zero is none.
template <typename Scalar, std::size_t Size>
[[nodiscard]] auto sign_changes(const std::array<Scalar, Size>& a, const Scalar& end) {
  struct Roots {
    std::array<Scalar, Size> x{};
    std::size_t count = 0;
  } roots;
  if constexpr (Size > 1) {
    std::array<Scalar, Size - 1> derivative;
    for (std::size_t i = 1; i < Size; ++i) derivative[i - 1] = Scalar(static_cast<int>(i)) * a[i];
    const auto f = [&](const Scalar& x) { return polynomial_at(a, x); };
    const auto turns = sign_changes(derivative, end);
    Scalar low(0);
    for (std::size_t i = 0; i <= turns.count; ++i) {
      const Scalar high = i < turns.count ? turns.x[i] : end;
      if ((f(low) > Scalar(0)) != (f(high) > Scalar(0))) roots.x[roots.count++] = bisect<Scalar>(f, low, high);
      low = high;
    }
  }
  return roots;
}

/// The first x in (0, end) at which the polynomial a, which is positive at 0, becomes negative. Nothing if there is none.
template <typename Scalar, std::size_t Size>
[[nodiscard]] std::optional<Scalar> first_root(const std::array<Scalar, Size>& a, const Scalar& end) {
  bool falls = false;
  for (const Scalar& coefficient : a) falls = falls || coefficient < Scalar(0);
  if (!falls) return std::nullopt;  // the usual case where nothing is to be searched
  const auto roots = sign_changes(a, end);
  if (roots.count == 0) return std::nullopt;
  return roots.x[0];
}

}  // namespace splinertia::detail
