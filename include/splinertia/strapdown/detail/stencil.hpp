// SPDX-License-Identifier: MIT
/// Polynomials through the four samples of a window, for schemes of order 4 on irregular stamps.
///
/// A polynomial through close samples amplifies their noise: the slope between two samples ε apart has an error of σ/ε.
/// Therefore the weights of a step may differ from those of the straight line between two samples by a given limit at
/// most. If those of the cubic differ by more, the parabola is used; if those of the parabola do, too, the line is.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/detail/inline.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>
#include <tuple>

namespace splinertia::detail {

/// The samples that a polynomial goes through: `Count` of the four, from `first` on.
template <std::size_t Count>
struct Nodes {
  std::size_t first;
};

/// The times of a window relative to sample `from`, s.
template <typename Scalar, typename Window>
[[nodiscard]] std::array<Scalar, 4> times_from(const Window& window, std::size_t from) {
  std::array<Scalar, 4> times;
  for (std::size_t j = 0; j < 4; ++j) times[j] = to_seconds<Scalar>(window[j].time - window[from].time);
  return times;
}

/// The times relative to the middle of the interval of length h that begins with sample `from`, in units of h.
template <typename Scalar>
[[nodiscard]] std::array<Scalar, 4> centred(std::array<Scalar, 4> times, std::size_t from, const Scalar& h) {
  const Scalar begin = times[from];
  for (Scalar& t : times) t = (t - begin) / h - Scalar(1) / Scalar(2);
  return times;
}

/// The weights of the four samples for each of several functionals of a polynomial: an integral, a moment, a value.
template <typename Scalar, std::size_t Wanted>
using StencilWeights = std::array<std::array<Scalar, 4>, Wanted>;

/// The weights w with Σ w_j f(s_j) = functional(c) for the polynomial c₀ + c₁s + c₂s² + c₃s³ through the samples of
/// `nodes` (Lagrange). `functional` is linear in c and returns an array, which gets one set of weights per element.
template <std::size_t Count, typename Scalar>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline auto lagrange_weights(const std::array<Scalar, 4>& s, Nodes<Count> nodes,
                                                                    const auto& functional) {
  using Coefficients = std::array<Scalar, 4>;
  constexpr std::size_t wanted = std::tuple_size_v<decltype(functional(Coefficients{}))>;
  const Scalar zero(0), one(1);
  StencilWeights<Scalar, wanted> weights;
  for (auto& of_one : weights) of_one = {zero, zero, zero, zero};
  const auto at = [&](std::size_t j) -> const Scalar& { return s[nodes.first + j % Count]; };
  for (std::size_t j = 0; j < Count; ++j) {
    const Scalar& own = at(j);
    const Scalar& a = at(j + 1);
    Coefficients c;
    Scalar scale = own - a;
    if constexpr (Count == 2) {
      c = {-a, one, zero, zero};
    } else if constexpr (Count == 3) {
      const Scalar& b = at(j + 2);
      scale *= own - b;
      c = {a * b, -(a + b), one, zero};
    } else {
      const Scalar &b = at(j + 2), &d = at(j + 3);
      scale *= (own - b) * (own - d);
      c = {-(a * b * d), a * b + b * d + d * a, -(a + b + d), one};
    }
    const auto values = functional(c);
    for (std::size_t k = 0; k < wanted; ++k) weights[k][nodes.first + j] = values[k] / scale;
  }
  return weights;
}

/// The weights of the cubic, of the parabola on `parabola` or of the line on `line`: the highest degree for which
/// Σ_j |w_j − w_j of the line| ≤ `limit`, where w are the weights for the functional's first element.
template <typename Scalar>
[[nodiscard]] auto stable_weights(const std::array<Scalar, 4>& s, Nodes<2> line, Nodes<3> parabola,
                                  const auto& functional, const Scalar& limit) {
  const auto of_line = lagrange_weights(s, line, functional);
  const auto stable = [&](const auto& weights) {
    using std::abs;
    Scalar difference(0);
    for (std::size_t j = 0; j < 4; ++j) difference += abs(weights[0][j] - of_line[0][j]);
    return difference <= limit;  // false for samples at the same time, where it is NaN
  };
  const auto of_cubic = lagrange_weights(s, Nodes<4>{0}, functional);
  if (stable(of_cubic)) [[likely]]
    return of_cubic;
  const auto of_parabola = lagrange_weights(s, parabola, functional);
  return stable(of_parabola) ? of_parabola : of_line;
}

}  // namespace splinertia::detail
