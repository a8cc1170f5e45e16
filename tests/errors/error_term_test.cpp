// SPDX-License-Identifier: MIT
#include <random>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/noise/white_noise.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::testing;

TEMPLATE_TEST_CASE("Each axis has a stream of its own, the same for float", "", Xoshiro256, std::mt19937_64) {
  NormalStreams<TestType> streams(StreamKey(1)), rounded(StreamKey(1));
  NormalStream<TestType> y(StreamKey(1) / 1);
  for (int i = 0; i < 10; ++i) {
    const auto n = streams.template draw<double>();
    CHECK(n.y() == y());
    CHECK(n.x() != n.y());
    CHECK(n.y() != n.z());
    CHECK(rounded.template draw<float>() == n.template cast<float>());
  }
}

TEST_CASE("One number at a time comes from the first stream") {
  NormalStreams streams(StreamKey(2));
  NormalStream x(StreamKey(2) / 0);
  CHECK(streams.draw_one() == x());
  CHECK(streams.uniform() == x.uniform());
  CHECK(streams.draw_one() == x());
}

TEST_CASE("Streams of axes, terms and seeds that are neighbours are independent") {
  const auto draws = [](StreamKey key) {
    NormalStream stream(key);
    std::vector<double> result(200'000);
    for (double& x : result) x = stream();
    return result;
  };
  const StreamKey key = StreamKey(3) / "gyro" / "white noise" / 0;
  const auto one = draws(key / 0);
  for (const StreamKey other :
       {key / 1, key / 2, StreamKey(3) / "gyro" / "white noise" / 1 / 0, StreamKey(3) / "gyro" / "random walk" / 0 / 0,
        StreamKey(3) / "accel" / "white noise" / 0 / 0, StreamKey(4) / "gyro" / "white noise" / 0 / 0}) {
    CHECK(off(mean_product(one, draws(other))) < 4);
  }
}

TEST_CASE("A term is known by its state") {
  STATIC_CHECK(ErrorTerm<WhiteNoise<double>>);
  STATIC_CHECK(StochasticTerm<WhiteNoise<double>>);
  STATIC_CHECK(ErrorTerm<ConstantBias<double>>);
  STATIC_CHECK(!StochasticTerm<ConstantBias<double>>);
  STATIC_CHECK(!ErrorTerm<double>);
  STATIC_CHECK(std::is_same_v<StateOf<WhiteNoise<double>>, NormalStreams<Xoshiro256>>);
  STATIC_CHECK(std::is_same_v<StateOf<WhiteNoise<double>, 3, std::mt19937>, NormalStreams<std::mt19937>>);
  STATIC_CHECK(std::is_same_v<StateOf<ConstantBias<double>, 3, std::mt19937>, ConstantBias<double>::State>);
}

TEST_CASE("Coefficients are made anew only for another interval") {
  ForInterval<double, int> coefficients;
  int made = 0;
  const auto make = [&] { return ++made; };
  CHECK(coefficients(0, make) == 1);
  CHECK(coefficients(0, make) == 1);
  CHECK(coefficients(0.005, make) == 2);
  CHECK(coefficients(0.005, make) == 2);
  CHECK(coefficients(0.01, make) == 3);
  CHECK(coefficients(0.005, make) == 4);
}
