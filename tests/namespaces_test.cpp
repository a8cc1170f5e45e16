// SPDX-License-Identifier: MIT
// The library's namespace beside those that programs of the field use: no name may be ambiguous. That all are looked at
// is seen to by headers/names.cmake; here is ordinary use.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <numeric>
#include <random>
#include <splinertia/parallel.hpp>
#include <splinertia/splinertia.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

#include "support/catch.hpp"

namespace with_eigen {
using namespace std;
using namespace std::chrono;
using namespace Eigen;
using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("std, std::chrono, Eigen and splinertia are used together") {
  const Eigen::Vector3<double> v(1, 2, 3);
  const Eigen::Matrix3<double> m = hat<double>(v);
  CHECK((m * v).norm() == 0);
  CHECK(Eigen::Vector2<float>::Ones().sum() == 2);
  CHECK(to_seconds<double>(seconds(5) - milliseconds(500)) == 4.5);
  CHECK(to_nanoseconds(seconds(5)) == nanoseconds(5'000'000'000));
  CHECK(after(nanoseconds(0), 0.25) == milliseconds(250));

  vector<int> numbers(3), drawn;
  for_each_index(SingleThread{}, numbers.size(), [&](size_t i) { numbers[i] = static_cast<int>(i); });
  rotate(numbers.begin(), numbers.begin() + 1, numbers.end());
  CHECK(numbers == vector{1, 2, 0});
  std::mt19937 generator(1);
  sample(numbers.begin(), numbers.end(), back_inserter(drawn), 2, generator);
  CHECK(drawn.size() == 2);
  CHECK(is_same_v<decay_t<const int&>, decay<const int&>::type>);
}
}  // namespace with_eigen

namespace with_all {
using namespace std;
using namespace std::chrono;
using namespace Eigen;
using namespace Sophus;
using namespace splinertia;

TEST_CASE("std, std::chrono, Eigen, Sophus and splinertia are used together") {
  using Curve = Spline<SE3d, 4, UniformKnots<nanoseconds>>;
  vector<Stamped<SE3d, nanoseconds>> poses;
  for (int i = 0; i < 20; ++i) {
    poses.push_back({milliseconds(100 * i), SE3d(SO3d::exp({0, 0, 0.1 * i}), Vector3d(0.1 * i, 0, 0))});
  }
  const auto curve = interpolate<Curve>(poses);
  const auto motions = sample<1>(curve, curve.start(), nanoseconds(milliseconds(10)), 100);
  CHECK_THAT(motions[50].velocity[5], WithinAbs(1, 1e-6));

  const auto readings = simulate(curve, Imu{ErrorModel{WhiteNoise{1e-3}}, ErrorModel{}}, {.rate = 200, .seed = 1});
  vector<ImuSample<double, nanoseconds>> samples;
  for (const auto& reading : readings) samples.push_back({reading.time, reading.gyro, reading.accel});
  const auto states = integrate<Midpoint>(nav_state(curve.evaluate<1>(curve.start()), curve.start()), samples);
  CHECK((states.back().p_WB - curve.evaluate<0>(states.back().time).value.translation()).norm() < 0.05);
}
}  // namespace with_all
