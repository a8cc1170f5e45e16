// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/pose_statistics.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
using Numbers = std::vector<Stamped<Number, double>>;

Numbers values(const std::vector<double>& times, const auto& f) {
  Numbers result;
  for (const double t : times) result.push_back({t, Number(f(t))});
  return result;
}

template <std::size_t N>
NeighbourResidual<Number> residual_of(const Numbers& poses) {
  std::array<std::size_t, N> indices;
  for (std::size_t i = 0; i < N; ++i) indices[i] = i;
  return neighbour_residual(poses, indices);
}

/// A smooth motion of any group at 100 Hz, with white noise in the tangent space at each pose.
template <typename G>
std::vector<Stamped<G, double>> smooth_motion(int count, double noise, std::uint64_t seed) {
  using Scalar = ScalarOf<G>;
  NormalStream normal{StreamKey(seed)};
  std::vector<Stamped<G, double>> poses;
  for (int i = 0; i < count; ++i) {
    const double t = 0.01 * i;
    Tangent<G> way, error;
    for (int row = 0; row < way.size(); ++row) {
      way[row] = static_cast<Scalar>(0.4 * std::sin((1 + 0.3 * row) * t + row));
      error[row] = static_cast<Scalar>(noise * normal());
    }
    poses.push_back({t, GroupTraits<G>::compose(GroupTraits<G>::exp(way), GroupTraits<G>::exp(error))});
  }
  return poses;
}

}  // namespace

TEST_CASE("The median interval does not see holes") {
  const auto at = [](const std::vector<double>& times) {
    return median_interval(values(times, [](double) { return 0; }));
  };
  CHECK(at({3, 3.5}) == 0.5);
  CHECK(at({0, 1, 2, 10}) == 1);
  CHECK(at({0, 1, 2, 50, 51, 100, 101}) == 1);
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const std::vector<Stamped<Number, nanoseconds>> poses{
      {epoch, Number(0)}, {epoch + nanoseconds(5'000'000), Number(0)}, {epoch + nanoseconds(10'000'000), Number(0)}};
  CHECK_THAT(median_interval(poses), WithinRel(0.005, 1e-15));
}

TEST_CASE("The residual vanishes for polynomials of the degree N − 2, at uneven times as well") {
  const std::vector<double> times{0, 0.7, 1.1, 2.4, 2.9, 4.2, 4.4};
  const auto first = [&](std::ptrdiff_t n) { return std::vector<double>(times.begin(), times.begin() + n); };
  const auto power = [](int degree) { return [degree](double t) { return std::pow(t - 1.3, degree); }; };
  for (int degree = 0; degree <= 5; ++degree) {
    INFO("degree " << degree);
    const auto is_zero = [&](const auto& r) { return std::abs(r.residual[0]) < 1e-12; };
    CHECK(is_zero(residual_of<3>(values(first(3), power(degree)))) == (degree <= 1));
    CHECK(is_zero(residual_of<5>(values(first(5), power(degree)))) == (degree <= 3));
    CHECK(is_zero(residual_of<7>(values(first(7), power(degree)))) == (degree <= 5));
  }
}

TEST_CASE("At even times the weights are those of the differences of even order") {
  // Over the middle weight: 1 −2 1 / 2, 1 −4 6 −4 1 / 6, 1 −6 15 −20 15 −6 1 / 20.
  const auto zero = values({0, 1, 2, 3, 4, 5, 6}, [](double) { return 0; });
  CHECK_THAT(residual_of<3>(zero).amplification, WithinRel(std::sqrt(6) / 2, 1e-14));
  CHECK_THAT(residual_of<5>(zero).amplification, WithinRel(std::sqrt(70) / 6, 1e-14));
  CHECK_THAT(residual_of<7>(zero).amplification, WithinRel(std::sqrt(924) / 20, 1e-14));
  const std::array<double, 7> expected{1, -6, 15, -20, 15, -6, 1};
  for (std::size_t i = 0; i < 7; ++i) {
    auto one = zero;
    one[i].value[0] = 1;
    CHECK_THAT(residual_of<7>(one).residual[0], WithinAbs(expected[i] / 20, 1e-14));
  }
}

TEST_CASE("The cubic through four neighbours misses by h⁴ x⁗/6, and the parabola has the acceleration") {
  const double h = 0.1;
  const auto at = [&](const auto& f) { return residual_of<5>(values({1 - 2 * h, 1 - h, 1, 1 + h, 1 + 2 * h}, f)); };
  CHECK_THAT(std::abs(at([](double t) { return t * t * t * t; }).residual[0]),
             WithinRel(std::pow(h, 4) * 24 / 6, 1e-9));
  CHECK_THAT(at([](double t) { return 3 + t - 5 * t * t; }).acceleration[0], WithinRel(-10, 1e-10));
  const auto uneven = values({0, 0.2, 0.5}, [](double t) { return 3 + t - 5 * t * t; });
  CHECK_THAT(residual_of<3>(uneven).acceleration[0], WithinRel(-10, 1e-12));
}

TEST_CASE("A steady turn of up to 180° a pose leaves no residual") {
  for (const double step : {0.5, 2.0, 3.1}) {
    std::vector<Stamped<Sophus::SO3d, double>> poses;
    for (int i = 0; i < 7; ++i)
      poses.push_back({1.0 * i, Sophus::SO3d::exp(Eigen::Vector3d(0.6, 0, 0.8) * (step * i))});
    const auto r = neighbour_residual(poses, std::array<std::size_t, 7>{0, 1, 2, 3, 4, 5, 6});
    CHECK(r.residual.norm() < 1e-13);
    CHECK(r.acceleration.norm() < 1e-13);
  }
}

TEMPLATE_TEST_CASE("The noise of a smooth motion is found", "[group]", Number, Eigen::Vector3d, Sophus::SO3d,
                   Sophus::SE2d, Sophus::SE3d, SO3xR3<double>, SO3xR3<float>) {
  using G = TestType;
  // A median of n normal magnitudes has the relative deviation 1.17/√n. The sixth differences of white noise are
  // correlated: 1 + 2 Σ ρ² = 3.2 makes it √3.2 times as much, 3.3 % for n = 4000. The least of three is lower, not
  // higher.
  const double bound = 4 * 0.033;
  for (const double noise : {1e-4, 1e-2}) {
    const Tangent<G> found = pose_noise(smooth_motion<G>(4000, noise, 3));
    for (const auto& component : found) CHECK_THAT(double{component}, WithinRel(noise, bound));
  }
}

TEST_CASE("A motion that is not smooth raises the noise, and gross outliers do not") {
  auto poses = smooth_motion<SO3xR3<double>>(4000, 1e-3, 5);
  for (std::size_t i = 20; i < poses.size(); i += 40)
    poses[i].value.get<1>().x() += 3;  // 17 % of the residuals see one
  const auto found = pose_noise(poses);
  CHECK(found.minCoeff() > 1e-3 * (1 - 4 * 0.033));
  CHECK(found.maxCoeff() < 1e-3 * 1.5);  // the median of the 83 % that do not: the 60 % point of all, 1.25 σ
  // A vibration of 40 Hz at 100 Hz: no polynomial follows it.
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].value.get<1>().y() += 0.1 * std::sin(2 * M_PI * 40 * poses[i].time);
  CHECK(pose_noise(poses)[4] > 0.03);
}

TEST_CASE("Few poses") {
  const auto line = [](double t) { return 2 * t; };
  CHECK(std::isinf(pose_noise(values({0, 1}, line))[0]));  // nothing shows any
  CHECK(pose_noise(values({0, 1, 2}, line))[0] == 0);
  CHECK_THAT(pose_noise(values({0, 1, 2}, [](double t) { return t * t; }))[0],
             WithinRel(1.4826 / std::sqrt(1.5), 1e-6));
  CHECK(pose_noise(values({0, 1, 2, 3, 4, 5, 6, 7}, [](double) { return 1; }))[0] == 0);
}
