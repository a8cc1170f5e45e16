// SPDX-License-Identifier: MIT
/// Polynomials through the four samples of a window, for schemes of order 4 on stamps of any kind.
///
/// A polynomial through close samples amplifies their noise: two samples ε apart have a slope with an error of σ/ε. So
/// the weights of a step may differ from those of the straight line between two samples by a stated amount at most:
/// where those of the cubic do not, the parabola takes its place, and where those of the parabola do not, the line.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/strapdown/scheme.hpp>

namespace splinertia::detail {

/// What is wanted of a polynomial (an integral, a moment, a value), as that of 1, s, s² and s³.
template <typename Scalar>
using Functional = std::array<Scalar, 4>;

/// Which of the four samples a polynomial goes through: `Count` of them from `first` on.
template <std::size_t Count>
struct Nodes {
  std::size_t first;
};

/// The times of a window from sample `from` on, s.
template <typename Scalar, typename Window>
[[nodiscard]] std::array<Scalar, 4> times_from(const Window& window, std::size_t from) {
  std::array<Scalar, 4> times;
  for (std::size_t j = 0; j < 4; ++j) times[j] = to_seconds<Scalar>(window[j].time - window[from].time);
  return times;
}

/// The same from the middle of an interval of h that begins with sample `from`, in units of h.
template <typename Scalar>
[[nodiscard]] std::array<Scalar, 4> centred(std::array<Scalar, 4> times, std::size_t from, const Scalar& h) {
  const Scalar begin = times[from];
  for (Scalar& t : times) t = (t - begin) / h - Scalar(1) / Scalar(2);
  return times;
}

/// The weights w with Σ w_j f(s_j) = `functional` of the polynomial through the samples of `nodes` (Lagrange).
template <typename Scalar, std::size_t Count>
[[nodiscard]] std::array<Scalar, 4> lagrange_weights(const std::array<Scalar, 4>& s, Nodes<Count> nodes,
                                                     const Functional<Scalar>& functional) {
  std::array<Scalar, 4> weights;
  weights.fill(Scalar(0));
  const auto at = [&](std::size_t j) -> const Scalar& { return s[nodes.first + j % Count]; };
  for (std::size_t j = 0; j < Count; ++j) {
    const Scalar& own = at(j);
    const Scalar& a = at(j + 1);
    Scalar value = functional[1] - a * functional[0], scale = own - a;
    if constexpr (Count > 2) {
      const Scalar& b = at(j + 2);
      value = functional[2] - (a + b) * functional[1] + a * b * functional[0];
      scale *= own - b;
      if constexpr (Count > 3) {
        const Scalar& c = at(j + 3);
        value = functional[3] - (a + b + c) * functional[2] + (a * b + b * c + c * a) * functional[1] -
                a * b * c * functional[0];
        scale *= own - c;
      }
    }
    weights[nodes.first + j] = value / scale;
  }
  return weights;
}

/// Calls take(nodes, weights) with the polynomial of highest degree whose weights differ from those of the line by at
/// most `limit` in sum, and returns what that returns: the cubic, the parabola on `parabola`, or the line on `line`.
template <typename Scalar>
[[nodiscard]] auto with_stable_weights(const std::array<Scalar, 4>& s, Nodes<2> line, Nodes<3> parabola,
                                       const Functional<Scalar>& functional, const Scalar& limit, const auto& take) {
  const auto of_line = lagrange_weights(s, line, functional);
  const auto stable = [&](const std::array<Scalar, 4>& weights) {
    using std::abs;
    Scalar difference(0);
    for (std::size_t j = 0; j < 4; ++j) difference += abs(weights[j] - of_line[j]);
    return difference <= limit;  // not for samples at the same time, where it is NaN
  };
  const auto of_cubic = lagrange_weights(s, Nodes<4>{0}, functional);
  if (stable(of_cubic)) [[likely]]
    return take(Nodes<4>{0}, of_cubic);
  const auto of_parabola = lagrange_weights(s, parabola, functional);
  if (stable(of_parabola)) return take(parabola, of_parabola);
  return take(line, of_line);
}

}  // namespace splinertia::detail
