// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/group/sophus.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/detail/acceleration_density.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;

/// A curve whose values are a function of time.
template <LieGroup G, int Order>
struct Function {
  using Group = G;
  using Scalar = ScalarOf<G>;
  using Time = double;
  static constexpr int order = Order;
  struct Value {
    G value;
  };

  std::function<G(double)> f;

  [[nodiscard]] double start() const { return 0; }
  [[nodiscard]] double end() const { return 100; }
  template <int>
  [[nodiscard]] Value evaluate(double t) const {
    return {f(t)};
  }
};

using Line = Function<Number, 4>;
using Polygon = Function<Number, 2>;

/// A path at ascending times whose second derivative (`integrals` 2) or first (1) is white noise of density S, and
/// which starts at rest at the first: the exact covariances of a step.
std::map<double, double> integrated_noise(std::vector<double> times, double density, int integrals, auto& normal) {
  std::sort(times.begin(), times.end());
  std::map<double, double> path;
  double x = 0, v = normal(), before = times.front();
  if (integrals == 1) v = 0;
  for (const double t : times) {
    const double step = t - before, a = normal(), b = normal(), root = std::sqrt(density * step);
    if (integrals == 1) {
      x += root * a;
    } else {
      x += v * step + root * step * (a / 2 + b / std::sqrt(12.));
      v += root * a;
    }
    path[t] = x;
    before = t;
  }
  return path;
}

/// The mean over runs of the density that is found beside one side, of values with noise of this deviation.
template <typename Curve>
double mean_density(const std::vector<double>& anchors, double density, double noise, int runs) {
  NormalStream normal{StreamKey(11)};
  double sum = 0;
  for (int run = 0; run < runs; ++run) {
    auto path = integrated_noise(anchors, density, Curve::order > 2 ? 2 : 1, normal);
    for (auto& [t, x] : path) x += noise * normal();
    const Curve curve{[&](double t) { return Number(path.at(t)); }};
    sum += (*AccelerationDensity<Curve>(curve, Number(noise)).around({anchors, {}}))[0];
  }
  return sum / runs;
}

}  // namespace

TEST_CASE("Beside one side, the density of integrated white noise is found without bias") {
  constexpr int runs = 4000;
  // D²/E D² has the variance 2. Seven of them, neighbours with the correlation 1/4: var of the mean
  // 2/7 (1 + 2 · 6/7 · 1/16) = 0.32.
  const double bound = 4 * std::sqrt(0.32 / runs);
  const std::vector<double> even{9, 8, 7, 6, 5, 4, 3, 2, 1};
  for (const double density : {1e-4, 1.0, 100.0}) {
    CHECK_THAT(mean_density<Line>(even, density, 0, runs), WithinRel(density, bound));
  }
  // Uneven: the worst correlation of neighbours is that of D over τ₁ τ₂ τ₃ at a short middle one, below 1/2.
  const std::vector<double> uneven{20, 19, 15, 12, 11.5, 9, 5, 4.2, 1};
  CHECK_THAT(mean_density<Line>(uneven, 1, 0, runs),
             WithinRel(1.0, 4 * std::sqrt(2. / 7 * (1 + 2. * 6 / 7 / 4) / runs)));
  // Of order 2, the increments are independent: eight of them.
  CHECK_THAT(mean_density<Polygon>(even, 3, 0, runs), WithinRel(3.0, 4 * std::sqrt(2. / 8 / runs)));
}

TEST_CASE("Noise of the values is taken out") {
  // Noise explains 9 σ² of D² at even steps of 1, where S = 1 explains 2/3. The noise of neighbouring D correlates by
  // −2/3, so that the variance is at most 2/7 (1 + 2 · 6/7 · 4/9 + 2 · 5/7 · 1/36) of E D², (1 + 9 σ²/(2/3))² times
  // that of S.
  constexpr int runs = 8000;
  const std::vector<double> even{9, 8, 7, 6, 5, 4, 3, 2, 1};
  const double noise = 0.1, noise_share = 9 * noise * noise / (2. / 3);
  const double bound = 4 * (1 + noise_share) * std::sqrt(2. / 7 * 1.8 / runs);
  // Below the noise's own density, 13.5 σ², it would be cut off: in fewer than 1 of 1000 runs with S = 7 times that.
  CHECK_THAT(mean_density<Line>(even, 1, noise, runs), WithinAbs(1.0, bound + 0.01));
}

TEST_CASE("Less than the noise could hide is not believed") {
  const Line still{[](double) { return Number(3); }};
  const double noise = 0.01;
  AccelerationDensity<Line> density(still, Number(noise));
  const Anchors anchors{{5, 4, 3, 2, 1}, {7, 8, 9, 10, 11}};
  // Of even steps of 1: σ² (1 + 1 + 4) · 3/2. The change into the hole, with a step of 2 s: σ² (1 + 1/4 + 9/4) · 3/3.
  CHECK_THAT((*density.around(anchors))[0], WithinRel(3.5 * noise * noise, 1e-12));
  CHECK_THAT((*density.around({anchors.before, {}}))[0], WithinRel(9 * noise * noise, 1e-12));
  CHECK(*AccelerationDensity<Line>(still, Number(0)).around(anchors) == Number(0));
}

TEST_CASE("The strongest of both sides and of the way across counts") {
  const Number none(0);
  const Anchors anchors{{5, 4, 3, 2, 1}, {7, 8, 9, 10, 11}};
  const auto density = [&](const auto& f) {
    const Line line{[&](double t) { return Number(f(t)); }};
    return (*AccelerationDensity<Line>(line, none).around(anchors))[0];
  };
  // Steady speed is none, whichever.
  CHECK(density([](double t) { return 3 - 2 * t; }) < 1e-25);
  // Steady acceleration a: D = a τ on either side, S = a² τ² · 3/2; across, τ₁ = 1 and τ₂ = 2: D = 1.5 a, S = 1.5² a².
  CHECK_THAT(density([](double t) { return 2 * t * t; }), WithinRel(1.5 * 1.5 * 16, 1e-12));
  // One side at rest, the other with a speed of 1: the two changes across, D = 1/2 each of 1 + 2 s.
  CHECK_THAT(density([](double t) { return std::max(0., t - 6); }), WithinRel(0.25, 1e-12));
  // A kink before, behind the anchors: one change of three has D = 8.
  CHECK_THAT(density([](double t) { return 4 * std::abs(t - 3); }), WithinRel(64 * 1.5 / 3, 1e-12));
}

TEST_CASE("Rotations are as their increments, and components of their own") {
  using G = Sophus::SO3d;
  using Curve = Function<G, 4>;
  const Curve turning{[](double t) { return G::exp(Eigen::Vector3d(0, 0, 0.5 * t)); }};
  const Curve swinging{[](double t) { return G::exp(Eigen::Vector3d(0, 0.02 * t * t, 0)); }};
  const Anchors anchors{{5, 4, 3, 2, 1}, {7, 8, 9, 10, 11}};
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  CHECK(AccelerationDensity<Curve>(turning, none).around(anchors)->norm() < 1e-25);
  const auto found = *AccelerationDensity<Curve>(swinging, none).around(anchors);
  CHECK_THAT(found[1], WithinRel(1.5 * 1.5 * 0.04 * 0.04, 1e-9));
  CHECK(found[0] + found[2] < 1e-25);
}

TEST_CASE("Too few anchors show nothing") {
  const Line line{[](double t) { return Number(t * t); }};
  AccelerationDensity<Line> density(line, Number(0));
  CHECK_FALSE(density.around({}));
  CHECK_FALSE(density.around({{1}, {2}}));
  CHECK_FALSE(density.around({{2, 1}, {}}));
  CHECK(density.around({{2, 1}, {3}}));
  CHECK(density.around({{3, 2, 1}, {}}));
  const Polygon polygon{[](double t) { return Number(t); }};
  AccelerationDensity<Polygon> velocity(polygon, Number(0));
  CHECK_FALSE(velocity.around({{1}, {}}));
  CHECK_THAT((*velocity.around({{1}, {3}}))[0], WithinRel(2, 1e-12));  // 1² · 2 s
}

TEST_CASE("At the scale of near anchors, with the acceleration that crosses the span") {
  const Anchors near{{3.9, 3.8, 3.7, 3.6}, {6.1, 6.2, 6.3, 6.4}};
  const auto density = [&](const auto& f, double noise = 0) {
    const Line line{[&](double t) { return Number(f(t)); }};
    return (*AccelerationDensity<Line>(line, Number(noise)).at_scale_of(near))[0];
  };
  CHECK(density([](double t) { return 3 - 2 * t; }) < 1e-20);
  // Steady a: 3/2 a² h on the sides; the slopes are those of the middles of their steps, 0.05 s off over 2.2 s.
  CHECK_THAT(density([](double t) { return 2 * t * t; }), WithinRel(1.5 * 16 * 0.1, 0.15));
  // A step of 1 between two rests: 6/2.2² at both ends.
  CHECK_THAT(density([](double t) { return t > 5 ? 1. : 0.; }), WithinRel(0.15 * std::pow(6 / (2.2 * 2.2), 2), 1e-9));
  // What noise could hide: σ² (1 + 1 + 4)/h² · 3/(2 h).
  CHECK_THAT(density([](double) { return 0.; }, 0.01), WithinRel(9e-4 / 1e-3, 1e-9));
  const Line line{[](double t) { return Number(t); }};
  AccelerationDensity<Line> few(line, Number(0));
  CHECK_FALSE(few.at_scale_of({{3.9, 3.8}, {6.1, 6.2, 6.3}}));
  CHECK_FALSE(few.at_scale_of({{3.9, 3.8, 3.7}, {}}));
  const Polygon polygon{[](double t) { return Number(t); }};
  CHECK_FALSE(AccelerationDensity<Polygon>(polygon, Number(0)).at_scale_of(near));
}

TEST_CASE("Anchors keep a guard from the span and go on through other measured parts") {
  const auto is = [](const std::vector<double>& got, const std::vector<double>& expected) {
    INFO(Catch::Detail::stringify(got));
    REQUIRE(got.size() == expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) CHECK_THAT(got[i], WithinAbs(expected[i], 1e-12));
  };
  // Steps as long as the span, 0.5 s, where the part beside is long enough; at most nine.
  const std::vector<MeasuredPart> two{{0, 2}, {2.5, 10}};
  is(anchors_beside(two, 0, -1, 0.5, 0.1), {1.9, 1.4, 0.9, 0.4});
  is(anchors_beside(two, 1, 1, 0.5, 0.1), {2.6, 3.1, 3.6, 4.1, 4.6, 5.1, 5.6, 6.1, 6.6});
  // A part shorter than that has half its length for a step, but at least a knot interval.
  is(anchors_beside(two, 0, -1, 5, 0.1), {1.9, 0.95, 0});
  is(anchors_beside({{0, 0.15}, {1, 2}}, 0, -1, 5, 0.1), {0.1, 0});
  // A single pose between two holes is one anchor, and behind it they go on.
  const std::vector<MeasuredPart> three{{0, 2}, {3, 3}, {4, 10}};
  const auto from_pose = anchors_beside(three, 1, 1, 0.5, 0.1);
  REQUIRE(from_pose.size() == 9);
  CHECK(from_pose[0] == 3);
  CHECK_THAT(from_pose[1], WithinAbs(4.1, 1e-12));
  is(anchors_beside(three, 1, -1, 0.5, 0.1), {3, 1.9, 1.8, 1.7, 1.6, 1.5, 1.4, 1.3, 1.2});
  // Nothing is beside an end.
  is(anchors_beside({{0, 2}}, 1, 1, 0.5, 0.1), {});
  is(anchors_beside({{0, 2}}, -1, -1, 0.5, 0.1), {});
}
