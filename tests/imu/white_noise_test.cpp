// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/imu/white_noise.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEMPLATE_TEST_CASE("The standard deviation of a sample is density times root rate", "", float, double) {
  using Scalar = TestType;
  const Scalar density[] = {Scalar(0.015), Scalar(0), Scalar(2)};
  const WhiteNoise<Scalar> noise(PerAxis<Scalar>(density[0], density[1], density[2]));
  for (const double rate : {50.0, 200.0, 1000.0}) {
    NormalStreams state(StreamKey(5));
    constexpr int n = 200'000;
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    for (int i = 0; i < n; ++i) {
      Sample<Scalar> sample{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero(), static_cast<Scalar>(1 / rate), i == 0};
      noise.apply(sample, state);
      squares += sample.value.template cast<double>().cwiseAbs2();
      REQUIRE(sample.bias.isZero(0));
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double expected = static_cast<double>(density[axis]) * std::sqrt(rate);
      const double deviation = std::sqrt(squares[axis] / n);
      CHECK(std::abs(deviation - expected) <= 4 * expected / std::sqrt(2.0 * n));  // its standard error, four times
    }
  }
}

TEST_CASE("A density is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{0.1}), WhiteNoise<double>>);
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{0.1F}), WhiteNoise<float>>);
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{PerAxis<double>(1, 2, 3)}), WhiteNoise<double>>);
  CHECK(WhiteNoise{Eigen::Vector3d(1, 2, 3)}.density[1] == 2);
}

TEST_CASE("A density that is none is refused") {
  CHECK_THROWS_WITH(WhiteNoise{-0.1}, "WhiteNoise: density is -0.1, expected a finite number >= 0");
  CHECK_THROWS_AS(WhiteNoise{std::nan("")}, std::invalid_argument);
  CHECK_THROWS_AS(WhiteNoise{std::numeric_limits<double>::infinity()}, std::invalid_argument);
}
