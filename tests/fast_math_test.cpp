// SPDX-License-Identifier: MIT
// Compiled with -ffast-math, which lets a compiler assume that there is no NaN and no infinity and that sums may be
// taken in any order: what numerics.md says of it.
#include <array>
#include <chrono>
#include <filesystem>
#include <limits>
#include <splinertia/allan/detail/compensated_sum.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/io/tum.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/sample_times.hpp>
#include <splinertia/spline/spline.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

#if !defined(__FAST_MATH__)
#error this test is about -ffast-math
#endif

/// NaN, infinity and −infinity, made while the program runs: the compiler must not know them.
template <typename Scalar>
std::array<Scalar, 3> not_finite() {
  volatile Scalar zero = 0, one = 1;
  return {zero / zero, one / zero, -one / zero};
}

using Pose3 = SO3xR3<double>;

Pose3 pose_at(double x) { return {Sophus::SO3d(), Eigen::Vector3d(x, 0, 0)}; }

}  // namespace

TEMPLATE_TEST_CASE("NaN and infinity are seen", "", float, double, long double) {
  using Limits = std::numeric_limits<TestType>;
  for (const TestType x : not_finite<TestType>()) CHECK_FALSE(is_finite(x));
  for (const TestType x : {TestType(0), TestType(-1), Limits::max(), Limits::lowest(), Limits::min()}) {
    CHECK(is_finite(x));
  }
  Eigen::Matrix<TestType, 3, 1> v(1, 2, 3);
  CHECK(all_finite(v));
  v[2] = not_finite<TestType>()[0];
  CHECK_FALSE(all_finite(v));
}

TEST_CASE("Input that is not finite is refused") {
  for (const double x : not_finite<double>()) {
    std::vector<Pose3> points(5, pose_at(1));
    CHECK_NOTHROW(Spline<Pose3, 4>({.start = 0, .interval = 1}, points));
    CHECK_THROWS_AS((Spline<Pose3, 4>({.start = x, .interval = 1}, points)), std::invalid_argument);
    CHECK_THROWS_AS((Spline<Pose3, 4>({.start = 0, .interval = x}, points)), std::invalid_argument);
    points[3] = pose_at(x);
    CHECK_THROWS_AS((Spline<Pose3, 4>({.start = 0, .interval = 1}, points)), std::invalid_argument);

    using Curve = Spline<Eigen::Matrix<double, 1, 1>, 2, NonUniformKnots<double>>;
    const std::vector<Eigen::Matrix<double, 1, 1>> numbers(3);
    CHECK_THROWS_AS(Curve(NonUniformKnots<double>{.knots = {0, 1, 2, x, 4}}, numbers), std::invalid_argument);

    CHECK_THROWS_AS(WhiteNoise<double>{x}, std::invalid_argument);
    CHECK_THROWS_AS(simulate(Circle<double>{}, Imu{}, {.rate = x, .start = 0, .end = 1}), std::invalid_argument);
    CHECK_THROWS_AS(simulate(Circle<double>{}, Imu{}, {.rate = 1, .start = 0, .end = x}), std::invalid_argument);

    using State = NavState<double>;
    const State rest{Sophus::SO3d(), {0, 0, 0}, {0, 0, 0}, 0.0};
    const auto integrate_samples = [](const State& initial, double reading, double time) {
      std::vector<ImuSample<>> samples(4, {0, {0, 0, 0}, {0, 0, 9.8}});
      for (std::size_t i = 1; i < samples.size(); ++i) samples[i].time = 0.01 * static_cast<double>(i);
      samples[2].gyro[1] = reading;
      samples[3].time = time;
      return integrate<Midpoint>(initial, samples);
    };
    CHECK_NOTHROW(integrate_samples(rest, 0, 0.03));
    CHECK_THROWS_AS(integrate_samples(rest, x, 0.03), std::invalid_argument);
    CHECK_THROWS_AS(integrate_samples(rest, 0, x), std::invalid_argument);
    std::vector<ImuSample<>> first(1, {x, {0, 0, 0}, {0, 0, 9.8}});
    CHECK_THROWS_AS(integrate<Midpoint>(rest, first), std::invalid_argument);
    CHECK_THROWS_AS(integrate<Midpoint>(State{Sophus::SO3d(), {0, 0, 0}, {0, 0, 0}, x}, first), std::invalid_argument);
    CHECK_THROWS_AS((Integrator<Midpoint, double>(rest, {0, 0, 0}, {.longest = x})), std::invalid_argument);
    CHECK_THROWS_AS(to_nanoseconds(x), std::out_of_range);
    CHECK_THROWS_AS(check_sample_times(SampleTimes<double>{x, 0.1}, 3, 0.0, 1.0), std::out_of_range);
    CHECK_THROWS_AS(integrate_samples({Sophus::SO3d(), {0, x, 0}, {0, 0, 0}, 0.0}, 0, 0.03), std::invalid_argument);

    const std::vector<Stamped<Pose3, double>> good_poses{{0, pose_at(1)}, {1, pose_at(2)}};
    for (const auto& bad : {Stamped<Pose3, double>{2, pose_at(x)}, Stamped<Pose3, double>{x, pose_at(1)}}) {
      auto poses = good_poses;
      poses.push_back(bad);
      CHECK_THROWS_AS(associate(good_poses, poses), std::invalid_argument);
    }
    TumWriter file(std::filesystem::temp_directory_path() / "splinertia_fast_math.tum");
    CHECK_THROWS_AS(file.append(Stamped<Pose3>{std::chrono::nanoseconds(0), pose_at(x)}), std::invalid_argument);
  }
}

TEMPLATE_TEST_CASE("What an addition rounds away is not lost in any order", "", float, double, long double) {
  using Scalar = TestType;
  volatile Scalar huge = 4 / std::numeric_limits<Scalar>::epsilon();
  allan::detail::CompensatedSum<Scalar> sum;
  for (int i = 0; i < 1000; ++i) {
    sum.add(1);
    sum.add(huge);
  }
  for (int i = 0; i < 1000; ++i) sum.add(-huge);
  CHECK(sum.value() == 1000);
}
