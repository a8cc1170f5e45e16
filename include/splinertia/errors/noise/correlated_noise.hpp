// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/square_root.hpp>
#include <splinertia/errors/detail/correlation_factor.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// White noise whose axes are correlated, as where axes share electronics or are resolved from skewed sensors: adds
/// N_i/√interval · (L n)_i, n standard normal, L·Lᵀ the N×N matrix of correlation coefficients. Each axis alone is as in
/// WhiteNoise: N in unit/√Hz.
template <typename Scalar, int N>
struct CorrelatedNoise {
  static constexpr std::string_view name = "correlated noise";
  using Matrix = Eigen::Matrix<Scalar, N, N>;
  template <typename Normals>
  using State = Normals;

  PerAxis<Scalar, N> density;
  Matrix correlation;

  /// The matrix may be computed from a covariance S, S_ij/√(S_ii S_jj); its symmetric part with ones on the diagonal is
  /// used. Throws std::invalid_argument unless the densities and their third powers are finite and >= 0, and the matrix has,
  /// but for rounding, ones on its diagonal, is symmetric and has no negative eigenvalue.
  CorrelatedNoise(const PerAxis<Scalar, N>& density_, const Matrix& correlation_)
      : density(density_), correlation(correlation_) {
    detail::require_noise_factor("CorrelatedNoise", "density", density);
    detail::require_finite("CorrelatedNoise", "correlation", correlation);
    correlation = detail::correlation_part("CorrelatedNoise", correlation);
    factor_ = detail::correlation_factor("CorrelatedNoise", correlation);
  }

  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, N>& sample, auto& normals) const {
    const AxisVector<Scalar, N> n = normals.template draw<Scalar>();
    const Scalar per_root_second = Scalar(1) / detail::square_root(sample.interval);
    sample.value += (density.vector() * per_root_second).cwiseProduct(factor_.lazyProduct(n));
  }

  void describe(auto&& parameter) const {
    parameter("density", density, SensorUnit{0, true});
    parameter("correlation", correlation, "1");
  }

 private:
  Matrix factor_;
};

template <typename P, typename Matrix>
CorrelatedNoise(const P&,
                const Matrix&) -> CorrelatedNoise<detail::ScalarOfParameter<Matrix>,
                                                  detail::checked_size<static_cast<int>(Matrix::RowsAtCompileTime)>()>;

}  // namespace splinertia
