// SPDX-License-Identifier: MIT
#include <splinertia/imu/error_term.hpp>
#include <splinertia/imu/white_noise.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("Each axis has a stream of its own") {
  NormalStreams streams(StreamKey(1));
  NormalStream y(StreamKey(1) / 1);
  for (int i = 0; i < 10; ++i) {
    const auto n = streams.draw<double>();
    CHECK(n.y() == y());
    CHECK(n.x() != n.y());
    CHECK(n.y() != n.z());
  }
}

TEST_CASE("A term is known by its state") {
  STATIC_CHECK(ErrorTerm<WhiteNoise<double>>);
  STATIC_CHECK(!ErrorTerm<double>);
}
