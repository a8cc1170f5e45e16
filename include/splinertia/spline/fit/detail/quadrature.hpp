// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <splinertia/detail/pi.hpp>
#include <splinertia/time.hpp>

namespace splinertia::detail {

/// Gauss–Legendre quadrature: nodes on [0, 1] and weights, exact to degree 2n − 1. `derivative` is the matrix that maps
/// the values of a polynomial of degree n − 1 at the nodes to its derivatives there.
template <typename Scalar, std::size_t n>
struct Quadrature {
  std::array<Scalar, n> node, weight;
  std::array<std::array<Scalar, n>, n> derivative;

  Quadrature() {
    using std::abs;
    using std::cos;
    for (std::size_t i = 0; i < n; ++i) {
      Scalar x = -cos(Scalar(pi_of<long double>()) * Scalar(4 * i + 3) / Scalar(4 * n + 2));
      Scalar slope(1);
      // Newton's method on the Legendre polynomial; from this start it converges quadratically at once.
      for (int iteration = 0; iteration < 8; ++iteration) {
        Scalar before(1), value = x;
        for (std::size_t m = 2; m <= n; ++m) {
          const Scalar next = (Scalar(2 * m - 1) * x * value - Scalar(m - 1) * before) / Scalar(m);
          before = value;
          value = next;
        }
        slope = Scalar(n) * (x * value - before) / (x * x - Scalar(1));
        x -= value / slope;
      }
      node[i] = (x + 1) / 2;
      weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    for (std::size_t i = 0; i < n; ++i) {
      derivative[i][i] = Scalar(0);
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        // The derivative of the Lagrange polynomial of node j at node i.
        derivative[i][i] += 1 / (node[i] - node[j]);
        Scalar product = 1 / (node[j] - node[i]);
        for (std::size_t l = 0; l < n; ++l) {
          if (l != i && l != j) product *= (node[i] - node[l]) / (node[j] - node[l]);
        }
        derivative[i][j] = product;
      }
    }
  }

  /// The derivatives at the nodes of the polynomial with these values at the nodes.
  [[nodiscard]] std::array<Scalar, n> differentiated(const std::array<Scalar, n>& values) const {
    std::array<Scalar, n> result{};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) result[i] += derivative[i][j] * values[j];
    }
    return result;
  }

  /// The polynomial with these values at the nodes, at x.
  [[nodiscard]] Scalar value_at(const Scalar& x, const std::array<Scalar, n>& values) const {
    Scalar sum(0);
    for (std::size_t j = 0; j < n; ++j) {
      Scalar product = values[j];
      for (std::size_t l = 0; l < n; ++l) {
        if (l != j) product *= (x - node[l]) / (node[j] - node[l]);
      }
      sum += product;
    }
    return sum;
  }
};

/// share · length; an integer Time is rounded towards zero.
template <TimePoint Time, typename Scalar>
[[nodiscard]] Time fraction_of(Time length, const Scalar& share) {
  if constexpr (std::floating_point<Time>) {
    return static_cast<Time>(share) * length;
  } else {
    return Time(static_cast<typename Time::rep>(share * static_cast<Scalar>(length.count())));
  }
}

}  // namespace splinertia::detail
