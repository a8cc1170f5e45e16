// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/group/pose.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia {

/// A transform from one world to another, an element of Sim(3): p ↦ scale R p + t for positions, R_WB ↦ R R_WB for
/// attitudes.
template <typename Scalar>
struct SimilarityTransform {
  Sophus::SO3<Scalar> rotation{};
  Eigen::Vector3<Scalar> translation = Eigen::Vector3<Scalar>::Zero();  ///< m
  Scalar scale = Scalar(1);

  [[nodiscard]] Eigen::Vector3<Scalar> operator()(const Eigen::Vector3<Scalar>& p) const {
    return detail::rotate<Scalar>(rotation.unit_quaternion(), p * scale) + translation;
  }
  template <Pose G>
    requires std::same_as<ScalarOf<G>, Scalar>
  [[nodiscard]] G operator()(const G& pose) const {
    using SO3 = GroupTraits<Sophus::SO3<Scalar>>;
    return make_pose<G>(SO3::compose(rotation, splinertia::rotation(pose)), (*this)(position(pose)));
  }
};

namespace detail {

/// The mean of the columns, computed from their differences from the first: far from the origin a plain sum would lose
/// digits.
template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> centroid(const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& points) {
  return points.col(0) + (points.colwise() - points.col(0)).rowwise().mean();
}

/// The transform from the points x_i to the points y_i (columns, m) that minimises Σ |y_i − (c R x_i + t)|², with c = 1
/// unless `with_scale`:
///   R = U S Vᵀ,  c = tr(D S)/σ_x²,  t = ȳ − c R x̄
/// with the singular value decomposition U D Vᵀ of the covariance of y and x, and S = diag(1, 1, sign(det U det V)).
/// Umeyama, "Least-squares estimation of transformation parameters between two point patterns", PAMI 13 (1991),
/// (34)-(43). Throws std::invalid_argument if the points do not determine R: fewer than three, on one line, not finite.
template <typename Scalar>
[[nodiscard]] SimilarityTransform<Scalar> fit_similarity(const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& from,
                                                         const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& to,
                                                         bool with_scale) {
  if (from.cols() != to.cols() || from.cols() < 3) {
    refuse<std::invalid_argument>("fit_similarity: ", from.cols(), " and ", to.cols(),
                                  " points, expected the same number of both, and at least 3");
  }
  using std::sqrt;
  const Scalar count = static_cast<Scalar>(from.cols());
  const Eigen::Vector3<Scalar> mean_x = centroid<Scalar>(from), mean_y = centroid<Scalar>(to);
  const Eigen::Matrix<Scalar, 3, Eigen::Dynamic> x = from.colwise() - mean_x, y = to.colwise() - mean_y;
  const Scalar variance_x = x.squaredNorm() / count, variance_y = y.squaredNorm() / count;
  const Eigen::Matrix3<Scalar> covariance = y * x.transpose() / count;
  if (!is_finite(variance_x) || !is_finite(variance_y)) {
    refuse<std::invalid_argument>("fit_similarity: the points, or their squares, are not finite");
  }

  const Eigen::JacobiSVD<Eigen::Matrix3<Scalar>> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3<Scalar> d = svd.singularValues();
  const bool mirrored = svd.matrixU().determinant() * svd.matrixV().determinant() < Scalar(0);
  const Eigen::Vector3<Scalar> s(Scalar(1), Scalar(1), mirrored ? Scalar(-1) : Scalar(1));
  // The minimum is unique if d₂ + s d₃ > 0. The rounding error of this sum is that of the points times their spread.
  const Scalar rounding = std::numeric_limits<Scalar>::epsilon() *
                          (from.cwiseAbs().maxCoeff() * sqrt(variance_y) + to.cwiseAbs().maxCoeff() * sqrt(variance_x));
  if (!(d[1] + s[2] * d[2] > Scalar(16) * rounding)) {
    refuse<std::invalid_argument>("fit_similarity: ", from.cols(),
                                  " points do not determine a rotation, expected points that are not all on one line "
                                  "(singular values of the covariance: ",
                                  d[0], ' ', d[1], ' ', d[2], " m^2)");
  }
  const Eigen::Quaternion<Scalar> q(Eigen::Matrix3<Scalar>(svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose()));
  SimilarityTransform<Scalar> result;
  result.rotation = rotation_from_unit_quaternion<Scalar>(q.normalized());
  if (with_scale) result.scale = d.dot(s) / variance_x;
  result.translation = mean_y - result(mean_x);
  return result;
}

/// The rotation about z by the angle whose sine and cosine are proportional to these. Requires that not both are 0.
template <typename Scalar>
[[nodiscard]] Sophus::SO3<Scalar> rotation_about_z(const Scalar& sine, const Scalar& cosine) {
  using std::atan2;
  return GroupTraits<Sophus::SO3<Scalar>>::exp({Scalar(0), Scalar(0), atan2(sine, cosine)});
}

/// The rotation about the z axis (against gravity) and the translation from the points x_i to the points y_i that
/// minimise Σ |y_i − (R_z(ψ) x_i + t)|². These are what a visual-inertial estimator cannot observe.
///   ψ = atan2(C_yx − C_xy, C_xx + C_yy),  t = ȳ − R_z x̄,  C = Σ (y_i − ȳ)(x_i − x̄)ᵀ
/// Zhang and Scaramuzza, "A tutorial on quantitative trajectory evaluation for visual(-inertial) odometry", IROS 2018,
/// section III. Throws std::invalid_argument if the points do not determine ψ: fewer than two, all on one vertical
/// line, not finite.
template <typename Scalar>
[[nodiscard]] SimilarityTransform<Scalar> fit_yaw(const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& from,
                                                  const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& to) {
  if (from.cols() != to.cols() || from.cols() < 2) {
    refuse<std::invalid_argument>("fit_yaw: ", from.cols(), " and ", to.cols(),
                                  " points, expected the same number of both, and at least 2");
  }
  using std::hypot;
  const Eigen::Vector3<Scalar> mean_x = centroid<Scalar>(from), mean_y = centroid<Scalar>(to);
  const Eigen::Matrix<Scalar, 2, Eigen::Dynamic> x = (from.colwise() - mean_x).template topRows<2>();
  const Eigen::Matrix<Scalar, 2, Eigen::Dynamic> y = (to.colwise() - mean_y).template topRows<2>();
  const Eigen::Matrix<Scalar, 2, 2> c = y * x.transpose();
  const Scalar sine = c(1, 0) - c(0, 1), cosine = c(0, 0) + c(1, 1), size = hypot(sine, cosine);
  if (!is_finite(size)) refuse<std::invalid_argument>("fit_yaw: the points, or their squares, are not finite");
  const Scalar rounding = std::numeric_limits<Scalar>::epsilon() *
                          (from.cwiseAbs().maxCoeff() * y.norm() + to.cwiseAbs().maxCoeff() * x.norm());
  if (!(size > Scalar(16) * rounding)) {
    refuse<std::invalid_argument>("fit_yaw: ", from.cols(),
                                  " points do not determine a rotation about z, expected points that are not "
                                  "all on one vertical line");
  }
  SimilarityTransform<Scalar> result;
  result.rotation = rotation_about_z(sine, cosine);
  result.translation = mean_y - result(mean_x);
  return result;
}

}  // namespace detail

/// What is estimated of the transform from the estimate's world to the reference's:
///   none    nothing
///   origin  rotation and translation, from the first pair of poses
///   yaw     rotation about z and translation, from all positions; of a single pair, the rotation from its attitudes
///   se3     rotation and translation, from all positions (Umeyama)
///   sim3    rotation, translation and scale, from all positions (Umeyama)
enum class Alignment { none, origin, yaw, se3, sim3 };

/// The transform from the world of the estimate to that of the reference, from the first `count` pairs, or from all if
/// there are fewer. Throws std::invalid_argument if there are no pairs, if a single pair does not determine the yaw,
/// and as fit_similarity() and fit_yaw() do.
template <Pose G, TimePoint Time>
[[nodiscard]] SimilarityTransform<ScalarOf<G>> alignment(
    const std::vector<PosePair<G, Time>>& pairs, Alignment kind,
    std::size_t count = (std::numeric_limits<std::size_t>::max)()) {
  using Scalar = ScalarOf<G>;
  using SO3 = GroupTraits<Sophus::SO3<Scalar>>;
  count = (std::min)(count, pairs.size());
  if (count == 0) detail::refuse<std::invalid_argument>("alignment: no pairs of poses");
  SimilarityTransform<Scalar> result;
  if (kind == Alignment::none) return result;
  if (kind == Alignment::origin || (kind == Alignment::yaw && count == 1)) {
    const auto& [time, reference, estimate] = pairs.front();
    result.rotation = SO3::compose(rotation(reference), SO3::inverse(rotation(estimate)));
    if (kind == Alignment::yaw) {
      // The nearest rotation about z has a quaternion with the same ratio of z to w.
      const auto& q = result.rotation.unit_quaternion();
      if (q.w() == Scalar(0) && q.z() == Scalar(0)) {
        detail::refuse<std::invalid_argument>(
            "alignment: the first pair of attitudes does not determine a rotation about z");
      }
      result.rotation = detail::rotation_about_z(Scalar(2) * q.w() * q.z(), q.w() * q.w() - q.z() * q.z());
    }
    result.translation = position(reference) - result(position(estimate));
    return result;
  }
  const auto columns = static_cast<Eigen::Index>(count);
  Eigen::Matrix<Scalar, 3, Eigen::Dynamic> from(3, columns), to(3, columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    from.col(i) = position(pairs[static_cast<std::size_t>(i)].estimate);
    to.col(i) = position(pairs[static_cast<std::size_t>(i)].reference);
  }
  if (kind == Alignment::yaw) return detail::fit_yaw<Scalar>(from, to);
  return detail::fit_similarity<Scalar>(from, to, kind == Alignment::sim3);
}

/// The pairs with the estimate transformed.
template <Pose G, TimePoint Time>
[[nodiscard]] std::vector<PosePair<G, Time>> transformed(std::vector<PosePair<G, Time>> pairs,
                                                         const SimilarityTransform<ScalarOf<G>>& transform) {
  for (auto& pair : pairs) pair.estimate = transform(pair.estimate);
  return pairs;
}

/// The pairs with the estimate aligned; throws as alignment() does.
template <Pose G, TimePoint Time>
[[nodiscard]] std::vector<PosePair<G, Time>> aligned(const std::vector<PosePair<G, Time>>& pairs, Alignment kind,
                                                     std::size_t count = (std::numeric_limits<std::size_t>::max)()) {
  return transformed(pairs, alignment(pairs, kind, count));
}

}  // namespace splinertia
