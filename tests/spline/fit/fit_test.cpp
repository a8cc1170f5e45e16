// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/detail/data_support.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
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
using Line = Spline<Number, 4>;
using Split = SO3xR3<double>;
using SplitCurve = Spline<Split, 4>;
using Six = Tangent<Split>;

/// Poses of the ellipse, `rate` a second over `length` seconds, with noise if asked for.
PosesOf<SplitCurve> ellipse_poses(double rate, double length, double noise = 0, std::uint64_t seed = 1) {
  testing::Random random(seed);
  PosesOf<SplitCurve> poses;
  for (int i = 0; i <= std::lround(rate * length); ++i) {
    const double t = i / rate;
    const auto error = GroupTraits<Split>::exp(random.tangent<Split>(noise));
    poses.push_back({t, GroupTraits<Split>::compose(Ellipse<>{}.evaluate<0>(t).value, error)});
  }
  return poses;
}

/// A wave with a little noise at uneven times.
PosesOf<Line> wave(int count, double length) {
  testing::Random random(7);
  PosesOf<Line> poses;
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.4 * random.symmetric() * (i > 0 && i + 1 < count)) * length / (count - 1);
    poses.push_back({t, Number(std::sin(2 * t) + 0.05 * random.symmetric())});
  }
  return poses;
}

/// Rows of the weights of the control points at the poses.
Eigen::MatrixXd weights_at(const PosesOf<Line>& poses, const Line& curve) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(poses.size()),
                                               static_cast<Eigen::Index>(curve.control_points().size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto place = curve.knots().basis<double, 4, 0>(poses[i].time, curve.control_points().size());
    const auto weights = control_point_weights(place.basis);
    for (std::size_t j = 0; j < 4; ++j) {
      rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(place.first + j)) = weights[j];
    }
  }
  return rows;
}

Eigen::VectorXd values_of(const PosesOf<Line>& poses) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) values[static_cast<Eigen::Index>(i)] = poses[i].value[0];
  return values;
}

Eigen::VectorXd control_points_of(const Line& curve) {
  Eigen::VectorXd points(static_cast<Eigen::Index>(curve.control_points().size()));
  for (Eigen::Index i = 0; i < points.size(); ++i) points[i] = curve.control_points()[static_cast<std::size_t>(i)][0];
  return points;
}

/// Roots of the spectral densities integrated: ∫ |x⁽ᵈ⁾|² dt as squares of rows, by Simpson's rule in each segment,
/// which is exact up to degree 3 of the integrand's 2 (d = 2) and 0 (d = 3).
Eigen::MatrixXd roughness_rows(const Line& curve, int derivative) {
  const auto n = static_cast<Eigen::Index>(curve.control_points().size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(curve.segments()), n);
  const double interval = curve.knots().interval;
  for (std::size_t s = 0; s < curve.segments(); ++s) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double t = curve.start() + (static_cast<double>(s) + 0.5 * static_cast<double>(k)) * interval;
      // Just inside the segment at its end, where the third derivative jumps.
      const auto place =
          curve.knots().basis<double, 4, 3>(k == 2 ? t - 1e-9 * interval : t, curve.control_points().size());
      const auto& lambda = place.basis.lambda[static_cast<std::size_t>(derivative)];
      const double root = std::sqrt((k == 1 ? 4 : 1) * interval / 6);
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(s) + k, first = static_cast<Eigen::Index>(place.first);
      for (std::size_t j = 0; j < 3; ++j) {
        rows(row, first + static_cast<Eigen::Index>(j)) -= root * lambda[j];
        rows(row, first + static_cast<Eigen::Index>(j) + 1) += root * lambda[j];
      }
    }
  }
  return rows;
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}

template <typename Curve>
double largest_difference(const Curve& a, const Curve& b) {
  using G = typename Curve::Group;
  REQUIRE(a.control_points().size() == b.control_points().size());
  double largest = 0;
  for (std::size_t i = 0; i < a.control_points().size(); ++i) {
    largest = std::max(largest, increment<G>(a.control_points()[i], b.control_points()[i]).norm());
  }
  return largest;
}

/// Poses of a hand at a rate, with white noise.
PosesOf<SplitCurve> hand_poses(double rate, int count, double noise) {
  NormalStream normal{StreamKey(5)};
  PosesOf<SplitCurve> poses;
  for (int i = 0; i < count; ++i) {
    const double t = i / rate;
    const Split value{Sophus::SO3d::exp({0.35 * std::sin(3.1 * t), 0.3 * std::cos(2.3 * t), 0.5 * std::sin(2.7 * t)}),
                      Eigen::Vector3d(0.25 * std::sin(2.1 * t), 0.2 * std::cos(1.7 * t), 1.2)};
    Six error;
    for (double& x : error) x = noise * normal();
    poses.push_back({t, GroupTraits<Split>::compose(value, GroupTraits<Split>::exp(error))});
  }
  return poses;
}

/// The largest difference of values, velocities and accelerations over [from, to].
Eigen::Array3d differences(const SplitCurve& a, const SplitCurve& b, double from, double to) {
  Eigen::Array3d largest = Eigen::Array3d::Zero();
  for (int i = 0; i <= 1000; ++i) {
    const double t = from + (to - from) * i / 1000;
    const auto x = a.evaluate<2>(t), y = b.evaluate<2>(t);
    largest = largest.max(Eigen::Array3d(increment<Split>(x.value, y.value).norm(), (x.velocity - y.velocity).norm(),
                                         (x.acceleration - y.acceleration).norm()));
  }
  return largest;
}

const std::vector<RobustLoss> robust_losses{RobustLoss::huber(), RobustLoss::cauchy()};

}  // namespace

TEST_CASE("On Rⁿ one step is exact, and is the dense least squares solution") {
  const auto poses = wave(150, 10);
  const auto fitted = fit<Line>(poses, {.knot_interval = 0.5, .regularize_ends = false});
  CHECK(fitted.converged);
  CHECK(fitted.iterations <= 2);
  const Eigen::MatrixXd A = weights_at(poses, fitted.spline);
  const Eigen::VectorXd b = values_of(poses), expected = least_squares(A, b);
  CHECK((control_points_of(fitted.spline) - expected).norm() < 1e-12);  // condition of the normal equations ~ 10²

  // What is reported of it.
  const Eigen::VectorXd residuals = A * expected - b;
  REQUIRE(fitted.residuals.poses.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK_THAT(fitted.residuals.poses[i][0], WithinAbs(residuals[static_cast<Eigen::Index>(i)], 1e-13));
  }
  const double rms = residuals.norm() / std::sqrt(150.);
  CHECK_THAT(fitted.residuals.rms, WithinRel(rms, 1e-10));
  CHECK_THAT(fitted.residuals.component_rms[0], WithinRel(rms, 1e-10));
  CHECK_THAT(fitted.residuals.max, WithinRel(residuals.cwiseAbs().maxCoeff(), 1e-10));
  CHECK_THAT(fitted.residuals.component_max[0], WithinRel(residuals.cwiseAbs().maxCoeff(), 1e-10));
  CHECK(fitted.gaps.empty());
  CHECK(fitted.outliers.empty());
  const Eigen::MatrixXd normal = A.transpose() * A;
  const Eigen::VectorXd root = normal.diagonal().cwiseSqrt().cwiseInverse();
  const auto eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(root.asDiagonal() * normal * root.asDiagonal()).eigenvalues();
  const double condition = eigenvalues[eigenvalues.size() - 1] / eigenvalues[0];
  CHECK(fitted.condition <= condition * (1 + 1e-6));
  CHECK(fitted.condition >= condition / 3);
}

TEST_CASE("The deviation of poses is estimated from the residuals") {
  testing::Random random(3);
  PosesOf<Line> poses;
  // Sums of twelve uniform numbers are normal enough.
  for (int i = 0; i <= 4000; ++i) {
    double noise = 0;
    for (int j = 0; j < 12; ++j) noise += 0.5 * random.symmetric();
    poses.push_back({i * 0.01, Number(std::sin(0.01 * i) + 0.02 * noise)});
  }
  const auto fitted = fit<Line>(poses, {.knot_interval = 0.2, .regularize_ends = false});
  // The median of 4000 magnitudes is good to 1.2/√4000 = 2 %.
  CHECK_THAT(fitted.standard_deviation[0], WithinRel(0.02, 0.06));
  CHECK(fitted.outliers.empty());
  const auto given =
      fit<Line>(poses, {.knot_interval = 0.2, .standard_deviation = Number(0.005), .regularize_ends = false});
  CHECK(given.standard_deviation[0] == 0.005);
  CHECK_FALSE(given.outliers.empty());                             // six of them are 1.5 true ones
  CHECK(largest_difference(fitted.spline, given.spline) < 1e-11);  // a factor of all squares changes nothing
}

TEST_CASE("The sign of a quaternion does not matter") {
  const auto poses = ellipse_poses(50, 6, 0.01);
  auto flipped = poses;
  for (std::size_t i = 0; i < flipped.size(); i += 3) {
    double* q = flipped[i].value.get<0>().data();
    for (int j = 0; j < 4; ++j) q[j] = -q[j];
  }
  const auto a = fit<SplitCurve>(poses, {.knot_interval = 0.3});
  const auto b = fit<SplitCurve>(flipped, {.knot_interval = 0.3});
  CHECK(largest_difference(a.spline, b.spline) < 1e-12);
  CHECK_THAT(b.residuals.max, WithinAbs(a.residuals.max, 1e-12));
}

TEST_CASE("A weight of four is a pose there four times, and of zero none") {
  auto poses = wave(80, 10);
  std::vector<double> weights(80, 1.0);
  for (std::size_t i = 0; i < 80; i += 3) weights[i] = 4;
  for (std::size_t i = 1; i < 80; i += 7) weights[i] = 0;
  poses[8].value[0] = 1e3;  // one that does not count, and leaves no trace in the statistics
  REQUIRE(weights[8] == 0);
  const auto fitted = fit<Line>(poses, {.knot_interval = 0.8, .weights = weights, .regularize_ends = false});
  const Eigen::MatrixXd all = weights_at(poses, fitted.spline);
  const Eigen::VectorXd values = values_of(poses);
  Eigen::MatrixXd A(0, all.cols());
  Eigen::VectorXd b(0);
  for (Eigen::Index i = 0; i < 80; ++i) {
    for (int again = 0; again < weights[static_cast<std::size_t>(i)]; ++again) {
      A.conservativeResize(A.rows() + 1, Eigen::NoChange);
      A.bottomRows(1) = all.row(i);
      b.conservativeResize(b.size() + 1);
      b[b.size() - 1] = values[i];
    }
  }
  CHECK((control_points_of(fitted.spline) - least_squares(A, b)).norm() < 1e-12);
  CHECK(fitted.residuals.max < 1);
  REQUIRE(fitted.residuals.poses.size() == 80);
  CHECK(std::abs(fitted.residuals.poses[8][0]) > 900);
}

TEST_CASE("Gross outliers are reported, all and no others, and hardly move the curve") {
  const double noise = 2e-3;  // uniform: no tail that could be taken for outliers
  auto poses = ellipse_poses(100, 10, noise);
  testing::Random random(11);
  std::vector<std::size_t> planted;
  for (std::size_t i = 37; i < poses.size(); i += 97) {  // one in a hundred
    planted.push_back(i);
    Six off = random.tangent<Split>(0.5);
    off[static_cast<int>(i % 6)] = 1;
    poses[i].value = GroupTraits<Split>::compose(poses[i].value, GroupTraits<Split>::exp(off));
  }
  const auto error_of = [&](const Fit<SplitCurve>& fitted) {
    double error = 0;
    for (const auto& pose : poses) {
      const Split truth = Ellipse<>{}.evaluate<0>(pose.time).value;
      error = std::max(error, increment<Split>(truth, fitted.spline.evaluate<0>(pose.time).value).norm());
    }
    return error;
  };
  const double clean = error_of(fit<SplitCurve>(ellipse_poses(100, 10, noise), {.knot_interval = 0.2}));
  for (const RobustLoss& loss : {RobustLoss::huber(), RobustLoss::cauchy()}) {
    const auto fitted = fit<SplitCurve>(poses, {.knot_interval = 0.2, .loss = loss});
    CHECK(fitted.converged);
    CHECK(fitted.outliers == planted);
    const double error = error_of(fitted);
    INFO("off the truth by up to " << error << ", without outliers " << clean);
    CHECK(error < 2 * clean);
    // 1.4826 times the median, which is half of the largest that there is.
    for (int i = 0; i < 6; ++i) CHECK_THAT(fitted.standard_deviation[i], WithinRel(0.7413 * noise, 0.15));
  }
  CHECK(error_of(fit<SplitCurve>(poses, {.knot_interval = 0.2})) > 20 * clean);
}

TEST_CASE("A jump stays where it is") {
  auto poses = ellipse_poses(200, 10);
  const double jump = 5.0;
  const Eigen::Vector3d step(0.02, -0.04, 0.04);  // 60 mm
  for (auto& pose : poses) {
    if (pose.time >= jump) pose.value.get<1>() += step;
  }
  const double interval = 0.05;
  const auto smooth = fit<SplitCurve>(ellipse_poses(200, 10), {.knot_interval = interval, .regularize_ends = false});
  // Huber's loss is in the end the sum of magnitudes: both sides of the jump pull, and it takes a knot more to be done.
  const auto check = [&](const RobustLoss& loss, double reach) {
    const auto fitted = fit<SplitCurve>(
        poses,
        {.knot_interval = interval, .standard_deviation = Six::Constant(1e-4), .loss = loss, .regularize_ends = false});
    CHECK(fitted.converged);
    double beyond = 0, rotated = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Six& r = fitted.residuals.poses[i];
      if (std::abs(poses[i].time - jump) > reach) beyond = std::max(beyond, r.tail<3>().norm());
      const Sophus::SO3d rotation = fitted.spline.evaluate<0>(poses[i].time).value.get<0>();
      const Sophus::SO3d expected = smooth.spline.evaluate<0>(poses[i].time).value.get<0>();
      rotated = std::max(rotated, (expected.inverse() * rotation).log().norm());
    }
    INFO("positions off by " << beyond << ", rotations by " << rotated);
    CHECK(beyond < 1e-3);
    CHECK(rotated < 1e-9);
    REQUIRE_FALSE(fitted.outliers.empty());
    for (const std::size_t i : fitted.outliers) CHECK(std::abs(poses[i].time - jump) <= reach);
    CHECK(fitted.residuals.max > 0.02);  // nothing went after half of the jump
  };
  check(RobustLoss::cauchy(), 2 * interval);
  check(RobustLoss::huber(), 3 * interval);
}

TEST_CASE("Smoothness is a prior: against the dense solution of the same cost") {
  const auto poses = wave(60, 10);
  const auto plain = fit<Line>(poses, {.knot_interval = 0.5});
  const Eigen::MatrixXd A = weights_at(poses, plain.spline);
  const Eigen::VectorXd b = values_of(poses);
  for (const int derivative : {2, 3}) {
    const Eigen::MatrixXd rough = roughness_rows(plain.spline, derivative);
    for (const double density : {0.1, 1.0, 10.0}) {
      INFO("derivative " << derivative << ", density " << density);
      const double deviation = 0.05;
      const auto fitted = fit<Line>(poses, {.knot_interval = 0.5,
                                            .standard_deviation = Number(deviation),
                                            .smoothness = Smoothness<Number>{derivative, Number(density)}});
      CHECK(fitted.iterations <= 2);
      Eigen::MatrixXd both(A.rows() + rough.rows(), A.cols());
      both << A / deviation, rough / density;
      Eigen::VectorXd right = Eigen::VectorXd::Zero(both.rows());
      right.head(b.size()) = b / deviation;
      CHECK((control_points_of(fitted.spline) - least_squares(both, right)).norm() < 1e-7);
    }
  }
}

TEST_CASE("Smoothness from none to all") {
  const auto poses = ellipse_poses(50, 6, 0.02);
  const auto plain = fit<SplitCurve>(poses, {.knot_interval = 0.3, .regularize_ends = false});
  for (const int derivative : {2, 3}) {
    const auto with = [&](double density) {
      return fit<SplitCurve>(
          poses, {.knot_interval = 0.3, .smoothness = Smoothness<Split>{derivative, Six::Constant(density)}});
    };
    const auto loose = with(1e9);
    CHECK(largest_difference(loose.spline, plain.spline) < 1e-9);
    // The derivative is held at zero, but for the data's pull: residuals of 2 m over a deviation of 1.
    const auto tight = with(1e-3);
    CHECK(tight.converged);
    const auto middle = tight.spline.evaluate<3>(3);
    if (derivative == 2) {
      CHECK(middle.acceleration.norm() < 1e-3);
      CHECK((tight.spline.evaluate<1>(0).velocity - tight.spline.evaluate<1>(6).velocity).norm() < 6e-3);
      CHECK(middle.velocity.norm() > 0.1);
    } else {
      CHECK(middle.jerk.tail<3>().norm() < 1e-4);
      CHECK(middle.jerk.head<3>().norm() < 2e-2);  // of rotations, the third derivative is an approximation
      CHECK(middle.acceleration.norm() > 0.1);
    }
  }
  // Fewer poses than control points are enough with it.
  const auto few = fit<SplitCurve>(ellipse_poses(1, 6),
                                   {.knot_interval = 0.1, .smoothness = Smoothness<Split>{2, Six::Constant(1)}});
  CHECK(few.converged);
  CHECK(few.residuals.max < 1);
}

TEST_CASE("A gap in the data is told and bridged") {
  auto poses = ellipse_poses(100, 10);
  CHECK(fit<SplitCurve>(poses, {.knot_interval = 0.2}).gaps.empty());
  std::vector<double> weights(poses.size(), 1.0);
  for (std::size_t i = 401; i < 600; ++i) weights[i] = 0;
  const auto weighted = fit<SplitCurve>(poses, {.knot_interval = 0.2, .weights = weights});
  poses.erase(poses.begin() + 401, poses.begin() + 600);  // the last is at 4 s, the next at 6 s
  const auto fitted = fit<SplitCurve>(poses, {.knot_interval = 0.2});
  CHECK(fitted.converged);
  REQUIRE(fitted.gaps.size() == 1);
  CHECK(fitted.gaps[0].start == 4);
  CHECK(fitted.gaps[0].end == 6);
  // Control point i shapes 0.2·(i − 3) … 0.2·(i + 1): those of 23 … 29 see nothing but the gap.
  CHECK(fitted.regularized_control_points >= 7);
  CHECK(fitted.regularized_control_points <= 9);
  CHECK(largest_difference(weighted.spline, fitted.spline) < 1e-9);

  // Across the gap the curve is no wilder than beside it, and beside it as if there were none.
  const auto whole = fit<SplitCurve>(ellipse_poses(100, 10), {.knot_interval = 0.2});
  double highest = 0, inside = 0, beside = 0;
  for (double t = 0; t <= 10; t += 0.01) {
    const auto expected = whole.spline.evaluate<2>(t), got = fitted.spline.evaluate<2>(t);
    highest = std::max(highest, expected.acceleration.norm());
    if (t > 4 && t < 6) {
      inside = std::max(inside, got.acceleration.norm());
    } else {
      beside = std::max(beside, increment<Split>(expected.value, got.value).norm());
    }
  }
  INFO("acceleration " << inside << " in the gap, up to " << highest << " without it; beside it off by " << beside);
  CHECK(inside < 2 * highest);
  CHECK(beside < 1e-3);
  CHECK(largest_difference(fitted.spline, fitted.spline) == 0);  // finite
}

TEST_CASE("A gap is not filled on integer time or uneven knots either") {
  using Epoch = Spline<Number, 4, NonUniformKnots<nanoseconds>>;
  const nanoseconds epoch{1'403'715'524'907'143'168}, step{10'000'000};
  PosesOf<Epoch> poses;
  for (int i = 0; i <= 1000; ++i) {
    if (i <= 400 || i >= 600) poses.push_back({epoch + i * step, Number(std::sin(0.01 * i))});
  }
  const auto fitted = fit<Epoch>(poses, {.knot_interval = 0.2});
  REQUIRE(fitted.gaps.size() == 1);
  CHECK(fitted.gaps[0].start == epoch + 400 * step);
  CHECK(fitted.gaps[0].end == epoch + 600 * step);
  // The way of least acceleration between sin 4 with slope cos 4 and sin 6 with cos 6 is the cubic, off at its middle
  // by less than 2⁴/384 times a fourth derivative of 1.
  CHECK_THAT(fitted.spline.evaluate<0>(epoch + 500 * step).value[0], WithinAbs(std::sin(5), 0.06));
}

TEST_CASE("Poses that span more nanoseconds than 64 bits count are refused") {
  using Epoch = Spline<Number, 4, UniformKnots<nanoseconds>>;
  constexpr std::int64_t far = 9'000'000'000'000'000'000;
  const PosesOf<Epoch> poses{
      {nanoseconds{-far}, Number(0)}, {nanoseconds{0}, Number(1)}, {nanoseconds{far}, Number(2)}};
  CHECK(message_of([&] { return fit<Epoch>(poses, {.knot_interval = 1e9}); }) ==
        "fit: poses from -9000000000000000000 to 9000000000000000000 span more ticks than 64 bits can count");
}

TEST_CASE("Poses that cannot be fitted are refused with place and value") {
  const auto good = ellipse_poses(10, 5);
  const auto why = [](const PosesOf<SplitCurve>& poses,
                      const FitOptions<SplitCurve>& options = {.knot_interval = 0.5}) {
    return message_of([&] { return fit<SplitCurve>(poses, options); });
  };
  const double nan = std::nan("");
  auto bad = good;
  std::swap(bad[3], bad[4]);
  CHECK(why(bad) == "fit: pose 4 is at time 0.3, expected a time after 0.4, that of the pose before it");
  bad = good;
  bad[7].time = bad[6].time;
  CHECK(why(bad) == "fit: pose 7 is at time 0.6, expected a time after 0.6, that of the pose before it");
  bad = good;
  bad[2].value.get<1>().y() = nan;
  CHECK(why(bad) == "fit: pose 2 is not finite");
  bad[2].value.get<1>().y() = std::numeric_limits<double>::infinity();
  CHECK(why(bad) == "fit: pose 2 is not finite");
  bad = good;
  bad[5].time = nan;
  CHECK(why(bad) == "fit: pose 5 is at time nan, expected a finite number");
  bad = good;
  bad.back().time = std::numeric_limits<double>::infinity();
  CHECK(why(bad) == "fit: pose 50 is at time inf, expected a finite number");
  bad = good;
  for (int i = 0; i < 4; ++i) bad[1].value.get<0>().data()[i] *= 1.5;
  const std::string off = why(bad);
  CHECK(off.starts_with("fit: pose 1 is off its group by 0."));
  CHECK(off.ends_with(", expected at most 0.001 (the norm of a rotation is 1)"));
  bad[1].value.get<0>().data()[0] = nan;
  CHECK(why(bad) == "fit: pose 1 is not finite");
  CHECK(why({}) == "fit: 0 poses, expected at least 2");
  CHECK(why({good[0]}) == "fit: 1 poses, expected at least 2");
  CHECK(why(good, {.knot_interval = 0.5, .knots = UniformKnots<double>{0, 0.5}}) ==
        "fit: expected knot_interval or knots, and not both");
  CHECK(why(good, {.knot_interval = -1}) == "fit: knot_interval is -1, expected a finite number > 0");
  CHECK(why(good, {.knot_interval = 1e-300}).find("a hundred per pose") != std::string::npos);
  CHECK(why(good, {.knots = UniformKnots<double>{1, 0.5}}) ==
        "fit: poses from 0 to 5, but the knots reach from 1 to 5; expected knots that cover all poses");
}

TEST_CASE("Poses are read, not written") {
  auto poses = ellipse_poses(20, 3);
  for (int i = 0; i < 4; ++i) poses[4].value.get<0>().data()[i] *= 1 + 1e-4;  // drifted, and normalised in a copy
  const auto copy = poses;
  (void)fit<SplitCurve>(poses, {.knot_interval = 0.3, .loss = RobustLoss::cauchy()});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK(poses[i].time == copy[i].time);
    CHECK(poses[i].value.get<0>().unit_quaternion().coeffs() == copy[i].value.get<0>().unit_quaternion().coeffs());
    CHECK(poses[i].value.get<1>() == copy[i].value.get<1>());
  }
}

TEST_CASE("A knot interval longer than the data gives one segment and says how bad it is") {
  const auto fitted = fit<SplitCurve>(ellipse_poses(50, 20), {.knot_interval = 1e6});
  CHECK(fitted.spline.segments() == 1);
  CHECK(fitted.spline.start() == 0);
  CHECK_THAT(fitted.spline.end(), WithinRel(20.0, 1e-14));
  CHECK(fitted.residuals.component_rms.tail<3>().norm() > 0.5);  // the vertical wave alone has 0.7
  CHECK(std::isfinite(fitted.residuals.max));
}

TEST_CASE("Few iterations are counted, and said not to be enough") {
  const auto poses = ellipse_poses(50, 6, 0.01);
  const auto one = fit<SplitCurve>(poses, {.knot_interval = 0.3, .most_iterations = 1});
  CHECK(one.iterations == 1);
  CHECK_FALSE(one.converged);
  const auto robust =
      fit<SplitCurve>(poses, {.knot_interval = 0.3, .loss = RobustLoss::cauchy(), .most_iterations = 5});
  CHECK(robust.iterations == 5);
  CHECK_FALSE(robust.converged);
  CHECK(robust.condition >= 1);
}

TEST_CASE("Poses of SO3xR3 for a curve on SE3, and the other way round") {
  using Rigid = Spline<Sophus::SE3d, 4>;
  const auto split = ellipse_poses(50, 5);
  PosesOf<Rigid> rigid;
  for (const auto& pose : split) {
    rigid.push_back({pose.time, make_pose<Sophus::SE3d>(rotation(pose.value), position(pose.value))});
  }
  const FitOptions<Rigid> to_rigid{.knot_interval = 0.25};
  CHECK(largest_difference(fit<Rigid>(split, to_rigid).spline, fit<Rigid>(rigid, to_rigid).spline) == 0);
  const FitOptions<SplitCurve> to_split{.knot_interval = 0.25};
  CHECK(largest_difference(fit<SplitCurve>(rigid, to_split).spline, fit<SplitCurve>(split, to_split).spline) == 0);
}

TEST_CASE("Nanoseconds for a curve in seconds, and stamps at an epoch") {
  using Epoch = Spline<Split, 4, UniformKnots<nanoseconds>>;
  const auto in_seconds = ellipse_poses(50, 5);
  const nanoseconds epoch{1'403'715'524'907'143'168};
  std::vector<Stamped<Split>> at_zero, at_epoch;
  for (const auto& pose : in_seconds) {
    at_zero.push_back({nanoseconds{std::llround(pose.time * 1e9)}, pose.value});
    at_epoch.push_back({epoch + at_zero.back().time, pose.value});
  }
  const auto reference = fit<SplitCurve>(in_seconds, {.knot_interval = 0.25});
  const auto converted = fit<SplitCurve>(at_zero, {.knot_interval = 0.25});
  CHECK(largest_difference(reference.spline, converted.spline) < 1e-12);
  const auto zero = fit<Epoch>(at_zero, {.knot_interval = 0.25});
  const auto now = fit<Epoch>(at_epoch, {.knot_interval = 0.25});
  CHECK(now.spline.start() == epoch);
  CHECK(largest_difference(zero.spline, now.spline) == 0);  // nothing is lost at an epoch
  CHECK(largest_difference(reference.spline.control_points().size() == zero.spline.control_points().size()
                               ? SplitCurve(reference.spline.knots(), zero.spline.control_points())
                               : reference.spline,
                           reference.spline) < 1e-9);
}

TEST_CASE("Wrong poses at the ends are named, have no weight, and move nothing") {
  const double noise = 0.01;
  const auto clean = hand_poses(30, 200, noise);
  for (const RobustLoss& loss : robust_losses) {
    const auto expected = fit<SplitCurve>(clean, {.loss = loss});
    for (const std::size_t wrong : {1U, 2U, 3U}) {
      for (const bool at_start : {true, false}) {
        INFO(wrong << " at the " << (at_start ? "start" : "end"));
        auto poses = clean;
        std::vector<std::size_t> planted;
        for (std::size_t k = 0; k < wrong; ++k) {
          const std::size_t i = at_start ? k : poses.size() - wrong + k;
          planted.push_back(i);
          poses[i].value.get<1>() += 6 * Eigen::Vector3d(std::cos(3. * static_cast<double>(k)), 1, 0);
        }
        const auto found = fit<SplitCurve>(poses, {.loss = loss});
        CHECK(found.converged);
        CHECK(found.outliers == planted);
        // Where there are poses, as without the wrong ones, which do not count: each component by less than its noise.
        const double gone = static_cast<double>(wrong) / 30;
        const auto off =
            differences(found.spline, expected.spline, at_start ? gone : 0, 199 / 30. - (at_start ? 0 : gone));
        CHECK(off[0] < std::sqrt(6.) * noise);
        // And to the very end it stays near: accelerations below 3 times the true ones.
        for (double t = 0; t <= found.spline.end(); t += 0.01) {
          CHECK(found.spline.evaluate<2>(t).acceleration.norm() < 3 * 5.5);
        }
      }
    }
  }
}

TEST_CASE("Two poses of identity before a steady attitude are named, and the rest stays at rest") {
  const double noise = 1e-3;
  const Split home{Sophus::SO3d::exp({1.1, -1, 1.1}), Eigen::Vector3d(1, 2, 3)};
  for (const double rate : {20., 200.}) {
    testing::Random random(2);
    PosesOf<SplitCurve> poses;
    for (int i = 0; i < 300; ++i) {
      const auto error = GroupTraits<Split>::exp(random.tangent<Split>(noise));
      poses.push_back({i / rate, i < 2 ? Split() : GroupTraits<Split>::compose(home, error)});
    }
    for (const RobustLoss& loss : robust_losses) {
      const auto found = fit<SplitCurve>(poses, {.loss = loss});
      CHECK(found.converged);
      CHECK(found.outliers == std::vector<std::size_t>{0, 1});
      CHECK(std::isfinite(found.condition));
      for (double t = 0; t <= found.spline.end(); t += 0.01) {
        CHECK(found.spline.evaluate<1>(t).velocity.head<3>().norm() < 0.1);
      }
    }
  }
}

TEST_CASE("Poses that turn by 95, 120 or 170° from one to the next give their rate") {
  using Rotation = Sophus::SO3d;
  for (const double degrees : {95., 120., 170.}) {
    for (const double noise : {0., 1e-3}) {
      const double rate = degrees * std::numbers::pi / 180;
      testing::Random random(3);
      PosesOf<SplitCurve> poses;
      for (int i = 0; i <= 60; ++i) {
        const auto error = GroupTraits<Split>::exp(random.tangent<Split>(noise));
        poses.push_back(
            {1. * i, GroupTraits<Split>::compose({Rotation::rotZ(rate * i), Eigen::Vector3d(0.1 * i, 0, 0)}, error)});
      }
      INFO(degrees << " degrees, noise " << noise);
      const auto found = fit<SplitCurve>(poses);
      CHECK(found.converged);
      REQUIRE(found.knot_choice);
      // The choice takes three times the length of the noise off each turn.
      CHECK(found.knot_choice->interval * (rate - 6 * noise) <= largest_turn * (1 + 1e-9));
      for (double t = 0; t <= 60; t += 0.1) {
        CHECK((found.spline.evaluate<1>(t).velocity.head<3>() - Eigen::Vector3d(0, 0, rate)).norm() < 0.01 * rate);
      }
    }
  }
}

TEST_CASE("Key frames with pauses converge with chosen knots") {
  auto poses = hand_poses(10, 200, 1e-3);
  double pause = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i % 20 == 19) pause += 2;
    poses[i].time += pause;
  }
  for (const RobustLoss& loss : {RobustLoss::squares(), RobustLoss::cauchy()}) {
    const auto found = fit<SplitCurve>(poses, {.loss = loss});
    CHECK(found.converged);
    CHECK(found.gaps.size() == 10);
    CHECK(found.outliers.size() < 4);
    CHECK(found.residuals.component_rms.maxCoeff() < 0.05);
    for (double t = 0; t <= found.spline.end(); t += 0.02) {
      const auto at = found.spline.evaluate<2>(t);
      CHECK(at.velocity.head<3>().norm() < 3 * 1.8);  // three times what the hand reaches
      CHECK(at.acceleration.tail<3>().norm() < 3 * 1.3);
    }
  }
}

TEST_CASE("Two poses, three, and poses that are all alike") {
  const auto hand = hand_poses(10, 200, 0);
  for (const std::size_t count : {2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 10U, 16U}) {
    const PosesOf<SplitCurve> few(hand.begin(), hand.begin() + static_cast<std::ptrdiff_t>(count));
    for (const RobustLoss& loss : {RobustLoss::squares(), RobustLoss::huber(), RobustLoss::cauchy()}) {
      INFO(count << " poses");
      const auto found = fit<SplitCurve>(few, {.loss = loss});
      CHECK(found.converged);
      CHECK(found.residuals.max < 0.01);
      for (double t = 0; t <= found.spline.end(); t += 0.01) {
        CHECK(found.spline.evaluate<2>(t).velocity.norm() < 2.5);
      }
    }
  }
  for (const std::size_t count : {2U, 3U, 10U, 300U}) {
    PosesOf<SplitCurve> same;
    for (std::size_t i = 0; i < count; ++i) same.push_back({0.01 * static_cast<double>(i), hand[7].value});
    for (const RobustLoss& loss : {RobustLoss::squares(), RobustLoss::cauchy()}) {
      const auto found = fit<SplitCurve>(same, {.loss = loss});
      CHECK(found.converged);
      CHECK(found.residuals.max < 1e-12);
      for (double t = 0; t <= found.spline.end(); t += 1e-3) {
        CHECK(found.spline.evaluate<2>(t).acceleration.norm() < 1e-6);
      }
    }
  }
}

TEST_CASE("Knots as far apart as the poses, or nearly, give a curve as good as any") {
  // Of as many cubic pieces as poses, poses in the middle of every piece leave alternating control points undetermined:
  // knots 1 % nearer together than poses went through that, and were off by 0.3 m and 1300 m/s².
  const auto truth = fit<SplitCurve>(hand_poses(200, 3000, 0), {.knot_interval = 0.05});
  for (const double noise : {0., 1e-3}) {
    const auto poses = hand_poses(20, 300, noise);
    for (const double share : {0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.999, 1., 1.01, 1.05, 1.15, 1.25, 1.33, 1.5}) {
      for (const RobustLoss& loss : {RobustLoss::squares(), RobustLoss::huber(), RobustLoss::cauchy()}) {
        const auto found = fit<SplitCurve>(poses, {.knot_interval = share / 20, .loss = loss});
        const auto off = differences(found.spline, truth.spline, 0.5, 14.45);
        INFO("noise " << noise << ", knots " << share << " times as far apart: off by " << off.transpose());
        CHECK(found.converged);
        // Of noise: six components of up to 3.3 σ. Its differences are of 2 σ/0.05 s and 4 σ/(0.05 s)².
        CHECK(off[0] < 1e-4 + 5 * noise);
        CHECK(off[1] < 5e-3 + 5 * 2 * noise / 0.05);
        CHECK(off[2] < 0.5 + 8 * 4 * noise / (0.05 * 0.05));
        // At the ends, where the prior pulls accelerations towards zero: at most by the true one, 5.5.
        CHECK(differences(found.spline, truth.spline, 0, 14.95)[2] < 5.5 + 8 * 4 * noise / (0.05 * 0.05));
      }
    }
  }
}
