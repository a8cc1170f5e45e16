// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/evaluation/trajectory_alignment.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename Scalar>
using Points = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;

template <typename Scalar>
SimilarityTransform<Scalar> some_transform() {
  SimilarityTransform<Scalar> transform;
  transform.rotation = GroupTraits<Sophus::SO3<Scalar>>::exp({Scalar(1), Scalar(-2), Scalar(1.5)});
  transform.translation = {Scalar(3), Scalar(-20), Scalar(7)};
  transform.scale = Scalar(1.25);
  return transform;
}

template <typename Scalar>
Points<Scalar> applied(const SimilarityTransform<Scalar>& transform, Points<Scalar> points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) = transform(Eigen::Vector3<Scalar>(points.col(i)));
  return points;
}

// On a curve that bends and climbs.
template <typename Scalar>
Points<Scalar> helix(int count) {
  Points<Scalar> points(3, count);
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i;
    points.col(i) = Eigen::Vector3d(std::cos(t), 2 * std::sin(t), 0.2 * t).cast<Scalar>();
  }
  return points;
}

template <typename Scalar>
Scalar squares(const Points<Scalar>& from, const Points<Scalar>& to, const SimilarityTransform<Scalar>& transform) {
  return (applied(transform, from) - to).squaredNorm();
}

std::string error_of(const auto& f) { return test::error_of<std::invalid_argument>(f); }

}  // namespace

TEMPLATE_TEST_CASE("A similarity is found again", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  auto transform = some_transform<Scalar>();
  const auto from = helix<Scalar>(100);
  for (const bool with_scale : {false, true}) {
    if (!with_scale) transform.scale = 1;
    const auto found = fit_similarity<Scalar>(from, applied(transform, from), with_scale);
    CHECK(increment(transform.rotation, found.rotation).norm() < 100 * eps);
    CHECK((found.translation - transform.translation).norm() < 100 * eps * transform.translation.norm());
    CHECK(std::abs(found.scale - transform.scale) <= 20 * eps);
    if (!with_scale) CHECK(found.scale == 1);
    transform.scale = Scalar(1.25);
  }
}

TEST_CASE("No transform near the one that is found has a smaller sum of squares") {
  const auto from = helix<double>(30);
  Points<double> to = applied(some_transform<double>(), from);
  for (int i = 0; i < 30; ++i)
    to.col(i) += 0.1 * Eigen::Vector3d(std::sin(7.0 * i), std::cos(5.0 * i), std::sin(3.0 * i));
  for (const bool with_scale : {false, true}) {
    const auto best = fit_similarity<double>(from, to, with_scale);
    const double least = squares(from, to, best);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-3, 1e-3}) {
        auto other = best;
        other.translation[axis] += step;
        CHECK(squares(from, to, other) > least);
        other = best;
        other.rotation = other.rotation * GroupTraits<Sophus::SO3d>::exp(step * Eigen::Vector3d::Unit(axis));
        CHECK(squares(from, to, other) > least);
        other = best;
        other.scale += step;
        if (with_scale) CHECK(squares(from, to, other) > least);
      }
    }
  }
}

TEST_CASE("A triangle can be turned over in space") {
  Points<double> from(3, 3), to(3, 3);
  from << 0, 1, 0, 0, 0, 2, 0, 0, 0;
  to << 0, -1, 0, 0, 0, 2, 0, 0, 0;
  const auto turned = fit_similarity<double>(from, to, true);
  CHECK(squares(from, to, turned) < 1e-28);
  CHECK(std::abs(turned.scale - 1) < 1e-14);
}

TEST_CASE("A mirrored trajectory is rotated, not mirrored") {
  const auto from = helix<double>(50);
  Points<double> to = from;
  to.row(2) *= -1;
  const auto found = fit_similarity<double>(from, to, true);
  CHECK(found.scale > 0);
  CHECK(std::abs(found.rotation.matrix().determinant() - 1) < 1e-14);
  CHECK(squares(from, to, found) > 0.1);
}

TEST_CASE("Far from the origin, alignment is as good as the positions are") {
  auto transform = some_transform<double>();
  transform.translation = {1e9, -1e9, 1e8};
  const auto from = helix<double>(1000);
  const auto to = applied(transform, from);
  const auto found = fit_similarity<double>(from, to, true);
  CHECK(increment(transform.rotation, found.rotation).norm() < 1e-7);
  CHECK((applied(found, from) - to).cwiseAbs().maxCoeff() < 1e-6);  // positions are multiples of 1.2e-7 m
}

TEST_CASE("Points that do not determine a rotation are refused") {
  const auto refused = [](const Points<double>& from, const Points<double>& to) {
    return error_of([&] { (void)fit_similarity<double>(from, to, true); });
  };
  const auto points = helix<double>(4);
  CHECK(refused(points, points) == "");
  CHECK(refused(points, helix<double>(5)) ==
        "fit_similarity: 4 and 5 points, expected the same number of both, and at least 3");
  CHECK(refused(helix<double>(2), helix<double>(2)) ==
        "fit_similarity: 2 and 2 points, expected the same number of both, and at least 3");
  CHECK(refused(Points<double>(3, 0), Points<double>(3, 0)) ==
        "fit_similarity: 0 and 0 points, expected the same number of both, and at least 3");
  const auto degenerate = [&](const Points<double>& from, const Points<double>& to) {
    return refused(from, to).find("do not determine a rotation, expected points that are not all on one line") !=
           std::string::npos;
  };
  // At rest, on a line, each with or without rounding: one of the two is enough.
  Points<double> rest(3, 4), line(3, 4), far_line(3, 4);
  for (int i = 0; i < 4; ++i) {
    rest.col(i) << 0.1, 0.2, 0.3;
    line.col(i) = i / 3.0 * Eigen::Vector3d(0.1, 0.7, -0.3);
    far_line.col(i) = Eigen::Vector3d(1e9, 2e8, 3e7) + i / 3.0 * Eigen::Vector3d(0.1, 0.7, -0.3);
  }
  for (const auto& bad : {rest, line, far_line}) {
    CHECK(degenerate(bad, points));
    CHECK(degenerate(points, bad));
    CHECK(degenerate(bad, bad));
  }
  // A mirrored figure that is as wide as it is high can be laid onto itself in many ways.
  Points<double> octahedron(3, 6);
  octahedron << 1, -1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -1;
  CHECK(refused(octahedron, octahedron) == "");
  CHECK(degenerate(octahedron, -octahedron));
  Points<double> bad = points;
  bad(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(points, bad) == "fit_similarity: the points, or their squares, are not finite");
  CHECK(refused(1e200 * points, points) == "fit_similarity: the points, or their squares, are not finite");
}

TEMPLATE_TEST_CASE("Trajectories are aligned as asked", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  const auto transform = some_transform<double>();
  std::vector<PosePair<G, double>> pairs;
  const auto points = helix<double>(20);
  for (int i = 0; i < 20; ++i) {
    const G estimate = make_pose<G>(GroupTraits<Sophus::SO3d>::exp({0.1 * i, 0, 0.2}), points.col(i));
    pairs.push_back({0.1 * i, transform(estimate), estimate});
  }
  const auto worst = [](const auto& all) {
    double error = 0;
    for (const auto& p : all) {
      error = std::max({error, (position(p.reference) - position(p.estimate)).norm(),
                        increment(rotation(p.reference), rotation(p.estimate)).norm()});
    }
    return error;
  };
  CHECK(worst(aligned(pairs, Alignment::none)) == worst(pairs));
  CHECK(worst(aligned(pairs, Alignment::sim3)) < 1e-13);
  CHECK(alignment(pairs, Alignment::se3).scale == 1);
  CHECK(worst(aligned(pairs, Alignment::se3)) > 0.1);
  const auto from_origin = aligned(pairs, Alignment::origin);
  CHECK((position(from_origin[0].reference) - position(from_origin[0].estimate)).norm() < 1e-14);
  CHECK(increment(rotation(from_origin[7].reference), rotation(from_origin[7].estimate)).norm() < 1e-14);
  CHECK(from_origin[7].time == pairs[7].time);
  pairs.clear();
  CHECK(error_of([&] { (void)aligned(pairs, Alignment::none); }) == "alignment: no pairs of poses");
}

TEMPLATE_TEST_CASE("Heading and translation are found again", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const auto from = helix<Scalar>(100);
  for (const double yaw : {0.0, 0.5, -2.0, 3.14159, 1e-6}) {
    SimilarityTransform<Scalar> transform;
    transform.rotation = GroupTraits<Sophus::SO3<Scalar>>::exp({0, 0, static_cast<Scalar>(yaw)});
    transform.translation = {Scalar(3), Scalar(-20), Scalar(7)};
    const auto found = fit_yaw<Scalar>(from, applied(transform, from));
    CHECK(increment(transform.rotation, found.rotation).norm() < 100 * eps);
    CHECK((found.translation - transform.translation).norm() < 100 * eps * transform.translation.norm());
    CHECK(found.scale == 1);
  }
}

TEST_CASE("No heading or translation near those that are found has a smaller sum of squares") {
  const auto from = helix<double>(30);
  const Points<double> to = applied(some_transform<double>(), from);  // turned about other axes, too
  const auto best = fit_yaw<double>(from, to);
  CHECK(best.rotation.unit_quaternion().vec().head<2>() == Eigen::Vector2d::Zero());
  const double least = squares(from, to, best);
  for (const double step : {-1e-3, 1e-3}) {
    auto other = best;
    other.rotation = GroupTraits<Sophus::SO3d>::exp({0, 0, step}) * best.rotation;
    other.translation = to.rowwise().mean() - other(Eigen::Vector3d(from.rowwise().mean()));
    CHECK(squares(from, to, other) > least);
    for (int axis = 0; axis < 3; ++axis) {
      other = best;
      other.translation[axis] += step;
      CHECK(squares(from, to, other) > least);
    }
  }
  // And none far away.
  for (double yaw = 0.1; yaw < 6.2; yaw += 0.1) {
    auto other = best;
    other.rotation = GroupTraits<Sophus::SO3d>::exp({0, 0, yaw}) * best.rotation;
    other.translation = to.rowwise().mean() - other(Eigen::Vector3d(from.rowwise().mean()));
    CHECK(squares(from, to, other) > least);
  }
}

TEST_CASE("Points that do not determine a heading are refused") {
  const auto refused = [](const Points<double>& from, const Points<double>& to) {
    return error_of([&] { (void)fit_yaw<double>(from, to); });
  };
  const auto points = helix<double>(4);
  Points<double> line(3, 4), column(3, 4);
  for (int i = 0; i < 4; ++i) {
    line.col(i) = i / 3.0 * Eigen::Vector3d(0.1, 0.7, -0.3);
    column.col(i) << 0.1, 0.2, 0.3 * i;
  }
  CHECK(refused(line, line) == "");  // enough for a heading
  const auto degenerate =
      "fit_yaw: 4 points do not determine a rotation about z, expected points that are not all on one "
      "vertical line";
  CHECK(refused(column, points) == degenerate);
  CHECK(refused(points, column) == degenerate);
  CHECK(refused(points, helix<double>(5)) ==
        "fit_yaw: 4 and 5 points, expected the same number of both, and at least 2");
  CHECK(refused(helix<double>(1), helix<double>(1)) != "");
  Points<double> bad = points;
  bad(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(points, bad) == "fit_yaw: the points, or their squares, are not finite");
}

TEMPLATE_TEST_CASE("The first pairs alone can be aligned", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  SimilarityTransform<double> transform;
  transform.rotation = GroupTraits<Sophus::SO3d>::exp({0, 0, 2.5});
  transform.translation = {1, 2, 3};
  std::vector<PosePair<G, double>> pairs;
  const auto points = helix<double>(20);
  for (int i = 0; i < 20; ++i) {
    const G estimate = make_pose<G>(GroupTraits<Sophus::SO3d>::exp({0.1 * i, 0, 0.2}), points.col(i));
    const G elsewhere = make_pose<G>(rotation(estimate), points.col(i) + Eigen::Vector3d(i >= 10 ? 5 : 0, 0, 0));
    pairs.push_back({0.1 * i, transform(estimate), elsewhere});
  }
  const auto off = [&](const SimilarityTransform<double>& found) {
    return increment(transform.rotation, found.rotation).norm() + (transform.translation - found.translation).norm();
  };
  for (const auto kind : {Alignment::yaw, Alignment::se3, Alignment::sim3}) {
    CHECK(off(alignment(pairs, kind, 10)) < 1e-12);
    CHECK(off(alignment(pairs, kind)) > 0.1);
    CHECK(off(alignment(pairs, kind, 20)) == off(alignment(pairs, kind, 1000)));
  }
  CHECK(off(alignment(pairs, Alignment::yaw, 1)) < 1e-14);  // from its attitudes
  CHECK(aligned(pairs, Alignment::yaw, 10)[10].time == pairs[10].time);
  CHECK(error_of([&] { (void)alignment(pairs, Alignment::se3, 2); }) != "");
  CHECK(error_of([&] { (void)alignment(pairs, Alignment::se3, 0); }) == "alignment: no pairs of poses");
  // Of a tilted pair the heading that is nearest; of one upside down there is none.
  const Sophus::SO3d tilt = GroupTraits<Sophus::SO3d>::exp({0.3, 0, 0});
  pairs[0].reference = make_pose<G>(tilt * transform.rotation * tilt * rotation(pairs[0].estimate), {0, 0, 0});
  const auto found = alignment(pairs, Alignment::yaw, 1);
  CHECK(std::abs(increment(transform.rotation, found.rotation).z()) < 0.1);
  CHECK(found.rotation.unit_quaternion().x() == 0);
  CHECK(found.rotation.unit_quaternion().y() == 0);
  pairs[0].estimate = make_pose<G>({}, {0, 0, 0});
  pairs[0].reference = make_pose<G>(Sophus::SO3d(Eigen::Quaterniond(0, 1, 0, 0)), {0, 0, 0});
  CHECK(error_of([&] { (void)alignment(pairs, Alignment::yaw, 1); }) ==
        "alignment: the first pair of attitudes does not determine a rotation about z");
}
