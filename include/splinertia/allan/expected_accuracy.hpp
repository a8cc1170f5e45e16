// SPDX-License-Identifier: MIT
/// How accurately a static log will determine white noise N and random walk K, before it is recorded.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/require.hpp>
#include <type_traits>

namespace splinertia::allan {

/// Relative standard errors. From 1/2 on, the coefficient can hardly be told from zero.
template <typename Scalar>
struct ExpectedAccuracy {
  Scalar N;
  Scalar K;
};

/// The Cramér–Rao bound, the smallest standard errors of any unbiased estimator. identify() attains it; straight lines
/// through an Allan plot do worse.
///
/// The sine transform of the differences of n samples of both noises has exactly independent coefficients
/// (DifferenceSpectrum) with powers λ_k = K²/rate + 4 N²·rate·sin²(πk/2n), k = 1 … n − 1. With w_k the share of N in
/// λ_k, the Fisher information of ln N and ln K is 2 Σ (w_k², w_k (1 − w_k); …, (1 − w_k)²). The sum is taken term by
/// term up to k = 128 and as an integral above. It is within 4e-6 of the exact one for any K/N and takes 6 µs for hours
/// at 200 Hz.
///
/// For x = K·duration/N >= 5 and N·rate/K >= 50 the errors are 1/√(2n) for N and √(2/(x − 2)) for K, within 1 %. The
/// well-known √(2/x) is the limit for large x. It is 23 % too low at x = 5 and 5 % at x = 22.
///
/// Requires rate [Hz], duration [s], N [u/√Hz] and K [u/s/√Hz] > 0, and 3 to 2⁶² samples; otherwise throws
/// std::invalid_argument. A result too large for the scalar is infinite. float is computed in double.
template <std::floating_point Scalar>
[[nodiscard]] ExpectedAccuracy<Scalar> expected_accuracy(Scalar rate, std::type_identity_t<Scalar> duration,
                                                         std::type_identity_t<Scalar> N,
                                                         std::type_identity_t<Scalar> K) {
  using Wide = detail::AtLeastDouble<Scalar>;
  constexpr const char* name = "expected_accuracy";
  splinertia::detail::require_positive(name, "rate", rate);
  splinertia::detail::require_positive(name, "duration", duration);
  splinertia::detail::require_positive(name, "N", N);
  splinertia::detail::require_positive(name, "K", K);
  const Wide n = std::round(Wide(duration) * Wide(rate));
  splinertia::detail::require(n >= Wide(3) && n <= Wide(std::int64_t{1} << 62), name, "duration", duration,
                              "3 to 2^62 samples");
  // λ ~ sin² + corner². The shares are scaled by 1/(1 + corner²) and corner²/(1 + corner²), so that neither vanishes
  // for any corner.
  constexpr Wide smallest = (std::numeric_limits<Wide>::min)(), largest = (std::numeric_limits<Wide>::max)();
  const Wide corner = std::clamp(Wide(K) / Wide(N) / Wide(rate) / 2, smallest, largest);
  const Wide larger = (std::max)(corner, Wide(1)), white_scale = 1 / (larger * larger),
             walk_scale = (corner / larger) * (corner / larger), scale = white_scale + walk_scale;
  const Wide per_sine = splinertia::detail::pi_of<Wide>() / (2 * n);
  Wide white = 0, both = 0, walk = 0;
  const auto add = [&](Wide k, Wide count) {
    const Wide sine = std::sin(k * per_sine), square = sine * sine;
    const Wide walk_share = scale / (square * white_scale + walk_scale), white_share = square * walk_share;
    white += count * white_share * white_share;
    both += count * white_share * walk_share;
    walk += count * walk_share * walk_share;
  };
  const Wide alone = (std::min)(n - 1, Wide(128));
  for (Wide k = 1; k <= alone; ++k) add(k, Wide(1));
  // Two-point Gauss quadrature on intervals that grow in proportion to k, as the scale of the integrand does.
  const Wide last = n - Wide(1) / 2, gauss = 1 / std::sqrt(Wide(3));
  for (Wide from = alone + Wide(1) / 2; from < last;) {
    const Wide to = (std::min)(last, from + from / 16), half = (to - from) / 2, middle = from + half;
    add(middle - half * gauss, half);
    add(middle + half * gauss, half);
    from = to;
  }
  return {static_cast<Scalar>(scale / white_scale / std::sqrt(2 * (white - both * (both / walk)))),
          static_cast<Scalar>(scale / walk_scale / std::sqrt(2 * (walk - both * (both / white))))};
}

/// The duration [s] for which K has this relative standard error, > 0; other parameters as above. At usual rates it is
/// (2 + 2/error²)·N/K: 2 hours for 30 % and 17 hours for 10 % of a gyroscope with N/K = 300 s. It may be the duration
/// of one log or the total of several (identify_pooled). Infinite if 3·2⁵⁹ samples do not suffice.
template <std::floating_point Scalar>
[[nodiscard]] Scalar duration_for_random_walk(Scalar rate, std::type_identity_t<Scalar> N,
                                              std::type_identity_t<Scalar> K,
                                              std::type_identity_t<Scalar> relative_error) {
  splinertia::detail::require_positive("duration_for_random_walk", "relative_error", relative_error);
  const auto too_short = [&](Scalar duration) { return expected_accuracy(rate, duration, N, K).K > relative_error; };
  Scalar below = 3 / rate, above = below;
  for (int doublings = 0; too_short(above); ++doublings) {
    if (doublings == 59) return std::numeric_limits<Scalar>::infinity();
    below = above;
    above *= 2;
  }
  for (int i = 0; i < 20; ++i) {
    const Scalar middle = below + (above - below) / 2;
    (too_short(middle) ? below : above) = middle;
  }
  return above;
}

}  // namespace splinertia::allan
