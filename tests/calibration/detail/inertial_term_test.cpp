// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/calibration/detail/inertial_term.hpp>
#include <splinertia/spline/fit/detail/banded_system.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using testing::message_of;
using Rows = CalibrationRows;

namespace {

using Samples = std::vector<ImuSample<>>;
template <typename G, int Order = 4>
using Curve = Spline<G, Order>;
template <typename C>
using System = BandedSystem<double, 6, C::order - 1, Rows::count>;

InertialOptions<double> all_estimated() {
  InertialOptions<double> options{.gyro_standard_deviation = 0.2, .accel_standard_deviation = 3};
  options.calibration = {.gyro_bias = {0.01, -0.02, 0.03},
                         .accel_bias = {0.1, -0.2, 0.3},
                         .gravity = {0.4, -0.3, -9.8},
                         .mounting = {Sophus::SO3d::exp({0.3, -1.2, 2.1}), {0.2, -0.1, 0.3}},
                         .time_offset = 0.04};
  options.estimate_lever_arm = options.estimate_time_offset = true;
  return options;
}

Samples some_samples() {
  testing::Random random(4);
  Samples samples;
  for (const double t : {0.1, 0.15, 0.41, 0.73, 1.1, 1.12, 1.37, 1.8}) {
    samples.push_back({t, random.tangent<Eigen::Vector3d>(1), random.tangent<Eigen::Vector3d>(10)});
  }
  return samples;
}

template <typename G, int Order = 4>
Curve<G, Order> some_curve() {
  testing::Random random(9);
  return {{.start = 0, .interval = 0.5}, random.walk<G>(Order + 3)};
}

/// The residuals over their standard deviations, by predicted_imu() alone.
Eigen::VectorXd residuals(const auto& curve, const Samples& samples, const ImuCalibration<double>& calibration) {
  const auto options = all_estimated();
  Eigen::VectorXd r(6 * static_cast<Eigen::Index>(samples.size()));
  Eigen::Index row = 0;
  for (const auto& sample : samples) {
    const auto reading = predicted_imu(curve.template evaluate<2>(sample.time + calibration.time_offset), calibration);
    r.segment<3>(row) = (reading.gyro - sample.gyro) / options.gyro_standard_deviation;
    r.segment<3>(row + 3) = (reading.accel - sample.accel) / options.accel_standard_deviation;
    row += 6;
  }
  return r;
}

/// All unknowns of a system as one matrix: control points, then the border.
template <typename S>
Eigen::MatrixXd dense(const S& system) {
  const auto blocks = static_cast<Eigen::Index>(system.rows.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * blocks + Rows::count, 6 * blocks + Rows::count);
  for (Eigen::Index i = 0; i < blocks; ++i) {
    const auto& row = system.rows[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j <= i && j < static_cast<Eigen::Index>(row.lower.size()); ++j) {
      A.block<6, 6>(6 * i, 6 * (i - j)) = row.lower[static_cast<std::size_t>(j)];
    }
    A.block<Rows::count, 6>(6 * blocks, 6 * i) = row.border.transpose();
  }
  A.bottomRightCorner<Rows::count, Rows::count>() = system.corner;
  return A.selfadjointView<Eigen::Lower>();
}

template <typename S>
Eigen::VectorXd right(const S& system) {
  Eigen::VectorXd b(6 * static_cast<Eigen::Index>(system.rows.size()) + Rows::count);
  for (std::size_t i = 0; i < system.rows.size(); ++i)
    b.segment<6>(6 * static_cast<Eigen::Index>(i)) = system.right.blocks[i];
  b.tail<Rows::count>() = system.right.border;
  return b;
}

template <typename G, int Order>
void check_normal_equations() {
  INFO("order " << Order);
  const auto samples = some_samples();
  const auto options = all_estimated();
  Curve<G, Order> curve = some_curve<G, Order>();
  const InertialTerm<Curve<G, Order>> term(samples, options, curve);
  REQUIRE(term.size() == samples.size());
  System<Curve<G, Order>> system(curve.control_points().size());
  const double cost = term.add(curve, options.calibration, system);

  const Eigen::VectorXd r = residuals(curve, samples, options.calibration);
  CHECK_THAT(cost, WithinRel(r.squaredNorm(), 1e-13));

  // Central differences: truncation h² = 1e-10 and rounding 1e-16/h = 1e-11 of the residuals, which are up to 100.
  const double h = 1e-5;
  Eigen::MatrixXd J(r.size(), 6 * static_cast<Eigen::Index>(curve.control_points().size()) + Rows::count);
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < curve.control_points().size(); ++i) {
    for (int k = 0; k < 6; ++k) {
      const G kept = curve.control_points()[i];
      const auto retracted = [&](double by) {
        curve.set_control_point(i, GroupTraits<G>::compose(kept, GroupTraits<G>::exp(Tangent<G>::Unit(k) * by)));
        const Eigen::VectorXd there = residuals(curve, samples, options.calibration);
        curve.set_control_point(i, kept);
        return there;
      };
      J.col(column++) = (retracted(h) - retracted(-h)) / (2 * h);
    }
  }
  for (int k = 0; k < Rows::count; ++k) {
    const auto retracted = [&](double by) {
      return residuals(curve, samples,
                       term.retracted(options.calibration, Eigen::Matrix<double, Rows::count, 1>::Unit(k) * by));
    };
    J.col(column++) = (retracted(h) - retracted(-h)) / (2 * h);
  }
  const Eigen::MatrixXd A = dense(system), expected = J.transpose() * J;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      INFO("row " << i << ", column " << j);
      CHECK(std::abs(A(i, j) - expected(i, j)) <= 2e-8 * J.col(i).norm() * J.col(j).norm() + 1e-10);
    }
  }
  const Eigen::VectorXd b = right(system), expected_b = -J.transpose() * r;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    INFO("row " << i);
    CHECK(std::abs(b[i] - expected_b[i]) <= 2e-8 * J.col(i).norm() * r.norm() + 1e-10);
  }
}

/// What makes of good samples and options something that is refused.
std::string refusal(const auto& change) {
  Samples samples = some_samples();
  auto options = all_estimated();
  change(samples, options);
  const auto curve = some_curve<SO3xR3<double>>();
  return message_of([&] { return InertialTerm<Curve<SO3xR3<double>>>(samples, options, curve).size(); });
}

}  // namespace

TEMPLATE_TEST_CASE("The normal equations are those of residuals whose derivatives are differences", "", SO3xR3<double>,
                   Sophus::SE3d) {
  check_normal_equations<TestType, 4>();
  check_normal_equations<TestType, 6>();
}

TEST_CASE("What is not estimated meets nothing") {
  using C = Curve<SO3xR3<double>>;
  auto options = all_estimated();
  const auto curve = some_curve<SO3xR3<double>>();
  const auto samples = some_samples();
  const auto corner = [&] {
    System<C> system(curve.control_points().size());
    (void)InertialTerm<C>(samples, options, curve).add(curve, options.calibration, system);
    for (const auto& row : system.rows) {
      for (int i = 0; i < Rows::count; ++i) {
        if (system.corner(i, i) == InertialTerm<C>::nothing) CHECK(row.border.col(i).isZero(0));
      }
    }
    return system.corner;
  };
  const auto all = corner();
  const auto check_kept = [&](bool& estimate, int first, int count) {
    INFO("unknowns from " << first << " on");
    estimate = false;
    auto expected = all;
    for (int i = first; i < first + count; ++i) {
      expected.row(i).setZero();
      expected.col(i).setZero();
      expected(i, i) = InertialTerm<C>::nothing;
    }
    CHECK(corner() == expected);
    const auto kept = InertialTerm<C>(samples, options, curve).estimated();
    CHECK(kept.count() == Rows::count - count);
    CHECK_FALSE(kept.segment(first, count).any());
    estimate = true;
  };
  check_kept(options.estimate_gyro_bias, Rows::gyro_bias, 3);
  check_kept(options.estimate_accel_bias, Rows::accel_bias, 3);
  check_kept(options.estimate_gravity_direction, Rows::gravity, 2);
  check_kept(options.estimate_lever_arm, Rows::lever_arm, 3);
  check_kept(options.estimate_time_offset, Rows::time_offset, 1);
}

TEST_CASE("Gravity turns, its amount is kept") {
  for (const Eigen::Vector3d& gravity :
       {Eigen::Vector3d(0, 0, -9.8), Eigen::Vector3d(3, 4, 5), Eigen::Vector3d(0, 2, 0)}) {
    const auto axes = gravity_tangent<double>(gravity);
    CHECK((axes.transpose() * axes - gravity.squaredNorm() * Eigen::Matrix2d::Identity()).norm() <
          1e-14 * gravity.squaredNorm());
    CHECK((axes.transpose() * gravity).norm() < 1e-14 * gravity.squaredNorm());

    auto options = all_estimated();
    options.calibration.gravity = gravity;
    const auto curve = some_curve<SO3xR3<double>>();
    const InertialTerm<Curve<SO3xR3<double>>> term(some_samples(), options, curve);
    Eigen::Matrix<double, Rows::count, 1> step = Eigen::Matrix<double, Rows::count, 1>::Zero();
    step.segment<2>(Rows::gravity) << 0.03, -0.04;
    const Eigen::Vector3d turned = term.retracted(options.calibration, step).gravity;
    CHECK_THAT(turned.norm(), WithinRel(gravity.norm(), 1e-15));
    CHECK_THAT(std::acos(turned.normalized().dot(gravity.normalized())), WithinRel(std::atan(0.05), 1e-11));
  }
}

TEST_CASE("The time offset stays within its limit") {
  auto options = all_estimated();
  const auto curve = some_curve<SO3xR3<double>>();
  const InertialTerm<Curve<SO3xR3<double>>> term(some_samples(), options, curve);
  Eigen::Matrix<double, Rows::count, 1> step = Eigen::Matrix<double, Rows::count, 1>::Zero();
  step[Rows::time_offset] = 0.05;
  CHECK(term.retracted(options.calibration, step).time_offset == 0.04 + 0.05);
  step[Rows::time_offset] = 1;
  CHECK(term.retracted(options.calibration, step).time_offset == 0.1);
  step[Rows::time_offset] = -1;
  CHECK(term.retracted(options.calibration, step).time_offset == -0.1);
}

TEST_CASE("Samples that the time offset could bring beyond the curve are left out") {
  using C = Curve<SO3xR3<double>>;
  const auto curve = some_curve<SO3xR3<double>>();  // from 0 to 2
  Samples samples;
  for (int i = -4; i <= 44; ++i) samples.push_back({0.05 * i, {0, 0, 0}, {0, 0, 0}});
  auto options = all_estimated();
  const auto count = [&] { return InertialTerm<C>(samples, options, curve).size(); };
  options.largest_time_offset = 0.12;
  CHECK(count() == 35);  // 0.15 to 1.85
  options.estimate_time_offset = false;
  options.calibration.time_offset = 0;
  CHECK(count() == 41);
  options.calibration.time_offset = 0.07;
  CHECK(count() == 40);  // −0.05 to 1.9
  // One that is known may be as large as it is.
  options.calibration.time_offset = 1.02;
  CHECK(count() == 24);  // −0.2, where the samples begin, to 0.95
}

TEST_CASE("Samples may be in nanoseconds where the curve is in seconds, and the other way round") {
  using std::chrono::nanoseconds;
  const auto options = all_estimated();
  const auto samples = some_samples();
  std::vector<ImuSample<double, nanoseconds>> in_nanoseconds;
  for (const auto& s : samples) in_nanoseconds.push_back({nanoseconds(std::llround(s.time * 1e9)), s.gyro, s.accel});
  const auto curve = some_curve<SO3xR3<double>>();
  using Epoch = Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>>;
  const Epoch epoch({nanoseconds(0), nanoseconds(500'000'000)}, curve.control_points());
  const auto cost = [&]<typename C>(const auto& from, const C& along) {
    System<C> system(along.control_points().size());
    return InertialTerm<C>(from, options, along).add(along, options.calibration, system);
  };
  const double expected = cost(samples, curve);
  CHECK_THAT(cost(in_nanoseconds, curve), WithinRel(expected, 1e-12));
  CHECK_THAT(cost(samples, epoch), WithinRel(expected, 1e-12));
  CHECK_THAT(cost(in_nanoseconds, epoch), WithinRel(expected, 1e-12));
}

TEST_CASE("Samples that are none are refused") {
  CHECK(refusal([](auto&, auto&) {}) == "nothing thrown");
  CHECK(refusal([](auto& samples, auto&) { std::swap(samples[3], samples[4]); }) ==
        "IMU sample 4 is at time 0.73, expected a time after 1.1, that of the sample before it");
  CHECK(refusal([](auto& samples, auto&) { samples[3].time = samples[2].time; }) ==
        "IMU sample 3 is at time 0.41, expected a time after 0.41, that of the sample before it");
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  CHECK(refusal([=](auto& samples, auto&) { samples[2].gyro.y() = nan; }) == "IMU sample 2 is not finite");
  CHECK(refusal([=](auto& samples, auto&) { samples[5].accel.z() = infinity; }) == "IMU sample 5 is not finite");
  CHECK(refusal([=](auto& samples, auto&) { samples[0].time = nan; }) == "IMU sample 0 is not finite");
  CHECK(refusal([=](auto& samples, auto&) { samples.back().time = infinity; }) == "IMU sample 7 is not finite");
  CHECK(refusal([](auto& samples, auto&) { samples.clear(); }) ==
        "IMU: none of 0 samples is within the curve, which reaches from 0 to 2");
  CHECK(refusal([](auto& samples, auto&) {
          for (auto& sample : samples) sample.time += 5;
        }) == "IMU: none of 8 samples is within the curve, which reaches from 0 to 2");
}

TEST_CASE("Options that make no sense are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal([](auto&, auto& o) { o.gyro_standard_deviation = 0; }) ==
        "InertialOptions: gyro_standard_deviation is 0, expected a finite number > 0");
  CHECK(refusal([](auto&, auto& o) { o.accel_standard_deviation = -1; }) ==
        "InertialOptions: accel_standard_deviation is -1, expected a finite number > 0");
  CHECK(refusal([=](auto&, auto& o) { o.accel_standard_deviation = nan; }) ==
        "InertialOptions: accel_standard_deviation is nan, expected a finite number > 0");
  CHECK(refusal([](auto&, auto& o) { o.largest_time_offset = 0; }) ==
        "InertialOptions: largest_time_offset is 0, expected a finite number > 0");
  CHECK(refusal([](auto&, auto& o) { o.calibration.time_offset = -0.2; }) ==
        "InertialOptions: time_offset is -0.2 s, expected a magnitude of at most largest_time_offset, 0.1");
  CHECK(refusal([](auto&, auto& o) { o.calibration.gravity.setZero(); }) ==
        "InertialOptions: the magnitude of gravity is 0, expected a finite number > 0");
  CHECK(refusal([=](auto&, auto& o) { o.calibration.gravity.x() = nan; }) ==
        "InertialOptions: the magnitude of gravity is nan, expected a finite number > 0");
  // A known time offset needs no limit, but is a number.
  CHECK(refusal([=](auto&, auto& o) {
          o.estimate_time_offset = false;
          o.calibration.time_offset = nan;
        }) == "InertialOptions: time_offset is nan, expected a finite number");
  const std::string not_finite = "InertialOptions: expected biases and lever arm to be finite";
  CHECK(refusal([=](auto&, auto& o) { o.calibration.gyro_bias.x() = nan; }) == not_finite);
  CHECK(refusal([=](auto&, auto& o) { o.calibration.accel_bias.z() = nan; }) == not_finite);
  CHECK(refusal([=](auto&, auto& o) { o.calibration.mounting.p_BI.y() = nan; }) == not_finite);
}
