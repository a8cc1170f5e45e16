// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/imu/random_walk.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("After a time T the bias has deviation K times root T, whatever the rate") {
  const RandomWalk walk{0.25};
  for (const double rate : {10.0, 50.0}) {
    constexpr int runs = 4000;
    constexpr double duration = 4;
    const int n = static_cast<int>(duration * rate);
    double squares = 0;
    for (std::uint64_t run = 0; run < runs; ++run) {
      RandomWalk<double>::State state(StreamKey(run) / "walk");
      Sample<double> sample;
      for (int i = 0; i <= n; ++i) {
        sample = {Eigen::Vector3d::Constant(7), Eigen::Vector3d::Zero(), 1 / rate, i == 0};
        walk.apply(sample, state);
        REQUIRE(sample.value ==
                Eigen::Vector3d::Constant(7) + sample.bias);  // the bias reported is the one in the sample
        if (i == 0) REQUIRE(sample.bias.isZero(0));
      }
      squares += sample.bias.squaredNorm() / 3;
    }
    const double expected = 0.25 * std::sqrt(duration);
    CHECK(std::abs(std::sqrt(squares / runs) - expected) < 4 * expected / std::sqrt(2.0 * 3 * runs));
  }
}

TEST_CASE("A density is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(RandomWalk{0.1F}), RandomWalk<float>>);
  CHECK(RandomWalk{Eigen::Vector3d(1, 2, 3)}.density[2] == 3);
}

TEST_CASE("A density that is none is refused") {
  CHECK_THROWS_WITH(RandomWalk{-1.0}, "RandomWalk: density is -1, expected a finite number >= 0");
  CHECK_THROWS_AS(RandomWalk{std::nan("")}, std::invalid_argument);
}
