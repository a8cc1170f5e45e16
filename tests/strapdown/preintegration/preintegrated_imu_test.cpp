// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/preintegration/preintegrated_imu.hpp>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

constexpr std::size_t intervals = 60;

/// Any part of the samples: preintegrated from sample `from` to sample `to`. Increments end with their sample.
template <typename Scheme, typename Scalar>
auto part(std::size_t from, std::size_t to, const ImuBias<Scalar>& bias, double jitter = 0.2) {
  using Samples = std::vector<testing::SampleOf<Scheme, Scalar>>;
  const auto all = testing::some_samples<Scheme, Scalar>(intervals, jitter);
  const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
  const ImuNoise<Scalar> noise{Scalar(1e-2F), Scalar(2e-2F), Scalar(3e-2F), Scalar(4e-2F)};
  if constexpr (Scheme::takes_increments) {
    const double start = from == 0 ? 2.0 : all[from - 1].time;
    return testing::preintegrate<Scheme, Scalar>(start, Samples(at(from), at(to)), bias, noise);
  } else {
    return testing::preintegrate<Scheme, Scalar>(all[from].time, Samples(at(from), at(to + 1)), bias, noise);
  }
}

template <typename Scalar>
const ImuBias<Scalar> some_bias{{Scalar(0.01F), Scalar(-0.02F), Scalar(0.03F)},
                                {Scalar(0.1F), Scalar(0.2F), Scalar(0)}};

template <typename Result, typename Scalar>
void check_equal(const Result& a, const Result& b, Scalar tolerance) {
  CHECK(testing::difference(a.delta(), b.delta()).cwiseAbs().maxCoeff() <= tolerance * 10);
  CHECK(std::abs(a.delta().interval - b.delta().interval) <= tolerance);
  CHECK(testing::largest_difference(testing::as_matrix(a.jacobians()), testing::as_matrix(b.jacobians())) <=
        tolerance * 10);
  const auto P = a.covariance().matrix();
  CHECK(testing::largest_difference(P, b.covariance().matrix()) <= tolerance * P.cwiseAbs().maxCoeff());
}

template <typename Scheme, typename Scalar>
void check_merging(const char* scheme, double jitter = 0.2) {
  INFO(scheme);
  const auto& bias = some_bias<Scalar>;
  const Scalar tolerance = Scalar(intervals) * testing::eps<Scalar>;
  const auto whole = part<Scheme, Scalar>(0, intervals, bias, jitter);
  const auto a = part<Scheme, Scalar>(0, 20, bias, jitter), b = part<Scheme, Scalar>(20, 34, bias, jitter),
             c = part<Scheme, Scalar>(34, intervals, bias, jitter);
  auto ab = a;
  ab.append(b);
  auto ab_c = ab;
  ab_c.append(c);
  auto bc = b;
  bc.append(c);
  auto a_bc = a;
  a_bc.append(bc);
  check_equal(ab, part<Scheme, Scalar>(0, 34, bias, jitter), tolerance);
  check_equal(ab_c, whole, tolerance);
  check_equal(a_bc, whole, tolerance);
}

}  // namespace

TEST_CASE("Nothing preintegrated is no motion") {
  const PreintegratedImu<double, ImuCovariance<double>> imu;
  CHECK(imu.delta().rotation.coeffs() == Eigen::Vector4d(0, 0, 0, 1));
  CHECK(imu.delta().velocity.isZero(0));
  CHECK(imu.delta().position.isZero(0));
  CHECK(imu.delta().interval == 0);
  CHECK(imu.covariance().matrix().isZero(0));
  const auto corrected = imu.corrected({{1, 2, 3}, {4, 5, 6}});
  CHECK(testing::difference(imu.delta(), corrected).isZero(0));
}

TEST_CASE("To append to nothing, or nothing, changes nothing") {
  auto imu = part<Midpoint, double>(0, 20, some_bias<double>);
  decltype(imu) empty(some_bias<double>);
  const auto before = imu;
  imu.append(empty);
  check_equal(imu, before, 1e-15);
  empty.append(before);
  check_equal(empty, before, 1e-15);
}

// Not Magnus4, whose steps at both ends of a part take other samples than those inside.
TEMPLATE_TEST_CASE("Two neighbouring parts make the whole, however they are bracketed", "", float, double) {
  check_merging<ZeroOrderHold, TestType>("ZeroOrderHold");
  check_merging<Euler, TestType>("Euler");
  check_merging<Midpoint, TestType>("Midpoint");
  check_merging<Trapezoid, TestType>("Trapezoid");
  check_merging<RotationCorrectedIncrements, TestType>("RotationCorrectedIncrements");
  // An even number of increments each, of equal intervals: with others it looks at the increment before, too.
  check_merging<TwoSampleIncrements, TestType>("TwoSampleIncrements", 0);
}

TEST_CASE("Parts with different biases make the whole to first order") {
  const auto& bias = some_bias<double>;
  const auto whole = part<Midpoint, double>(0, intervals, bias);
  const auto error = [&](double step) {
    auto merged = part<Midpoint, double>(0, 30, bias);
    const ImuBias<double> other{bias.gyro + step * Eigen::Vector3d(1, -2, 1.5),
                                bias.accel + step * Eigen::Vector3d(3, 1, 2)};
    merged.append(part<Midpoint, double>(30, intervals, other));
    CHECK(merged.bias().gyro == bias.gyro);
    return std::array<double, 2>{
        testing::difference(whole.delta(), merged.delta()).norm(),
        testing::largest_difference(testing::as_matrix(whole.jacobians()), testing::as_matrix(merged.jacobians()))};
  };
  const auto coarse = error(2e-3), fine = error(1e-3);
  CHECK_THAT(std::log2(coarse[0] / fine[0]), WithinAbs(2, 0.1));  // the error of the motion is of second order
  CHECK_THAT(std::log2(coarse[1] / fine[1]), WithinAbs(1, 0.1));  // that of its derivatives, of first
}

TEST_CASE("A million steps leave the rotation a unit quaternion") {
  PreintegratedImu<double> imu;
  const auto step = linearize_increment(StepMean<double>{{1e-3, -2e-3, 3e-3}, {0, 0, 0.0981}, 0.01});
  for (int i = 0; i < 1'000'000; ++i) imu.append(step);
  CHECK(std::abs(imu.delta().rotation.norm() - 1) < 4e-16);
}

TEST_CASE("Without a covariance there is none in memory") {
  STATIC_CHECK(std::is_empty_v<NoCovariance>);
  STATIC_CHECK(sizeof(PreintegratedImu<double>) + sizeof(ImuCovariance<double>) <=
               sizeof(PreintegratedImu<double, ImuCovariance<double>>));
}
