// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <iterator>
#include <list>
#include <ranges>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/sample_imu.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/imu/to_vector.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/spline.hpp>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {
const Imu noisy{ErrorModel{WhiteNoise{0.01}}, ErrorModel{WhiteNoise{0.1}}};
}

TEST_CASE("Standard containers and algorithms take what simulate() yields") {
  const Ellipse<> motion;
  const auto run = simulate(motion, noisy, {.rate = 100, .seed = 3, .start = 0.0, .end = 2.0});
  using Iterator = decltype(run.begin());
  STATIC_CHECK(std::is_same_v<std::iterator_traits<Iterator>::iterator_category, std::input_iterator_tag>);
  STATIC_CHECK(std::is_same_v<Iterator, decltype(run.end())>);
  STATIC_CHECK(std::ranges::input_range<decltype(run)>);
  STATIC_CHECK(std::ranges::common_range<decltype(run)>);

  const std::vector<ImuReading> readings(run.begin(), run.end());
  const std::vector<ImuSample<>> samples(run.begin(), run.end());  // without the biases
  const std::list<ImuReading> list(run.begin(), run.end());
  CHECK(readings.size() == 201);
  CHECK(samples.size() == 201);
  CHECK(list.size() == 201);
  CHECK(std::distance(run.begin(), run.end()) == 201);
  std::size_t i = 0;
  for (const ImuReading& r : run) {
    CHECK(readings[i].gyro == r.gyro);
    CHECK(samples[i].time == r.time);
    CHECK(samples[i].accel == r.accel);
    ++i;
  }
  CHECK(std::count_if(run.begin(), run.end(), [](const ImuReading& r) { return r.time < 1; }) == 100);
#ifdef __cpp_lib_ranges  // not in libc++ 14
  CHECK(std::ranges::count_if(run, [](const ImuReading& r) { return r.time < 1; }) == 100);
#endif
}

TEST_CASE("Iterators advance one by one, return what was before, and begin again") {
  const auto run = simulate(Ellipse<>{}, noisy, {.rate = 10, .seed = 3, .start = 0.0, .end = 0.2});
  auto at = run.begin();
  const ImuReading first = *at, before = *at++;
  CHECK(before.gyro == first.gyro);
  CHECK(at->time == 0.1);
  auto copy = at;
  CHECK((++copy)->time == 0.2);
  CHECK(at->time == 0.1);
  CHECK(++copy == run.end());
  CHECK(run.begin()->gyro == first.gyro);
  CHECK(decltype(run)::Iterator{} == run.end());
}

TEST_CASE("to_vector copies a range, or converts its elements") {
  const Ellipse<> motion;
  const Imu lossy{ErrorModel{}, ErrorModel{}, ErrorModel{DroppedSamples{0.5}}};
  const auto run = simulate(motion, lossy, {.rate = 100, .seed = 1, .start = 0.0, .end = 10.0});
  const auto readings = to_vector(run);
  STATIC_CHECK(std::is_same_v<decltype(readings), const std::vector<StampedImuReading<>>>);
  CHECK(readings.size() < run.size());
  const auto samples =
      to_vector<ImuSample<>>(simulate(motion, lossy, {.rate = 100, .seed = 1, .start = 0.0, .end = 10.0}));
  STATIC_CHECK(std::is_same_v<decltype(samples), const std::vector<ImuSample<>>>);
  CHECK(std::equal(readings.begin(), readings.end(), samples.begin(), samples.end(),
                   [](const auto& a, const auto& b) { return a.time == b.time; }));
  CHECK(to_vector(std::vector<int>{1, 2}) == std::vector<int>{1, 2});
}

TEST_CASE("The samples of sample_imu have their times and are samples like others") {
  testing::Random random(2);
  using std::chrono::nanoseconds;
  const Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>> curve(
      {.start = nanoseconds(5), .interval = nanoseconds(100'000'000)}, random.walk<SO3xR3<double>>(12));
  const auto dense = sample_imu(curve, nanoseconds(5), nanoseconds(1'000'000), 300);
  const auto samples = to_vector<ImuSample<double, nanoseconds>>(dense);
  REQUIRE(samples.size() == 300);
  CHECK(samples[7].time == nanoseconds(7'000'005));
  CHECK(samples[7].gyro == dense[7].gyro);
  ImuSamplesOf<decltype(curve)> part;
  sample_imu(curve, SampleTimes{nanoseconds(5), nanoseconds(1'000'000)}, 100, 50, part, standard_gravity<double>());
  CHECK(part[3].time == nanoseconds(103'000'005));
  CHECK(part[3].accel == dense[103].accel);
}
