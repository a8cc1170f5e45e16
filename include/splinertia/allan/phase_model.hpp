// SPDX-License-Identifier: MIT
#pragma once

namespace splinertia::allan {

/// The model of the phase samples of power law noise, which matters for small m.
enum class PhaseModel {
  /// Discrete noise: rates are white, a random walk (sums of white noise), or fractional sums in between, and the phase
  /// is the sum of the rates. Exact for logs whose samples are integrals or means of white noise.
  sampled,
  /// As in Greenhall and Riley, and in Stable32: phase samples are means over τ₀ of a continuous phase, modified
  /// differences those of a continuous mean. Only correlations to lags of differences + 1 steps count. If these are
  /// more than 100 lags (their J_max, beyond which they use tables of the limit), or for m > 10⁴, `sampled` is used.
  /// Compared with `sampled`, white rates (Allan, overlapping) have 17 % more degrees at m = 1, 12 % fewer at m = 4 and
  /// 3 % fewer at m = 33; others differ by up to a third at m = 1 and 16 % above.
  greenhall_riley,
};

}  // namespace splinertia::allan
