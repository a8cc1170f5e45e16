// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/noise/random_walk.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

namespace {

// What a record does from each sample to the one `span` further on, over its deviation K·√time.
std::vector<double> moves(const std::vector<double>& x, const std::vector<double>& t, std::size_t span, double K) {
  std::vector<double> result;
  for (std::size_t i = 0; i + span < x.size(); i += span)
    result.push_back((x[i + span] - x[i]) / (K * std::sqrt(t[i + span] - t[i])));
  return result;
}

}  // namespace

TEMPLATE_TEST_CASE("The bias moves by K times root T in a time T, whatever the rate", "", float, double) {
  using Scalar = TestType;
  const double density[] = {0.25, 3e-5, 1};
  const ErrorModel model{RandomWalk(per_axis<Scalar>(density))};
  for (const double rate : {50.0, 200.0, 1000.0, 0.0}) {
    const Intervals intervals = rate > 0 ? regular(rate) : irregular(200);
    const std::vector<double> t = times(intervals);
    const Record errors = record<Scalar>(model, intervals, 8);
    CHECK(errors.all_bias);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double>& x = errors.axes[axis];
      CHECK(x[0] == 0);
      // From sample to sample, in 0.1 s, in 1 s and in 10 s at 200 Hz.
      for (const std::size_t span : {1U, 20U, 200U, 2000U}) {
        INFO(rate << " Hz, axis " << axis << ", " << span << " samples");
        const std::vector<double> z = moves(x, t, span, density[axis]);
        for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(z, lag)) < 4);
      }
    }
    const auto z = [&](std::size_t axis) { return moves(errors.axes[axis], t, 1, density[axis]); };
    CHECK(off(mean_product(z(0), z(1))) < 4);
    CHECK(off(mean_product(z(1), z(2))) < 4);
  }
}

TEST_CASE("The Allan deviation is K times root of tau/3") {
  constexpr double K = 0.2;
  for (const double rate : rates) {
    const Record errors = record<double>(ErrorModel{RandomWalk{K}}, regular(rate), 9);
    for (const std::size_t m : {10U, 100U, 1000U}) {
      // Of averages over m samples of a walk in m steps each: sums of the steps with weights that form a triangle, and
      // the triangles of neighbouring differences overlap by half.
      const double step = K * K / rate, count = static_cast<double>(m);
      const auto D = [&](std::size_t l) {
        return step * (l == 0 ? (2 * count * count + 1) / (3 * count) : (count * count - 1) / (6 * count));
      };
      CHECK_THAT(std::sqrt(D(0) / 2), WithinRel(K * std::sqrt(count / rate / 3), 0.26 / (count * count)));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        INFO(rate << " Hz, axis " << axis << ", " << m << " samples");
        CHECK(off(allan_variance(errors.axes[axis], m, D, 2)) < 4);
      }
    }
  }
}

TEST_CASE("A density is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(RandomWalk{0.1F}), RandomWalk<float>>);
  STATIC_CHECK(std::is_same_v<decltype(RandomWalk{1}), RandomWalk<double>>);
  STATIC_CHECK(std::is_same_v<decltype(RandomWalk{PerAxis<float>(1, 2, 3)}), RandomWalk<float, 3>>);
  CHECK(RandomWalk{Eigen::Vector3d(1, 2, 3)}.density[2] == 3);
}

TEST_CASE("A density that is none is refused") {
  CHECK_THROWS_WITH(RandomWalk{-1.0}, "RandomWalk: density is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(RandomWalk{std::nan("")}, "RandomWalk: density is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(RandomWalk{std::numeric_limits<float>::infinity()},
                    "RandomWalk: density is inf, expected a finite number >= 0");
}
