// SPDX-License-Identifier: MIT
/// Knots from 1 ns to 1e6 s apart.
#include <chrono>
#include <string>

#include "extremes.hpp"

using namespace splinertia;
using namespace extremes;
using std::chrono::nanoseconds;

namespace {

template <int Order, typename G>
void check_intervals(Worst& worst) {
  testing::Random random(17);
  const auto points = random.walk<G>(9, 1);
  for (const double interval : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double start : {0.0, -interval / 3, 1e6 * interval}) {
      compare_curve<Order>(worst, UniformKnots{start, interval}, points);
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Every interval in seconds", "", float, double) {
  Worst rotation, pose;
  for_orders([&]<int Order>() { check_intervals<Order, Sophus::SO3<TestType>>(rotation); });
  check_intervals<4, Sophus::SE3<TestType>>(pose);
  rotation.require(std::string("interval 1e-9 ... 1e6 s, SO3 ") + scalar_name<TestType>);
  pose.require(std::string("interval 1e-9 ... 1e6 s, SE3 ") + scalar_name<TestType>);
}

TEMPLATE_TEST_CASE("Every interval in nanoseconds, at an epoch of today", "", Sophus::SO3f, Sophus::SO3d,
                   SO3xR3<double>) {
  using G = TestType;
  Worst worst;
  testing::Random random(18);
  const auto points = random.walk<G>(9, 1);
  for (const long long interval : {1LL, 7LL, 1'000LL, 5'000'000LL, 1'000'000'000LL, 1'000'000'000'000'000LL}) {
    const UniformKnots knots{nanoseconds{1'403'715'524'907'143'168}, nanoseconds{interval}};
    compare_curve<4>(worst, knots, points);
    compare_curve<6>(worst, knots, points);
  }
  worst.require(std::string("interval 1 ns ... 1e15 ns, ") + Layout<G>::name + " " + scalar_name<ScalarOf<G>>);
}

TEST_CASE("Time in float and in long double") {
  Worst in_float, in_long;
  testing::Random random(19);
  const auto points = random.walk<Sophus::SO3d>(9, 1);
  for (const float interval : {1e-9F, 1e-3F, 1.F, 1e6F}) {
    compare_curve<4>(in_float, UniformKnots{-interval, interval}, points);
  }
  for (const long double interval : {1e-9L, 1e-3L, 1.L, 1e6L}) {
    compare_curve<4>(in_long, UniformKnots{-interval, interval}, points);
  }
  in_float.require("time in float, SO3 double");
  in_long.require("time in long double, SO3 double");
}
