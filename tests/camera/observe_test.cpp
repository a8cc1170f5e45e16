// SPDX-License-Identifier: MIT
#define EIGEN_RUNTIME_NO_MALLOC
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <splinertia/camera/observe.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/spline/spline.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

namespace {

constexpr double delay = 62.5e-6;
constexpr ImageSize size{752, 480};
const Sophus::SE3d T_BC(Sophus::SO3d::exp({0.4, -0.8, 1.1}), Eigen::Vector3d(0.1, 0.05, -0.02));
const Pinhole perspective{458.654, 457.296, 367.215, 248.375, NoDistortion<double>{}};
const Pinhole distorted{458.654, 457.296, 367.215, 248.375, RadialTangential{-0.28340811, 0.07395907, 0.00019, 1.8e-5}};
const Pinhole fisheye{250.0, 250.0, 367.215, 248.375, Equidistant{-0.1, 0.02, -0.01, 0.001}};

template <typename G, TimePoint Time = double>
auto walk(double step, double seconds, Time start = Time(0)) {
  testing::Random random(7);
  std::vector<G> points{GroupTraits<G>::identity()};
  while (points.size() < 40) {
    points.push_back(GroupTraits<G>::compose(points.back(), GroupTraits<G>::exp(random.tangent<G>(step))));
  }
  return Spline<G, 4, UniformKnots<Time>>({start, after(Time(0), seconds)}, points);
}

template <typename Pose>
Sophus::SE3<ScalarOf<Pose>> rigid(const Pose& pose) {
  return {rotation(pose), position(pose)};
}

/// The projection of a landmark `offset` s after the time `start`.
template <typename Camera>
auto projection(const auto& curve, const Camera& camera, const auto& landmark, double start, double offset) {
  const auto T_WC = rigid(curve.template evaluate<0>(start + offset).value) * camera.T_BC();
  return camera.model().project(T_WC.inverse() * landmark);
}

/// How often the row of a landmark passes the row that is read, counted at many rows.
int count_of_rows(const auto& curve, const auto& camera, const Eigen::Vector3d& landmark, double start) {
  const double line_delay = camera.shutter().line_delay, height = camera.size().height;
  const double first = line_delay < 0 ? height - 1 : 0;
  int count = 0;
  double before = 0, u_before = 0;
  bool was_valid = false;
  for (int i = 0; i <= 2400; ++i) {
    const double row = i * height / 2400;
    const auto pixel = projection(curve, camera, landmark, start, (row - first) * line_delay);
    const double excess = pixel ? row - pixel->y() : 0;
    if (pixel && was_valid && (excess < 0) != (before < 0)) {
      const double u = u_before + before / (before - excess) * (pixel->x() - u_before);
      if (u >= 0 && u < camera.size().width) ++count;
    }
    was_valid = pixel.has_value();
    before = excess;
    if (pixel) u_before = pixel->x();
  }
  return count;
}

/// A landmark near the view of the camera at a time.
Eigen::Vector3d landmark_near(const auto& curve, const auto& camera, double t, testing::Random& random, double range) {
  const auto ray = camera.model().unproject({376 + 600 * random.symmetric(), 240 + 390 * random.symmetric()});
  const double distance = range * (1.1 + random.symmetric());
  const Eigen::Vector3d sideways(random.symmetric(), random.symmetric(), random.symmetric());
  return rigid(curve.template evaluate<0>(t).value) *
         (camera.T_BC() * Eigen::Vector3d(ray ? *ray * distance : sideways));
}

void check_against_counting(const auto& curve, const auto& camera, int landmarks, double range) {
  testing::Random random(11);
  const double length = std::abs(camera.shutter().line_delay) * camera.size().height;
  for (int i = 0; i < landmarks; ++i) {
    const double t =
        curve.start() + 0.001 + (curve.end() - curve.start() - length - 0.002) * (random.symmetric() + 1) / 2;
    const auto landmark = landmark_near(curve, camera, t + length / 2, random, range);
    const auto found = observe(curve, camera, landmark, t);
    INFO("landmark " << i << " at " << t);
    CHECK(static_cast<int>(found.size()) == count_of_rows(curve, camera, landmark, t));
    double last = -1;
    for (const auto& o : found) {
      const auto pixel = projection(curve, camera, landmark, t, o.row_offset);
      REQUIRE(pixel);
      CHECK((*pixel - o.pixel).norm() < 1e-9);
      CHECK(o.time == t + o.row_offset);
      CHECK(o.row_offset > last);
      CHECK(camera.sees(o.pixel));
      last = o.row_offset;
    }
  }
}

/// Pitch at a rate about the camera's x axis.
ConstantTwist<Sophus::SE3d> pitching(double rate) {
  ConstantTwist<Sophus::SE3d> motion;
  motion.twist << 0, 0, 0, rate, 0, 0;
  return motion;
}

}  // namespace

TEMPLATE_TEST_CASE("All rows are found on moving splines", "", SO3xR3<double>, Sophus::SE3d) {
  for (const double step : {0.05, 0.5, 4.0}) {
    const auto curve = walk<TestType>(step, 0.1);
    CAPTURE(step);
    check_against_counting(curve, Camera{perspective, size, T_BC, RollingShutter{delay}}, 40, 10);
    check_against_counting(curve, Camera{distorted, size, T_BC, RollingShutter{delay}}, 40, 1);
    check_against_counting(curve, Camera{fisheye, size, T_BC, RollingShutter{-delay, BottomRow{}}}, 40, 1);
  }
}

TEST_CASE("All rows are found on a vibrating body, whose knots are denser than a frame") {
  const auto curve = walk<Sophus::SE3d>(0.3, 0.004);
  check_against_counting(curve, Camera{distorted, size, T_BC, RollingShutter{delay}}, 100, 10);
}

TEST_CASE("All rows are found along an analytic motion") {
  struct Lap : Circle<> {
    static double start() { return 0; }
    static double end() { return 6; }
  };
  const Sophus::SE3d ahead(Sophus::SO3d(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5)), Eigen::Vector3d::Zero());
  check_against_counting(Lap{}, Camera{distorted, size, ahead, RollingShutter{delay}}, 50, 3);
}

TEST_CASE("A landmark is seen twice while the image moves faster than the rows") {
  const Camera camera{perspective, size, Sophus::SE3d(), RollingShutter{delay}};
  // Pitch at 30 rad/s moves the image by 457 · 30 · 62.5e-6 = 0.86 rows per row in the middle, by 1.1 at its ends.
  const auto motion = pitching(30);
  int twice = 0;
  for (double y = -7; y < 1; y += 0.02) {
    const Eigen::Vector3d landmark(1, y, 10);
    const auto found = observe(motion, camera, landmark, 0.0);
    CHECK(static_cast<int>(found.size()) == count_of_rows(motion, camera, landmark, 0.0));
    twice += found.size() == 2;
  }
  CHECK(twice > 0);
}

TEST_CASE("Two rows that fall together are both found, or none is") {
  const Camera camera{perspective, size, Sophus::SE3d(), RollingShutter{delay}};
  const auto motion = pitching(30);
  const auto at = [&](double y) { return observe(motion, camera, Eigen::Vector3d(1, y, 10), 0.0); };
  double low = -12, high = -12;
  REQUIRE(at(low).empty());
  while (at(high).empty()) high += 0.01;
  REQUIRE(at(high).size() == 2);
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    const auto count = at(middle).size();
    CHECK((count == 0 || count == 2));
    (count == 0 ? low : high) = middle;
  }
  REQUIRE(at(high).size() == 2);
  CHECK(at(high)[1].pixel.y() - at(high)[0].pixel.y() < 1e-4);
}

TEST_CASE("A landmark may enter the model's domain, or leave it, while the rows are read") {
  // Its domain is a circle of 105 pixels inside the image.
  const Pinhole narrow{150.0, 150.0, 376.0, 240.0, Equidistant{-0.3, 0.0, 0.0, 0.0}};
  const Camera camera{narrow, size, Sophus::SE3d(), RollingShutter{delay}};
  testing::Random random(4);
  int entered = 0;
  for (int i = 0; i < 400; ++i) {
    ConstantTwist<Sophus::SE3d> motion;
    motion.twist.tail<3>() << 2 * random.symmetric(), 20 * random.symmetric(), 2 * random.symmetric();
    const double angle = 2 * random.symmetric();
    const Eigen::Vector3d landmark(std::sin(angle), random.symmetric(), std::cos(angle));
    const auto found = observe(motion, camera, landmark, 0.0);
    INFO("landmark " << i);
    CHECK(static_cast<int>(found.size()) == count_of_rows(motion, camera, landmark, 0.0));
    const auto outside = [&](double row) { return !projection(motion, camera, landmark, 0, row * delay); };
    entered += !found.empty() && (outside(0) || outside(480));
  }
  CHECK(entered > 10);
}

TEST_CASE("A landmark may pass close to the camera while the rows are read") {
  const Pinhole wide{250.0, 250.0, 367.215, 248.375, Equidistant{-0.01, 0.02, -0.01, 0.001}};
  const Camera camera{wide, size, Sophus::SE3d(), RollingShutter{delay}};
  testing::Random random(6);
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    ConstantTwist<Sophus::SE3d> motion;
    motion.twist.head<3>() << 30 * random.symmetric(), 30 * random.symmetric(), 30 * random.symmetric();
    const Eigen::Vector3d at_middle(0.3 * random.symmetric(), 0.3 * random.symmetric(), 0.3 * random.symmetric());
    const Eigen::Vector3d landmark = motion.evaluate<0>(0.015).value * at_middle;
    const auto found = observe(motion, camera, landmark, 0.0);
    INFO("landmark " << i);
    CHECK(static_cast<int>(found.size()) == count_of_rows(motion, camera, landmark, 0.0));
    seen += !found.empty();
  }
  CHECK(seen > 30);
}

TEST_CASE("With a global shutter a landmark is seen where it is at the time of the frame") {
  const auto curve = walk<SO3xR3<double>>(0.5, 0.1);
  const Camera camera{distorted, size, T_BC};
  testing::Random random(3);
  int seen = 0;
  for (int i = 0; i < 100; ++i) {
    const auto landmark = landmark_near(curve, camera, 1.5, random, 5);
    const auto found = observe(curve, camera, landmark, 1.5);
    const auto pixel = projection(curve, camera, landmark, 1.5, 0);
    REQUIRE(found.size() == (pixel && camera.sees(*pixel) ? 1 : 0));
    for (const auto& o : found) {
      CHECK((o.pixel - *pixel).norm() < 1e-12);
      CHECK(o.time == 1.5);
      CHECK(o.row_offset == 0);
      ++seen;
    }
    // A rolling shutter whose rows are all read at once is the same.
    const auto at_once = observe(curve, Camera{distorted, size, T_BC, RollingShutter{0.0}}, landmark, 1.5);
    REQUIRE(at_once.size() == found.size());
    if (!found.empty()) CHECK((at_once[0].pixel - found[0].pixel).norm() < 1e-12);
  }
  CHECK(seen > 20);
}

TEST_CASE("A camera at rest sees rows from 0 to below the height, each when it is read") {
  const auto still = at_rest(Sophus::SE3d());
  const Pinhole unit{1.0, 1.0, 0.0, 0.0, NoDistortion<double>{}};
  const Camera camera{unit, size, Sophus::SE3d(), RollingShutter{delay}};
  for (const double row : {0.0, 1e-300, 17.25, 479.9999}) {
    const auto found = observe(still, camera, Eigen::Vector3d(5, row, 1), 3.0);
    REQUIRE(found.size() == 1);
    CHECK(found.front().pixel == Eigen::Vector2d(5, row));
    CHECK(found.front().row_offset == row * delay);
    CHECK(found.front().time == 3.0 + row * delay);
  }
  CHECK(observe(still, camera, Eigen::Vector3d(5, 480, 1), 3.0).empty());
  CHECK(observe(still, camera, Eigen::Vector3d(5, -1e-9, 1), 3.0).empty());
  CHECK(observe(still, camera, Eigen::Vector3d(752, 7, 1), 3.0).empty());
  CHECK(observe(still, camera, Eigen::Vector3d(5, 7, -1), 3.0).empty());
}

TEST_CASE("A landmark that is not finite, or at the camera, is not seen") {
  const auto curve = walk<Sophus::SE3d>(0.5, 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto none = [&](const auto& camera) {
    for (const double bad : {nan, infinity, -infinity}) {
      CHECK(observe(curve, camera, Eigen::Vector3d(bad, 0, 1), 1.0).empty());
      CHECK(observe(curve, camera, Eigen::Vector3d(0, 0, bad), 1.0).empty());
    }
    const Eigen::Vector3d centre = (rigid(curve.evaluate<0>(1.0).value) * camera.T_BC()).translation();
    for (const auto& o : observe(curve, camera, centre, 1.0)) CHECK(o.pixel.allFinite());
    for (const auto& o : observe(curve, camera, Eigen::Vector3d(1e300, 1e300, 1e300), 1.0)) CHECK(o.pixel.allFinite());
  };
  none(Camera{distorted, size, T_BC, RollingShutter{delay}});
  none(Camera{distorted, size, T_BC});
}

TEST_CASE("The stamp of a frame moves the rows as its type says") {
  const auto curve = walk<Sophus::SE3d>(0.5, 0.1);
  const Eigen::Vector3d landmark = rigid(curve.evaluate<0>(1.01).value) * (T_BC * Eigen::Vector3d(0.2, 0.5, 5));
  const auto row_of = [&](const auto& shutter, double t) {
    const auto found = observe(curve, Camera{perspective, size, T_BC, shutter}, landmark, t);
    REQUIRE(found.size() == 1);
    return found[0];
  };
  const auto top = row_of(RollingShutter{delay}, 1.0);
  const auto same = [&](const auto& other) {
    CHECK((other.pixel - top.pixel).norm() < 1e-10);
    CHECK(std::abs(other.time - top.time) < 1e-14);
  };
  same(row_of(RollingShutter{delay, MiddleRow{}}, 1.0 + 239.5 * delay));
  same(row_of(RollingShutter{delay, BottomRow{}}, 1.0 + 479 * delay));
  same(row_of(RollingShutter{delay, ExposureStart{0.004}}, 1.0 - 0.002));
  const auto up = row_of(RollingShutter{-delay, BottomRow{}}, 1.0);
  CHECK(std::abs(up.row_offset - (479 - up.pixel.y()) * delay) < 1e-16);
}

TEST_CASE("Stamps in nanoseconds since 1970 lose nothing") {
  using std::chrono::nanoseconds;
  const nanoseconds epoch(1'403'636'579'763'555'584);
  const auto near_zero = walk<SO3xR3<double>>(2, 0.1);
  const auto since_1970 = walk<SO3xR3<double>, nanoseconds>(2, 0.1, epoch);
  const Camera camera{distorted, size, T_BC, RollingShutter{29.4567891234e-6}};
  testing::Random random(5);
  int seen = 0;
  for (int i = 0; i < 50; ++i) {
    const nanoseconds t(1'000'000'000 + 17 * i);
    const double seconds = 1e-9 * static_cast<double>(t.count());
    const auto landmark = landmark_near(near_zero, camera, seconds + 0.007, random, 5);
    const auto fine = observe(near_zero, camera, landmark, seconds);
    const auto ticks = observe(since_1970, camera, landmark, epoch + t);
    REQUIRE(ticks.size() == fine.size());
    for (std::size_t k = 0; k < fine.size(); ++k) {
      CHECK((ticks[k].pixel - fine[k].pixel).norm() < 1e-10);
      CHECK(std::abs(ticks[k].row_offset - fine[k].row_offset) < 1e-14);
      CHECK(std::abs(static_cast<double>((ticks[k].time - epoch - t).count()) - 1e9 * ticks[k].row_offset) <= 0.5);
      ++seen;
    }
  }
  CHECK(seen > 10);
}

TEMPLATE_TEST_CASE("Any scalar", "", float, double, long double) {
  using Scalar = TestType;
  using SE3 = Sophus::SE3<Scalar>;
  ConstantTwist<SE3> motion;
  motion.twist << Scalar(0.5), Scalar(-0.2), Scalar(1), Scalar(2), Scalar(1), Scalar(-3);
  const Camera camera{Pinhole{Scalar(458), Scalar(457), Scalar(367), Scalar(248), Equidistant<Scalar>{0, 0, 0, 0}},
                      size, SE3(), RollingShutter{Scalar(3e-5)}};
  const auto found = observe(motion, camera, Eigen::Vector3<Scalar>(Scalar(0.3), Scalar(-0.2), 4), Scalar(0));
  REQUIRE(found.size() == 1);
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  const auto pose = motion.template evaluate<0>(found[0].row_offset).value;
  const auto pixel = camera.model().project(pose.inverse() * Eigen::Vector3<Scalar>(Scalar(0.3), Scalar(-0.2), 4));
  REQUIRE(pixel);
  CHECK((*pixel - found[0].pixel).norm() < 2000 * eps);
  CHECK(std::abs(found[0].pixel.y() * Scalar(3e-5) - found[0].row_offset) <= eps * Scalar(0.015));
}

TEST_CASE("A frame observes many landmarks as observe() does one, without heap") {
  const auto curve = walk<SO3xR3<double>>(2, 0.1);
  const Camera rolling{distorted, size, T_BC, RollingShutter{delay}};
  const Camera global{distorted, size, T_BC};
  testing::Random random(9);
  std::vector<Eigen::Vector3d> landmarks;
  for (int i = 0; i < 50; ++i) landmarks.push_back(landmark_near(curve, rolling, 1.02, random, 3));
  const auto compare = [&](const auto& camera) {
    const FrameObserver frame(curve, camera, 1.0);
    for (const auto& landmark : landmarks) {
      const auto one = observe(curve, camera, landmark, 1.0), shared = frame(landmark);
      REQUIRE(one.size() == shared.size());
      for (std::size_t i = 0; i < one.size(); ++i) CHECK(one[i].pixel == shared[i].pixel);
    }
    std::size_t seen = 0;
    CHECK(testing::allocations_of([&] {
            for (const auto& landmark : landmarks) seen += observe(curve, camera, landmark, 1.0).size();
          }) == 0);
    CHECK(seen > 5);
  };
  compare(rolling);
  compare(global);
  using Rolling = std::remove_const_t<decltype(rolling)>;
  using Frame = FrameObserver<std::remove_const_t<decltype(curve)>, Rolling>;
  STATIC_CHECK(std::is_constructible_v<Frame, decltype(curve)&, const Rolling&, double>);
  STATIC_CHECK_FALSE(std::is_constructible_v<Frame, decltype(curve)&, Rolling, double>);
  STATIC_CHECK_FALSE(std::is_constructible_v<Frame, std::remove_const_t<decltype(curve)>, const Rolling&, double>);
}

TEST_CASE("A region hides what is outside it") {
  const auto still = at_rest(Sophus::SE3d());
  const Pinhole unit{1.0, 1.0, 0.0, 0.0, NoDistortion<double>{}};
  const Camera camera{unit, size, Sophus::SE3d(), RollingShutter{delay}, ImageCircle{376.0, 240.0, 200.0}};
  CHECK(observe(still, camera, Eigen::Vector3d(376, 50, 1), 0.0).size() == 1);
  CHECK(observe(still, camera, Eigen::Vector3d(376, 30, 1), 0.0).empty());
}

TEST_CASE("A frame outside the curve is refused") {
  const auto curve = walk<Sophus::SE3d>(0.5, 0.1);
  const Eigen::Vector3d landmark(0, 0, 5);
  const Camera rolling{distorted, size, T_BC, RollingShutter{delay}};
  CHECK_NOTHROW(observe(curve, rolling, landmark, curve.end() - 0.0301));
  CHECK_THROWS_AS(observe(curve, rolling, landmark, curve.end() - 0.0299), std::out_of_range);
  CHECK_THROWS_AS(observe(curve, rolling, landmark, -1e-9), std::out_of_range);
  CHECK_THROWS_AS(observe(curve, rolling, landmark, std::numeric_limits<double>::quiet_NaN()), std::out_of_range);
  const Camera global{distorted, size, T_BC};
  CHECK_NOTHROW(observe(curve, global, landmark, curve.end()));
  try {
    (void)observe(curve, global, landmark, 4.0);
    FAIL("nothing thrown");
  } catch (const std::out_of_range& error) {
    CHECK(std::string(error.what()) == "observe: a row is read at time 4, but the curve is defined from 0 to 3.7");
  }
}
