// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <splinertia/detail/require.hpp>

namespace splinertia {

/// The cost of a residual of r standard deviations. Robust losses grow less than r² for outliers.
class RobustLoss {
 public:
  /// r²: least squares, no down-weighting of outliers.
  [[nodiscard]] static RobustLoss squares() { return {Kind::squares, 1}; }
  /// r² up to `limit` standard deviations, linear beyond: an outlier has the influence of a residual of `limit`. The
  /// default is 95 % efficient on normal noise. Huber, Ann. Math. Statist. 35 (1964) 73. Throws std::invalid_argument
  /// unless limit > 0 and finite.
  [[nodiscard]] static RobustLoss huber(double limit = 1.345) { return {Kind::huber, limit}; }
  /// limit²·log(1 + (r/limit)²): the influence of an outlier falls with its distance, so jumps hardly disturb the curve
  /// around them. The default is 95 % efficient on normal noise. Throws as huber() does.
  [[nodiscard]] static RobustLoss cauchy(double limit = 2.3849) { return {Kind::cauchy, limit}; }

  [[nodiscard]] bool is_squares() const { return kind_ == Kind::squares; }

  /// The cost of a residual with this square.
  template <typename Scalar>
  [[nodiscard]] Scalar cost(const Scalar& square) const {
    using std::log1p;
    using std::sqrt;
    const auto limit = static_cast<Scalar>(limit_);
    const Scalar limit_square = limit * limit;
    if (kind_ == Kind::huber && square > limit_square) return 2 * limit * sqrt(square) - limit_square;
    return kind_ == Kind::cauchy ? limit_square * log1p(square / limit_square) : square;
  }

  /// d cost/d square: the weight in iteratively reweighted least squares.
  template <typename Scalar>
  [[nodiscard]] Scalar weight(const Scalar& square) const {
    using std::sqrt;
    const auto limit = static_cast<Scalar>(limit_);
    const Scalar limit_square = limit * limit;
    if (kind_ == Kind::huber && square > limit_square) return limit / sqrt(square);
    return kind_ == Kind::cauchy ? limit_square / (limit_square + square) : Scalar(1);
  }

 private:
  enum class Kind { squares, huber, cauchy };

  RobustLoss(Kind kind, double limit) : kind_(kind), limit_(limit) {
    detail::require_positive("RobustLoss", "limit", limit);
  }

  Kind kind_;
  double limit_;
};

}  // namespace splinertia
