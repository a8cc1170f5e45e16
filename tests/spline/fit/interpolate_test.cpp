// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/fit/interpolate.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;
using testing::message_of;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
using Even4 = Spline<SO3xR3<double>, 4>;
using Even6 = Spline<SO3xR3<double>, 6>;
using Free4 = Spline<SO3xR3<double>, 4, NonUniformKnots<double>>;
using Rigid4 = Spline<Sophus::SE3d, 4, NonUniformKnots<nanoseconds>>;
using Line4 = Spline<Number, 4, NonUniformKnots<double>>;
using Line6 = Spline<Number, 6, NonUniformKnots<double>>;
using Line8 = Spline<Number, 8, NonUniformKnots<double>>;
using EvenLine4 = Spline<Number, 4>;
using EvenLine6 = Spline<Number, 6>;

/// A random walk at times 0.1 s apart: evenly, or with the intervals multiplied by up to `ratio`. Control points swing
/// several times as far as such poses do, those outside clamped ends of order 6 fifty times, and have to stay below π.
template <typename Curve>
PosesOf<Curve> some_poses(std::size_t count, double ratio = 1, double step = 0.15) {
  using Time = typename Curve::Time;
  testing::Random random(count);
  PosesOf<Curve> poses;
  double t = 2;
  for (const auto& x : random.walk<typename Curve::Group>(count, step)) {
    if constexpr (std::floating_point<Time>) {
      poses.push_back({static_cast<Time>(t), x});
    } else {
      poses.push_back({after(Time(1'403'715'524'907'143'168), t), x});
    }
    t += 0.1 * std::pow(ratio, 0.5 + 0.5 * random.symmetric());
  }
  return poses;
}

template <typename Curve>
double largest_miss(const Curve& curve, const PosesOf<Curve>& poses) {
  double largest = 0;
  for (const auto& pose : poses) {
    const auto at = std::clamp(pose.time, curve.start(), curve.end());
    const auto off = increment<typename Curve::Group>(pose.value, curve.template evaluate<0>(at).value).norm();
    largest = std::max(largest, static_cast<double>(off));
  }
  return largest;
}

PosesOf<Line4> values_at(const std::vector<double>& times, const auto& f) {
  PosesOf<Line4> poses;
  for (const double t : times) poses.push_back({t, Number(f(t))});
  return poses;
}

const std::vector<double> uneven{0, 0.3, 1, 1.1, 2, 2.7, 3.1, 4.6, 5, 5.2, 6};

}  // namespace

TEMPLATE_TEST_CASE("The curve passes through every pose, with any ends", "", Even4, Even6, Free4, Rigid4, Line6,
                   Line8) {
  for (const auto condition : {EndCondition::natural, EndCondition::clamped, EndCondition::not_a_knot}) {
    for (const std::size_t count : {9UL, 40UL}) {
      INFO("condition " << static_cast<int>(condition) << ", " << count << " poses");
      const bool even = requires(const KnotsOf<TestType>& knots) { knots.interval; };
      const auto poses = some_poses<TestType>(count, even ? 1 : 8, TestType::order == 4 ? 0.15 : 0.02);
      const TestType curve = interpolate<TestType>(poses, {.condition = condition});
      CHECK(largest_miss(curve, poses) < 1e-9);
      CHECK(curve.start() == poses.front().time);
      CHECK(curve.end() >= poses.back().time);
    }
  }
}

TEST_CASE("Order four is smooth to the second derivative across the poses") {
  const auto check = [](const auto& curve, const auto& poses) {
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
      const auto before = curve.template evaluate<2>(std::nextafter(poses[i].time, 0.0));
      const auto at = curve.template evaluate<2>(poses[i].time);
      const double size = 1 + at.acceleration.norm();
      CHECK((before.velocity - at.velocity).norm() < 1e-12 * size);
      CHECK((before.acceleration - at.acceleration).norm() < 1e-11 * size);
    }
  };
  const auto poses = some_poses<Free4>(15, 8);
  check(interpolate<Free4>(poses), poses);
  const auto even = some_poses<Even4>(15);
  check(interpolate<Even4>(even), even);
}

TEST_CASE("Natural ends do not accelerate, clamped ones have the velocity that is given") {
  using Six = Tangent<SO3xR3<double>>;
  testing::Random random(2);
  const Six start = random.tangent<SO3xR3<double>>(), end = random.tangent<SO3xR3<double>>();
  const auto check = [&]<typename Curve>() {
    const auto poses = some_poses<Curve>(12);
    const Curve natural = interpolate<Curve>(poses);
    // Beside 0.15/0.1² otherwise.
    CHECK(natural.template evaluate<2>(natural.start()).acceleration.norm() < 1e-9);
    CHECK(natural.template evaluate<2>(natural.end()).acceleration.norm() < 1e-9);
    const Curve clamped =
        interpolate<Curve>(poses, {.condition = EndCondition::clamped, .start_velocity = start, .end_velocity = end});
    CHECK((clamped.template evaluate<1>(clamped.start()).velocity - start).norm() < 1e-10);
    CHECK((clamped.template evaluate<1>(clamped.end()).velocity - end).norm() < 1e-10);
    const Curve resting = interpolate<Curve>(poses, {.condition = EndCondition::clamped});
    CHECK(resting.template evaluate<1>(resting.start()).velocity.norm() < 1e-10);
  };
  check.operator()<Even4>();
  check.operator()<Free4>();
  // Of order 6, natural: derivatives 3 and 4 are zero; clamped: the velocity and a second derivative of zero.
  const auto poses = some_poses<Even6>(12, 1, 0.02);
  const auto natural = interpolate<Even6>(poses);
  CHECK(natural.evaluate<3>(natural.start()).jerk.tail<3>().norm() < 1e-7);  // of 10³ otherwise
  const auto clamped = interpolate<Even6>(
      poses, {.condition = EndCondition::clamped, .start_velocity = start / 10, .end_velocity = end / 10});
  CHECK((clamped.evaluate<2>(clamped.end()).velocity - end / 10).norm() < 1e-10);
  CHECK(clamped.evaluate<2>(clamped.end()).acceleration.norm() < 1e-8);
}

TEST_CASE("Not-a-knot reproduces the polynomial of the order") {
  const auto cubic = [](double t) { return 2 - t + 0.5 * t * t - 0.1 * t * t * t; };
  const auto quintic = [&](double t) { return cubic(t) + 0.02 * t * t * t * t - 0.003 * t * t * t * t * t; };
  const std::vector<double> even{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6};
  const auto check = [](const auto& curve, const auto& f) {
    for (double t = 0; t <= 6; t += 0.125) CHECK_THAT(curve.template evaluate<0>(t).value[0], WithinAbs(f(t), 1e-9));
  };
  const CurveEnds<Number> ends{.condition = EndCondition::not_a_knot};
  check(interpolate<Line4>(values_at(uneven, cubic), ends), cubic);
  check(interpolate<EvenLine4>(values_at(even, cubic), ends), cubic);
  check(interpolate<Line6>(values_at(uneven, quintic), ends), quintic);
  check(interpolate<EvenLine6>(values_at(even, quintic), ends), quintic);
}

TEST_CASE("The natural cubic of R is that of the textbook") {
  const auto f = [](double t) { return std::sin(1.3 * t) + 0.2 * t * t; };
  const auto poses = values_at(uneven, f);
  const Line4 curve = interpolate<Line4>(poses);
  // Second derivatives m at the poses: h_{i−1} m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_i m_{i+1} = 6 (s_i − s_{i−1}).
  const auto n = static_cast<Eigen::Index>(poses.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  const auto x = [&](Eigen::Index i) { return poses[static_cast<std::size_t>(i)].time; };
  const auto y = [&](Eigen::Index i) { return poses[static_cast<std::size_t>(i)].value[0]; };
  A(0, 0) = A(n - 1, n - 1) = 1;
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const double before = x(i) - x(i - 1), behind = x(i + 1) - x(i);
    A(i, i - 1) = before;
    A(i, i) = 2 * (before + behind);
    A(i, i + 1) = behind;
    b[i] = 6 * ((y(i + 1) - y(i)) / behind - (y(i) - y(i - 1)) / before);
  }
  const Eigen::VectorXd m = A.partialPivLu().solve(b);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const double h = x(i + 1) - x(i);
    for (const double u : {0.0, 0.2, 0.5, 0.9}) {
      const double w = 1 - u;
      const double value = w * y(i) + u * y(i + 1) + h * h / 6 * ((w * w * w - w) * m[i] + (u * u * u - u) * m[i + 1]);
      const auto got = curve.evaluate<2>(x(i) + u * h);
      CHECK_THAT(got.value[0], WithinAbs(value, 1e-12));
      CHECK_THAT(got.acceleration[0], WithinAbs(w * m[i] + u * m[i + 1], 1e-9));
    }
  }
}

TEST_CASE("Stamps may be a thousand times further apart than others") {
  const auto poses = some_poses<Free4>(30, 4000, 0.2);
  double shortest = 1e9, longest = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    shortest = std::min(shortest, poses[i].time - poses[i - 1].time);
    longest = std::max(longest, poses[i].time - poses[i - 1].time);
  }
  REQUIRE(longest / shortest > 1000);
  // Steps of the same size in a thousandth of the time: speeds that carry on into the long intervals, which on R³ is a
  // matter of numbers alone.
  using Space4 = Spline<Eigen::Vector3d, 4, NonUniformKnots<double>>;
  PosesOf<Space4> positions;
  for (const auto& pose : poses) positions.push_back({pose.time, pose.value.get<1>()});
  for (const auto condition : {EndCondition::natural, EndCondition::clamped, EndCondition::not_a_knot}) {
    CHECK(largest_miss(interpolate<Space4>(positions, {.condition = condition}), positions) < 1e-9);
  }
  // Of rotations, as long as the speed is bounded.
  PosesOf<Free4> slow;
  for (const auto& pose : poses) {
    const double s = 3 * (pose.time - poses.front().time) / (poses.back().time - poses.front().time);
    slow.push_back({pose.time,
                    {Sophus::SO3d::exp(Eigen::Vector3d(std::sin(s), 0.5 * s, std::cos(2 * s))),
                     Eigen::Vector3d(s, s * s, std::sin(s))}});
  }
  for (const auto condition : {EndCondition::natural, EndCondition::clamped, EndCondition::not_a_knot}) {
    CHECK(largest_miss(interpolate<Free4>(slow, {.condition = condition}), slow) < 1e-9);
  }
}

TEST_CASE("Two poses") {
  const auto poses = some_poses<Free4>(2);
  const Free4 curve = interpolate<Free4>(poses);
  CHECK(largest_miss(curve, poses) < 1e-12);
  const Free4 clamped = interpolate<Free4>(poses, {.condition = EndCondition::clamped});
  CHECK(largest_miss(clamped, poses) < 1e-12);
  const auto even = some_poses<Even6>(2);
  CHECK(largest_miss(interpolate<Even6>(even), even) < 1e-9);
  // The straight way, evenly: there is nothing to accelerate for.
  const auto middle = curve.evaluate<2>(0.5 * (curve.start() + curve.end()));
  CHECK(middle.acceleration.tail<3>().norm() < 1e-9);
}

TEST_CASE("Turns that are too large are refused, or the curve is right, never neither") {
  int found = 0, refused = 0;
  for (const double turn : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.1, 3.14}) {
    INFO("turns of " << turn);
    testing::Random random(4);
    PosesOf<Free4> poses;
    Sophus::SO3d rotation;
    for (int i = 0; i < 12; ++i) {
      poses.push_back({0.1 * i, {rotation, Eigen::Vector3d::Zero()}});
      rotation *= Sophus::SO3d::exp(turn * random.tangent<Sophus::SO3d>().normalized());
    }
    try {
      const Free4 curve = interpolate<Free4>(poses);
      CHECK(largest_miss(curve, poses) < 1e-9);
      ++found;
    } catch (const std::runtime_error& error) {
      CHECK(std::string(error.what())
                .starts_with("interpolate: no curve found through all poses, the best is off by up to "));
      ++refused;
    }
  }
  CHECK(found >= 2);    // 0.5 and 1
  CHECK(refused >= 1);  // of half turns in all directions the control points are undefined
}

TEST_CASE("Float and long double") {
  using FloatCurve = Spline<SO3xR3<float>, 4>;
  using LongCurve = Spline<SO3xR3<long double>, 4, NonUniformKnots<nanoseconds>>;
  const auto floats = some_poses<FloatCurve>(20);
  CHECK(largest_miss(interpolate<FloatCurve>(floats), floats) < 1e-5);
  const auto longs = some_poses<LongCurve>(20, 8);
  CHECK(largest_miss(interpolate<LongCurve>(longs), longs) < 1e-15);
}

TEST_CASE("Poses that no such curve passes through are refused with the reason") {
  const auto good = some_poses<Even4>(10);
  const auto why = [](const PosesOf<Even4>& poses, EndCondition condition = EndCondition::natural) {
    return message_of([&] { return interpolate<Even4>(poses, {.condition = condition}); });
  };
  CHECK(why(good) == "nothing thrown");
  auto bad = good;
  bad[4].time += 0.04;
  CHECK(why(bad).find("interpolate: pose 4 is 0.04") == 0);
  CHECK(why(bad).find("expected evenly spaced poses for UniformKnots; use NonUniformKnots") != std::string::npos);
  bad = good;
  bad[3].time = bad[2].time;
  CHECK(why(bad) == "interpolate: pose 3 is at time 2.2, expected a time after 2.2, that of the pose before it");
  bad = good;
  bad[5].value.get<1>().x() = std::nan("");
  CHECK(why(bad) == "interpolate: pose 5 is not finite");
  CHECK(why({}) == "interpolate: 0 poses, expected at least 2");
  CHECK(why({good[0]}) == "interpolate: 1 poses, expected at least 2");
  CHECK(why({good[0], good[1], good[2]}, EndCondition::not_a_knot) == "interpolate: 3 poses, expected at least 4");
}
