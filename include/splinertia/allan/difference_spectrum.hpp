// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/detail/pi.hpp>
#include <unsupported/Eigen/FFT>
#include <utility>
#include <vector>

namespace splinertia::allan {

namespace detail {

/// The largest length ≤ n with no prime factor above 13, for a fast Fourier transform: it leaves out 0.1 % of a log on
/// average. n itself up to 1024.
[[nodiscard]] inline std::int64_t transform_length(std::int64_t n) {
  const auto quick = [](std::int64_t length) {
    for (const std::int64_t prime : {2, 3, 5, 7, 11, 13}) {
      while (length % prime == 0) length /= prime;
    }
    return length == 1;
  };
  while (n > 1024 && !quick(n)) --n;
  return n;
}

/// The orthonormal sine transform DST-I of n − 1 numbers d_1 … d_{n−1}: b_k = √(2/n) Σ_i d_i sin(πik/n). Computed by a
/// complex transform of length n of the odd continuation of d, with even and odd elements packed together. Error: below
/// 1e-15 of the norm of d, also in long double, because Eigen's factors are rounded to double.
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> sine_transform(const std::vector<Scalar>& d) {
  using Complex = std::complex<Scalar>;
  const std::size_t n = d.size() + 1;
  const auto odd = [&](std::size_t i) { return i == 0 || i == n ? Scalar(0) : i < n ? d[i - 1] : -d[2 * n - i - 1]; };
  std::vector<Complex> packed(n), transformed(n);
  for (std::size_t j = 0; j < n; ++j) packed[j] = {odd(2 * j), odd(2 * j + 1)};
  Eigen::FFT<Scalar>().fwd(transformed.data(), packed.data(), static_cast<Eigen::Index>(n));
  std::vector<Scalar> b(n - 1);
  const Scalar scale = 1 / std::sqrt(8 * static_cast<Scalar>(n));
  const Scalar per_sine = splinertia::detail::pi_of<Scalar>() / static_cast<Scalar>(n);
  for (std::size_t k = 1; k < n; ++k) {
    const Complex z = transformed[k], mirrored = std::conj(transformed[n - k]);
    const Complex even = z + mirrored, odd_times_i = z - mirrored;
    const Scalar angle = per_sine * static_cast<Scalar>(k);
    // Twice the transform of the odd sequence, which is −2i Σ d sin(…), is even − i e^(−i angle) odd_times_i.
    b[k - 1] = (std::cos(angle) * odd_times_i.real() + std::sin(angle) * odd_times_i.imag() - even.imag()) * scale;
  }
  return b;
}

}  // namespace detail

/// The sine transform b_k of a signal's differences y_{i+1} − y_i. For white noise and random walk the b_k are exactly
/// independent: the covariance of the differences is q·1 + r·tridiag(−1, 2, −1), whose eigenvectors are these sines.
/// b_k has the mean square Σ_term coefficient·basis_k(term). A ramp with slope c per sample adds the mean c·w_k.
///
/// Neighbouring b_k are combined in bins no wider than 1/64 of their frequency, within which the expected power is
/// nearly constant. The first 127 b_k stay alone.
template <typename Scalar>
class DifferenceSpectrum {
 public:
  /// N²·rate, K²/rate, B², Q²·rate², in the order of NoiseTerm.
  static constexpr std::size_t powers = 4;

  struct Bin {
    Scalar frequency;                  ///< centre, Hz
    Scalar count;                      ///< number of b_k
    Scalar power;                      ///< Σ b_k², in unit()²
    Scalar ramp_product, ramp_square;  ///< Σ b_k w_k and Σ w_k²
    Scalar odd_sum, even_sum;          ///< Σ b_k over odd and even k, in unit()
    Scalar odd_count;                  ///< number of b_k with odd k
    std::array<Scalar, powers> basis;  ///< means over the bin: 4s², 1, 2s, 16s⁴ with s = sin(πf/rate)
  };

  /// Time O(n log n), temporary memory 8n scalars.
  explicit DifferenceSpectrum(const IntegratedSignal<Scalar>& signal) : rate_(signal.rate()), unit_(signal.unit()) {
    const auto n = static_cast<std::size_t>(detail::transform_length(signal.samples()));
    samples_ = static_cast<std::int64_t>(n);
    std::vector<Scalar> differences(n - 1);
    const auto& x = signal.sums();
    for (std::size_t i = 0; i + 1 < n; ++i) differences[i] = (x[i + 2] - x[i + 1]) - (x[i + 1] - x[i]);
    const auto b = detail::sine_transform(differences);
    const Scalar per_sine = splinertia::detail::pi_of<Scalar>() / (2 * static_cast<Scalar>(n));
    const Scalar ramp_scale = std::sqrt(2 / static_cast<Scalar>(n));
    for (std::size_t k = 1; k < n;) {
      const std::size_t end = (std::min)(n, k + std::max<std::size_t>(1, k / 64));
      Bin bin{};
      bin.count = static_cast<Scalar>(end - k);
      bin.frequency = static_cast<Scalar>(k + end - 1) * rate_ / (4 * static_cast<Scalar>(n));
      for (; k < end; ++k) {
        const Scalar angle = per_sine * static_cast<Scalar>(k);
        const Scalar sine = std::sin(angle), chord = 2 * sine, b_k = b[k - 1];
        bin.power += b_k * b_k;
        if (k % 2 == 0) {
          bin.even_sum += b_k;
        } else {
          bin.odd_sum += b_k;
          bin.odd_count += 1;
          const Scalar w = ramp_scale * std::cos(angle) / sine;
          bin.ramp_product += b_k * w;
          bin.ramp_square += w * w;
        }
        bin.basis[0] += chord * chord;
        bin.basis[1] += 1;
        bin.basis[2] += chord;
        bin.basis[3] += chord * chord * chord * chord;
      }
      for (Scalar& mean : bin.basis) mean /= bin.count;
      bins_.push_back(bin);
    }
  }

  [[nodiscard]] const std::vector<Bin>& bins() const { return bins_; }
  [[nodiscard]] Scalar rate() const { return rate_; }              ///< Hz
  [[nodiscard]] Scalar unit() const { return unit_; }              ///< in the unit of the signal
  [[nodiscard]] std::int64_t samples() const { return samples_; }  ///< number of samples used: transform_length()

 private:
  Scalar rate_;
  Scalar unit_;
  std::int64_t samples_;
  std::vector<Bin> bins_;
};

}  // namespace splinertia::allan
