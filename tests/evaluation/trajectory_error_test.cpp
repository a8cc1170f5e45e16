// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <splinertia/evaluation/trajectory_error.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;

namespace {

template <typename G>
using Pairs = std::vector<PosePair<G, double>>;

template <typename G>
G pose(const Eigen::Vector3<ScalarOf<G>>& turn, const Eigen::Vector3<ScalarOf<G>>& p) {
  return make_pose<G>(GroupTraits<Sophus::SO3<ScalarOf<G>>>::exp(turn), p);
}

// Along x, 1 m and 0.5 rad from one to the next.
template <typename G>
Pairs<G> along_x(int count) {
  Pairs<G> pairs;
  for (int i = 0; i < count; ++i) {
    const auto s = static_cast<ScalarOf<G>>(i);
    const G x = pose<G>({0, 0, s / 2}, {s, 0, 0});
    pairs.push_back({0.1 * i, x, x});
  }
  return pairs;
}

using Split = SO3xR3<double>;

std::string error_of(const auto& f) { return test::error_of<std::invalid_argument>(f); }

}  // namespace

TEMPLATE_TEST_CASE("Absolute errors are the distance and the angle between the poses of a pair", "", SO3xR3<double>,
                   Sophus::SE3d, SO3xR3<float>, SO3xR3<long double>) {
  using G = TestType;
  using Scalar = ScalarOf<G>;
  const Scalar tolerance = 10 * std::numeric_limits<Scalar>::epsilon();
  auto pairs = along_x<G>(2);
  pairs[1].estimate = pose<G>({0, 0, Scalar(2)}, {Scalar(1), Scalar(3), Scalar(-4)});
  const auto errors = absolute_errors(pairs);
  REQUIRE(errors.size() == 2);
  CHECK(errors[0].translation == 0);
  CHECK(errors[0].rotation == 0);
  CHECK(errors[1].translation == 5);
  CHECK(std::abs(errors[1].rotation - Scalar(1.5)) <= tolerance);
}

TEST_CASE("An angle is the shorter one, up to a half turn") {
  Pairs<Split> pairs(2);
  pairs[0].estimate = pose<Split>({0, 0, 4}, {0, 0, 0});
  pairs[1].estimate = pose<Split>({std::numbers::pi, 0, 0}, {0, 0, 0});
  const auto errors = absolute_errors(pairs);
  CHECK_THAT(errors[0].rotation, WithinAbs(2 * std::numbers::pi - 4, 1e-15));
  CHECK_THAT(errors[1].rotation, WithinAbs(std::numbers::pi, 1e-15));
}

TEMPLATE_TEST_CASE("Relative errors do not see where a trajectory begins", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  auto pairs = along_x<G>(10);
  const SimilarityTransform<double> elsewhere{GroupTraits<Sophus::SO3d>::exp({1, 2, -1}), {10, -20, 30}};
  for (const auto& error : relative_errors(transformed(pairs, elsewhere), index_pairs_by_frames(10, 3))) {
    CHECK(error.translation < 1e-13);
    CHECK(error.rotation < 1e-14);
  }
  // A step in the middle is seen by the pairs that span it, in full: in the axes of the first pose of the estimate.
  const SimilarityTransform<double> step{GroupTraits<Sophus::SO3d>::exp({0, 0, 0.25}), {0, 0, 2}};
  for (std::size_t i = 5; i < 10; ++i) pairs[i].estimate = step(pairs[i].estimate);
  const auto errors = relative_errors(pairs, index_pairs_by_frames(10, 2));
  REQUIRE(errors.size() == 4);
  CHECK(errors[1].translation < 1e-14);
  CHECK_THAT(errors[2].rotation, WithinAbs(0.25, 1e-15));
  const Eigen::Vector3d miss = position(pairs[6].estimate) - Eigen::Vector3d(6, 0, 0);
  CHECK_THAT(errors[2].translation, WithinAbs(miss.norm(), 1e-14));
  CHECK(errors[3].rotation < 1e-15);
  // The definition, with matrices.
  const auto matrix = [](const G& x) {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.topLeftCorner<3, 3>() = rotation(x).matrix();
    m.topRightCorner<3, 1>() = position(x);
    return m;
  };
  const Eigen::Matrix4d Q = matrix(pairs[4].reference).inverse() * matrix(pairs[6].reference);
  const Eigen::Matrix4d P = matrix(pairs[4].estimate).inverse() * matrix(pairs[6].estimate);
  const Eigen::Matrix4d E = Q.inverse() * P;
  CHECK_THAT(errors[2].translation, WithinAbs((E.topRightCorner<3, 1>().norm()), 1e-14));
  CHECK_THAT(errors[2].rotation, WithinAbs(std::acos((E.topLeftCorner<3, 3>().trace() - 1) / 2), 1e-14));
}

TEST_CASE("Statistics are those of numpy") {
  const auto s = error_statistics(std::vector<double>{4, 1, 3, 8});
  CHECK(s.count == 4);
  CHECK(s.min == 1);
  CHECK(s.max == 8);
  CHECK(s.mean == 4);
  CHECK(s.median == 3.5);
  CHECK(s.sse == 90);
  CHECK(s.rmse == std::sqrt(22.5));
  CHECK(s.standard_deviation == std::sqrt(6.5));  // of all there are: divided by 4, not by 3
  CHECK(error_statistics(std::vector<double>{4, 1, 3}).median == 3);
  const auto one = error_statistics(std::vector<float>{2});
  CHECK(one.rmse == 2);
  CHECK(one.median == 2);
  CHECK(one.standard_deviation == 0);
  const std::vector<PoseError<double>> errors{{1, 10}, {3, 30}};
  CHECK(error_statistics(errors, &PoseError<double>::translation).mean == 2);
  CHECK(error_statistics(errors, &PoseError<double>::rotation).mean == 20);
  CHECK(error_statistics(errors, [](const auto& e) { return e.rotation / 10; }).max == 3);

  CHECK(error_of([] { (void)error_statistics(std::vector<double>{}); }) == "error_statistics: no errors");
  CHECK(error_of([] { (void)error_statistics(std::vector<double>{1, std::numeric_limits<double>::quiet_NaN()}); }) ==
        "error_statistics: error 1 is not finite");
}

// That all of it agrees with evo is checked with the program: tests/tools/compare_trajectories_test.cmake.
TEST_CASE("From stamped poses to a figure") {
  std::vector<Stamped<Split>> reference, estimate;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.1 * i;
    const Split x = pose<Split>({0, 0, t}, {std::cos(t), 2 * std::sin(t), t});
    const SimilarityTransform<double> drift{GroupTraits<Sophus::SO3d>::exp({0.01, 0, 0}), {0.1 * i, 5, 0}};
    reference.push_back({std::chrono::milliseconds(100 * i), x});
    estimate.push_back({std::chrono::milliseconds(100 * i + 3), drift(x)});
  }
  const auto pairs = aligned(associate(reference, estimate), Alignment::origin);
  const auto ate = error_statistics(absolute_errors(pairs), &PoseError<double>::translation);
  CHECK(ate.count == 50);
  CHECK(ate.min < 1e-15);
  CHECK_THAT(ate.max, WithinAbs(4.9, 1e-12));
  const auto rpe = error_statistics(relative_errors(pairs, index_pairs_by_frames(pairs.size(), 10)),
                                    &PoseError<double>::translation);
  CHECK(rpe.count == 4);
  CHECK_THAT(rpe.mean, WithinAbs(1, 1e-12));
  CHECK(rpe.standard_deviation < 1e-12);
}
