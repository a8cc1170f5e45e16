// SPDX-License-Identifier: MIT
#include <splinertia/evaluation/detail/angular_speed.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using detail::AngularSpeed;
using detail::SpeedRegression;

namespace {

// 0.5 rad/s, from 10 s on, every 0.1 s; none from 12 s to 13 s.
AngularSpeed turning() {
  std::vector<Stamped<SO3xR3<double>, double>> poses;
  for (int i = 0; i <= 50; ++i) {
    if (i > 20 && i < 30) continue;
    poses.push_back({10 + 0.1 * i, {GroupTraits<Sophus::SO3d>::exp({0, 0.03 * i, 0.04 * i}), Eigen::Vector3d::Zero()}});
  }
  return {poses, 10.0};
}

}  // namespace

TEST_CASE("Angular speed is known where poses are near") {
  const auto speed = turning();
  CHECK(speed.begin() == 0);
  CHECK(speed.end() == 5);
  CHECK_THAT(speed.median_interval(), WithinAbs(0.1, 1e-12));
  for (const double t : {0.2, 1.0, 1.234, 1.79, 3.3, 4.7}) CHECK_THAT(speed.at(t, 0.4), WithinAbs(0.5, 1e-12));
  for (const double t : {-1.0, 0.1, 1.9, 2.5, 3.1, 4.9, 7.0}) CHECK(speed.at(t, 0.4) == AngularSpeed::unknown);
  CHECK(speed.at(1, 0.05) == AngularSpeed::unknown);  // a window that is shorter than the intervals
  const auto sampled = speed.sampled(1.0, 0.4, 5);
  REQUIRE(sampled.size() == 5);
  for (const double value : sampled) CHECK_THAT(value, WithinAbs(0.5, 1e-12));
  CHECK(speed.sampled(1.65, 0.4, 1).front() == AngularSpeed::unknown);  // the mean would reach into the hole
  CHECK(speed.sampled(1.0, 0.4, 0).empty());
}

TEST_CASE("A regression leaves out what is unknown") {
  const std::vector<double> x{0, 1, 2, AngularSpeed::unknown, 3, 4}, y{1, 3, 5, 100, AngularSpeed::unknown, 9.5};
  const SpeedRegression line(x, y);
  CHECK(line.count == 4);
  CHECK_THAT(line.slope, WithinAbs(18.625 / 8.75, 1e-12));
  CHECK(line.correlation > 0.99);
  double sum = 0;
  std::vector<std::size_t> used;
  line.squares(x, y, [&](std::size_t i, double square) {
    used.push_back(i);
    sum += square;
  });
  CHECK(used == std::vector<std::size_t>{0, 1, 2, 5});
  CHECK_THAT(1 - sum / 39.6875, WithinAbs(line.correlation * line.correlation, 1e-12));
  CHECK(SpeedRegression(std::vector<double>{1, 1}, std::vector<double>{1, 2}).correlation == 0);
  CHECK(SpeedRegression(std::vector<double>{}, std::vector<double>{}).count == 0);
}
