// SPDX-License-Identifier: MIT
// Breaks at ends are in end_jumps_test.cpp.
#include <cmath>
#include <cstdint>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/detail/pose_breaks.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using detail::breaks_between;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
using Numbers = std::vector<Stamped<Number, double>>;
using Indices = std::vector<std::size_t>;

Numbers numbers(int count, const auto& f, double noise = 0, std::uint64_t seed = 1) {
  NormalStream normal{StreamKey(seed)};
  Numbers result;
  for (int i = 0; i < count; ++i) result.push_back({0.01 * i, Number(f(i) + noise * normal())});
  return result;
}

}  // namespace

TEST_CASE("White noise breaks in less than one of a million steps") {
  // Both of two changes beyond ten medians, 16 σ, is out of reach; the median of all bounds it from below.
  std::size_t breaks = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    breaks += breaks_between(numbers(5000, [](int) { return 0; }, 1, seed)).size();
  }
  CHECK(breaks == 0);
}

TEST_CASE("Jumps and wrong poses are breaks where they are") {
  for (const double noise : {0., 1e-3}) {
    auto poses = numbers(400, [](int i) { return std::sin(0.02 * i); }, noise);
    for (std::size_t i = 100; i < 400; ++i) poses[i].value[0] += 0.5;
    poses[250].value[0] += 0.5;
    CHECK(breaks_between(poses) == Indices{99, 249, 250});
  }
}

TEST_CASE("A burst of motion is no break, however long the rest") {
  for (const double width : {5., 10., 30.}) {
    const auto turn = [&](int i) { return 2 * std::exp(-std::pow((i - 5000) / width, 2)); };
    for (const double noise : {0., 1e-6, 1e-3}) CHECK(breaks_between(numbers(10000, turn, noise)).empty());
  }
  // A ramp between two rests.
  const auto ramp = [](int i) { return 0.01 * std::min(std::max(i - 300, 0), 40); };
  CHECK(breaks_between(numbers(1000, ramp)).empty());
}

TEST_CASE("Rounding is no break") {
  const auto far = [](int i) { return 4.5e6 + (i == 500 ? 1e-9 : 0); };
  CHECK(breaks_between(numbers(1000, far)).empty());
  CHECK(breaks_between(numbers(1000, [](int i) { return 4.5e6 + (i == 500 ? 1e-3 : 0); })) == Indices{499, 500});
}

TEST_CASE("Fewer than eight poses have none") {
  CHECK(breaks_between(numbers(7, [](int i) { return i == 6 ? 1e3 : 0; })).empty());
  CHECK(breaks_between(numbers(8, [](int i) { return i == 7 ? 1e3 : 0; })) == Indices{6});
  CHECK(breaks_between(Numbers{}).empty());
}
