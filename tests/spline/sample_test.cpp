// SPDX-License-Identifier: MIT
#include <splinertia/spline/sample.hpp>

#include <chrono>
#include <random>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

/// A curve of 12 segments of 0.25 s with increments of up to 1 rad and some metres, one of which is zero; knots at odd
/// places, some of them double, where they are not uniform.
template <typename G, int Order, typename K>
Spline<G, Order, K> random_curve() {
  using Scalar = ScalarOf<G>;
  std::mt19937_64 bits(7);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  std::vector<G> points{GroupTraits<G>::identity()};
  for (int i = 1; i < 11 + Order; ++i) {
    Tangent<G> tau;
    for (int k = 0; k < tau.size(); ++k) tau[k] = i == 5 ? Scalar(0) : static_cast<Scalar>(uniform(bits));
    points.push_back(GroupTraits<G>::compose(points.back(), GroupTraits<G>::exp(tau)));
  }
  if constexpr (requires { K::knots; }) {
    K knots;
    using Time = typename K::Time;
    for (int i = 0; i < 11 + 2 * Order; ++i) {
      const double place = 0.25 * (i - Order + 1) + (Order > 2 && i % 4 == 0 ? 0.25 : 0.0) + (i % 3 == 0 ? 0.01 : 0.0);
      knots.knots.push_back(after(Time{}, place));
    }
    std::sort(knots.knots.begin(), knots.knots.end());
    return {knots, points};
  } else if constexpr (std::floating_point<typename K::Time>) {
    return {K{static_cast<typename K::Time>(-0.5), static_cast<typename K::Time>(0.25)}, points};
  } else {
    return {K{nanoseconds(1'700'000'000'123'456'789), nanoseconds(250'000'000)}, points};
  }
}

template <typename G>
auto numbers(const G& x) {
  Eigen::Matrix<ScalarOf<G>, parameter_count<G>, 1> v;
  write_parameters(x, v.data());
  return v;
}

/// The largest difference of two vectors in units of eps times the largest component that the vector has on the curve.
struct Differences {
  double worst = 0;
  double size = 0;
  void see(const auto& got, const auto& expected) {
    worst = std::max(worst, static_cast<double>((got - expected).cwiseAbs().maxCoeff()));
    size = std::max(size, static_cast<double>(expected.cwiseAbs().maxCoeff()));
  }
  template <typename Scalar>
  void check() const {
    // The same operations on the same numbers: other results than the same come from FMA alone, which a compiler fuses
    // here in one way and there in another. Then each may err by its own few eps of the largest terms that a result is
    // the sum of, and derivatives between close knots are differences of terms several times as large.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
    CHECK(worst <= 16 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * (1 + size));
#else
    CHECK(worst == 0);
#endif
  }
};

template <int D, typename Curve>
void compare(const Curve& curve, const SampleTimes<typename Curve::Time>& times, std::size_t count) {
  using Scalar = typename Curve::Scalar;
  const auto samples = sample<D>(curve, times.start, times.interval, count);
  REQUIRE(samples.size() == count);
  Differences value, velocity, acceleration, jerk;
  for (std::size_t i = 0; i < count; ++i) {
    const auto expected = curve.template evaluate<D>(std::min(times(i), curve.end()));
    const auto got = samples[i];
    value.see(numbers(got.value), numbers(expected.value));
    if constexpr (D >= 1) velocity.see(got.velocity, expected.velocity);
    if constexpr (D >= 2) acceleration.see(got.acceleration, expected.acceleration);
    if constexpr (D >= 3) jerk.see(got.jerk, expected.jerk);
  }
  value.check<Scalar>();
  velocity.check<Scalar>();
  acceleration.check<Scalar>();
  jerk.check<Scalar>();
}

/// Many samples in a segment, few, less than one, and none but the last.
template <int D, typename Curve>
void compare_at_all_rates(const Curve& curve) {
  using Time = typename Curve::Time;
  const double duration = to_seconds<double>(curve.end() - curve.start());
  for (const double interval : {0.001, 0.07, 0.3, 0.25, 0.0625, duration}) {
    CAPTURE(interval);
    const auto step = after(Time{}, interval);
    const auto count = static_cast<std::size_t>(duration / to_seconds<double>(step) + 1e-9) + 1;
    compare<D>(curve, {curve.start(), step}, count);
  }
  compare<D>(curve, {after(curve.start(), 0.1), after(Time{}, 0.013)}, 7);
  compare<D>(curve, {curve.end(), after(Time{}, 1.0)}, 1);
}

}  // namespace

TEMPLATE_TEST_CASE("samples are what evaluate() gives: groups, scalars, knots and time", "",
                   (Spline<SO3xR3<double>, 4>), (Spline<SO3xR3<float>, 4>), (Spline<Sophus::SE3d, 4>),
                   (Spline<Sophus::SE3f, 4>), (Spline<Sophus::SO3d, 4>), (Spline<Eigen::Vector2d, 4>),
                   (Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>>),
                   (Spline<SO3xR3<float>, 4, UniformKnots<nanoseconds>>),
                   (Spline<SO3xR3<double>, 4, NonUniformKnots<double>>),
                   (Spline<SO3xR3<float>, 4, NonUniformKnots<double>>),
                   (Spline<Sophus::SE3d, 4, NonUniformKnots<nanoseconds>>)) {
  static_assert(PackedCurve<TestType>);
  using K = std::remove_cvref_t<decltype(std::declval<TestType>().knots())>;
  compare_at_all_rates<3>(random_curve<typename TestType::Group, TestType::order, K>());
}

TEMPLATE_TEST_CASE_SIG("samples of every order", "", ((int Order), Order), 2, 3, 5, 6, 7, 8) {
  compare_at_all_rates<2>(random_curve<SO3xR3<double>, Order, UniformKnots<double>>());
  compare_at_all_rates<2>(random_curve<Sophus::SE3d, Order, NonUniformKnots<double>>());
}

TEMPLATE_TEST_CASE_SIG("samples of every derivative", "", ((int D), D), 0, 1, 2, 3) {
  compare_at_all_rates<D>(random_curve<SO3xR3<double>, 4, UniformKnots<double>>());
}

TEMPLATE_TEST_CASE("curves that have no lanes are sampled one by one", "", (Spline<SO3xR3<long double>, 4>),
                   (Spline<Sophus::SE2d, 4>), (Spline<Sophus::SO2f, 4>),
                   (Spline<SO3xR3<float>, 4, UniformKnots<float>>)) {
  static_assert(!PackedCurve<TestType>);
  using K = std::remove_cvref_t<decltype(std::declval<TestType>().knots())>;
  const auto curve = random_curve<typename TestType::Group, TestType::order, K>();
  using Time = typename TestType::Time;
  const auto samples = sample<1>(curve, curve.start(), static_cast<Time>(0.01), 250);
  const SampleTimes<Time> times{curve.start(), static_cast<Time>(0.01)};
  for (std::size_t i = 0; i < 250; ++i) {
    const auto expected = curve.template evaluate<1>(times(i));
    CHECK(numbers(samples[i].value) == numbers(expected.value));
    CHECK(samples[i].velocity == expected.velocity);
  }
}

TEST_CASE("any motion can be sampled") {
  const Circle<double> circle{};
  const auto samples = sample<2>(circle, 0.0, 0.5, 20);
  CHECK(samples[3].acceleration == circle.evaluate<2>(1.5).acceleration);
}

TEST_CASE("identical control points are at rest, exactly") {
  const SO3xR3<double> x{GroupTraits<Sophus::SO3d>::exp({1, 2, 3}), {1e9, 2, 3}};
  const Spline<SO3xR3<double>, 5> curve({0.0, 0.1}, std::vector(9, x));
  const auto samples = sample<3>(curve, 0.0, 0.001, 400);
  CHECK(samples.velocity().isZero(0));
  CHECK(samples.acceleration().isZero(0));
  CHECK(samples.jerk().isZero(0));
  CHECK((samples.value().colwise() - numbers(x)).isZero(0));
}

TEST_CASE("samples are rows, columns and a range") {
  const auto curve = random_curve<SO3xR3<double>, 4, UniformKnots<double>>();
  const auto samples = sample<1>(curve, curve.start(), 0.01, 100);
  CHECK(samples.value().rows() == 7);
  CHECK(samples.velocity().cols() == 100);
  CHECK(samples.velocity()(4, 17) == samples[17].velocity[4]);
  std::size_t i = 0;
  for (const auto& m : samples) {
    CHECK(m.velocity == samples[i].velocity);
    ++i;
  }
  CHECK(i == 100);
  CHECK(sample<1>(curve, curve.start(), 0.01, 0).size() == 0);
}

TEST_CASE("a run in parts is the run") {
  const auto curve = random_curve<SO3xR3<double>, 4, UniformKnots<double>>();
  const SampleTimes<double> times{curve.start(), 0.003};
  const auto whole = sample<2>(curve, times.start, times.interval, 900);
  MotionSamples<SO3xR3<double>, 2> part;
  for (std::size_t first = 0; first < 900; first += 100) {
    sample<2>(curve, times, first, 100, part);
    REQUIRE(part.size() == 100);
    Differences difference;
    for (std::size_t i = 0; i < 100; ++i) difference.see(part[i].acceleration, whole[first + i].acceleration);
    difference.check<double>();
  }
}

TEST_CASE("times that are not on the curve are refused") {
  const auto curve = random_curve<SO3xR3<double>, 4, UniformKnots<double>>();
  CHECK_THROWS_AS(sample<0>(curve, curve.start() - 0.1, 0.1, 3), std::out_of_range);
  CHECK_THROWS_AS(sample<0>(curve, curve.start(), 0.1, 1000), std::out_of_range);
  CHECK_THROWS_AS(sample<0>(curve, curve.start(), 0.0, 3), std::invalid_argument);
}
