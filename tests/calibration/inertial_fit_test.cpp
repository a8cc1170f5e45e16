// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <splinertia/calibration/inertial_fit.hpp>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "strapdown/simulated_imu.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Rows = CalibrationRows;
using Vector12 = Eigen::Matrix<double, Rows::count, 1>;

namespace {

/// Up to 3 rad/s and 3 m/s², about all axes.
constexpr testing::AggressiveMotion<> motion{.speed = 0.15};
constexpr double rotation_noise = 0.002, position_noise = 0.005, gyro_noise = 0.01, accel_noise = 0.1;
// With knots 0.05 s apart it follows this motion so well that it adds next to nothing to the noise (checked below).
template <typename G>
using Curve = Spline<G, 4>;

template <typename G>
Tangent<G> pose_deviation() {
  Tangent<G> deviation;
  deviation << Eigen::Vector3<double>::Constant(SplitPose<G> ? rotation_noise : position_noise),
      Eigen::Vector3<double>::Constant(SplitPose<G> ? position_noise : rotation_noise);
  return deviation;
}

template <typename C>
FitOptions<C> pose_options() {
  return {.knot_interval = 0.05, .standard_deviation = pose_deviation<typename C::Group>()};
}

/// All is estimated; known are the amount of gravity and how the IMU is turned.
InertialOptions<double> imu_options() {
  InertialOptions<double> options{.gyro_standard_deviation = gyro_noise, .accel_standard_deviation = accel_noise};
  const auto truth = testing::some_imu();
  options.calibration.gravity = {0, 0, -truth.gravity.norm()};
  options.calibration.mounting.R_BI = truth.mounting.R_BI;
  options.estimate_lever_arm = options.estimate_time_offset = true;
  return options;
}

/// How far the unknowns of `a` are from those of `b`; of gravity, along the axes that its deviation is about.
Vector12 difference(const ImuCalibration<double>& a, const ImuCalibration<double>& b) {
  Vector12 d;
  d << a.gyro_bias - b.gyro_bias, a.accel_bias - b.accel_bias,
      gravity_tangent<double>(a.gravity).transpose() * (a.gravity - b.gravity) / a.gravity.squaredNorm(),
      a.mounting.p_BI - b.mounting.p_BI, a.time_offset - b.time_offset;
  return d;
}

Vector12 deviation(const CalibratedImu<double>& imu) {
  const auto& s = imu.standard_deviation;
  Vector12 d;
  d << s.gyro_bias, s.accel_bias, s.gravity_direction, s.lever_arm, s.time_offset;
  return d;
}

/// Motion and IMU of a run, 4 s long.
template <typename G>
struct Run {
  std::vector<Stamped<G, double>> poses;
  std::vector<ImuSample<>> samples;

  explicit Run(std::uint64_t seed, const auto& along, double noise = 1)
      : poses(
            testing::poses_along<G>(along, 0, 4, 50, noise * rotation_noise, noise * position_noise, StreamKey(seed))),
        samples(testing::samples_along(along, testing::some_imu(), 0.02, 3.98, 100, noise * gyro_noise,
                                       noise * accel_noise, StreamKey(seed))) {}
  explicit Run(std::uint64_t seed) : Run(seed, motion) {}
};

/// A spline along the motion, for data that a spline can follow exactly.
template <typename G>
Curve<G> spline_along_motion() {
  std::vector<G> points;
  const UniformKnots<double> knots{0, 0.05};
  for (std::size_t i = 0; i < 83; ++i) {
    const auto value = motion.evaluate<0>(knots.control_point_time(i, 4)).value;
    points.push_back(make_pose<G>(rotation(value), position(value)));
  }
  return {knots, points};
}

/// Errors over their standard deviations, of many runs.
class Normalised {
 public:
  void add(const CalibratedImu<double>& imu) {
    const Vector12 n = difference(imu.calibration, testing::some_imu()).cwiseQuotient(deviation(imu));
    largest_ = std::max(largest_, n.cwiseAbs().maxCoeff());
    squares_ += n.cwiseAbs2();
    ++count_;
  }
  void check() const {
    const Vector12 rms = (squares_ / count_).cwiseSqrt();
    const double together = std::sqrt(squares_.sum() / (12 * count_));
    INFO("of " << count_ << ": RMS " << rms.transpose() << ", together " << together);
    CHECK(largest_ < 4);
    // The RMS of n normal numbers scatters by 1/√2n around 1; three times that, and a little for all of them together.
    const double bound = 3 / std::sqrt(2.0 * count_);
    CHECK(rms.minCoeff() > 1 - bound);
    CHECK(rms.maxCoeff() < 1 + bound);
    CHECK_THAT(together, WithinAbs(1, bound / 3));
  }

 private:
  Vector12 squares_ = Vector12::Zero();
  double largest_ = 0;
  int count_ = 0;
};

}  // namespace

TEMPLATE_TEST_CASE("Without noise, a spline and the calibration are found exactly", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  const auto truth = spline_along_motion<G>();
  const Run<G> run(1, truth, 0);
  const auto exact = testing::some_imu();
  auto options = pose_options<Curve<G>>();
  options.regularize_ends = false;  // the prior believes the deviation that is given, and these poses have none
  const auto fit = inertial_fit<Curve<G>>(run.poses, run.samples, options, imu_options());
  CHECK(fit.converged);
  CHECK(fit.imu.converged);
  CHECK(difference(fit.imu.calibration, exact).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(fit.imu.gyro_rms < 1e-10);
  CHECK(fit.imu.accel_rms < 1e-9);
  CHECK(fit.residuals.max < 1e-10);
  for (std::size_t i = 0; i < truth.control_points().size(); ++i) {
    CHECK(increment<G>(truth.control_points()[i], fit.spline.control_points()[i]).norm() < 1e-8);
  }

  const auto held = calibrate_imu(truth, run.samples, imu_options());
  CHECK(held.converged);
  CHECK(difference(held.calibration, exact).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(held.accel_rms < 1e-12);
}

TEMPLATE_TEST_CASE("The errors of a fit are as large as it says", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  const auto options = pose_options<Curve<G>>();
  const auto without_noise =
      inertial_fit<Curve<G>>(Run<G>(0, motion, 0).poses, Run<G>(0, motion, 0).samples, options, imu_options());
  CHECK(difference(without_noise.imu.calibration, testing::some_imu())
            .cwiseQuotient(deviation(without_noise.imu))
            .cwiseAbs()
            .maxCoeff() < 0.15);
  Normalised normalised;
  // Both groups see the same noise and find the same: for one of them, a few seeds show that.
  for (std::uint64_t seed = 0; seed < (SplitPose<G> ? 40 : 10); ++seed) {
    const Run<G> run(seed);
    const auto fit = inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), imu_options());
    CHECK(fit.converged);
    normalised.add(fit.imu);
  }
  normalised.check();
}

TEMPLATE_TEST_CASE("The errors of a calibration along a known curve are as large as it says", "", SO3xR3<double>,
                   Sophus::SE3d) {
  using G = TestType;
  const auto truth = spline_along_motion<G>();
  Normalised normalised;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto imu = calibrate_imu(truth, Run<G>(seed, truth).samples, imu_options());
    CHECK(imu.converged);
    normalised.add(imu);
  }
  normalised.check();
}

TEST_CASE("A time offset does without lever arm, and what is not estimated stays as it is") {
  using G = SO3xR3<double>;
  const Run<G> run(1);
  auto options = imu_options();
  options.calibration = testing::some_imu();
  const auto check = [&](bool InertialOptions<double>::*estimate, int first, int count) {
    INFO("unknowns from " << first << " on");
    options.*estimate = false;
    const auto fit = inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), options);
    CHECK(fit.converged);
    const Vector12 d = difference(fit.imu.calibration, testing::some_imu()), sigma = deviation(fit.imu);
    CHECK(d.segment(first, count).isZero(0));
    for (int i = 0; i < Rows::count; ++i) {
      INFO("unknown " << i);
      if (i >= first && i < first + count) {
        CHECK(sigma[i] == 0);
      } else {
        CHECK(sigma[i] > 0);
        CHECK(std::abs(d[i]) < 4 * sigma[i]);
      }
    }
    options.*estimate = true;
  };
  check(&InertialOptions<double>::estimate_gyro_bias, Rows::gyro_bias, 3);
  check(&InertialOptions<double>::estimate_accel_bias, Rows::accel_bias, 3);
  check(&InertialOptions<double>::estimate_gravity_direction, Rows::gravity, 2);
  check(&InertialOptions<double>::estimate_lever_arm, Rows::lever_arm, 3);
  check(&InertialOptions<double>::estimate_time_offset, Rows::time_offset, 1);
}

TEST_CASE("A body at rest shows neither lever arm nor time offset, nor gravity apart from the bias") {
  using G = SO3xR3<double>;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.3, 1, 2)}) {
    const G pose = make_pose<G>(Sophus::SO3d::exp(turn), Eigen::Vector3d(1, 2, 3));
    const Curve<G> rest({0, 0.05}, std::vector<G>(83, pose));
    for (const bool gravity : {false, true}) {
      INFO("turned by " << turn.transpose() << ", gravity " << (gravity ? "" : "not ") << "estimated");
      auto options = imu_options();
      options.estimate_gravity_direction = gravity;
      options.calibration.gravity = testing::some_imu().gravity;
      const auto check = [&](const CalibratedImu<double>& imu, double unseen) {
        const Vector12 sigma = deviation(imu);
        CHECK(imu.converged);
        CHECK(difference(imu.calibration, {}).cwiseAbs().maxCoeff() < 1);  // stayed near where it started
        CHECK_FALSE(sigma.hasNaN());
        CHECK(sigma.head<3>().maxCoeff() < 1e-3);
        CHECK(sigma.segment<4>(Rows::lever_arm).minCoeff() >= unseen);
        if (gravity) {
          CHECK(sigma.segment<5>(Rows::accel_bias).minCoeff() > 1000);
        } else {
          CHECK(sigma.segment<3>(Rows::accel_bias).maxCoeff() < 0.01);
        }
      };
      const Run<G> run(2, rest), exact(2, rest, 0);
      check(calibrate_imu(rest, run.samples, options), infinity);
      check(calibrate_imu(rest, exact.samples, options), infinity);
      check(inertial_fit<Curve<G>>(exact.poses, exact.samples, pose_options<Curve<G>>(), options).imu, 1e6);
    }
  }
  // Where the curve follows noise, it looks like a motion that shows a little. The estimates are worth nothing, but
  // are numbers.
  const Run<G> run(2, Curve<G>({0, 0.05}, std::vector<G>(83, G{Sophus::SO3d(), Eigen::Vector3d(1, 2, 3)})));
  const auto noisy = inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), imu_options()).imu;
  CHECK(difference(noisy.calibration, {}).allFinite());
  CHECK_FALSE(deviation(noisy).hasNaN());
  CHECK(deviation(noisy).segment<3>(Rows::lever_arm).minCoeff() > 0.5);
  CHECK(deviation(noisy).segment<5>(Rows::accel_bias).minCoeff() > 1);
}

TEST_CASE("A time offset beyond the limit ends at the limit") {
  using G = SO3xR3<double>;
  const Run<G> run(3);
  auto options = imu_options();
  options.largest_time_offset = 0.01;
  const auto fit = inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), options);
  CHECK(fit.imu.calibration.time_offset == 0.01);
  CHECK(difference(fit.imu.calibration, testing::some_imu()).cwiseAbs().maxCoeff() < 0.05);
  CHECK(calibrate_imu(spline_along_motion<G>(), run.samples, options).calibration.time_offset == 0.01);
}

TEST_CASE("With the IMU, accelerations are far better, and it bridges gaps between the poses") {
  using G = SO3xR3<double>;
  Run<G> run(5);
  struct Errors {
    double force, position, rotation;
  };
  const auto errors = [&](const Curve<G>& curve, double from, double to) {
    Eigen::Array3d squares = Eigen::Array3d::Zero();
    const auto gravity = standard_gravity<double>();
    for (int i = 0; i <= 100; ++i) {
      const double t = from + (to - from) * i / 100;
      const auto got = curve.evaluate<2>(t), expected = motion.evaluate<2>(t);
      squares += Eigen::Array3d((specific_force(got, gravity) - specific_force(expected, gravity)).squaredNorm(),
                                (position(got.value) - position(expected.value)).squaredNorm(),
                                (rotation(got.value).inverse() * rotation(expected.value)).log().squaredNorm());
    }
    const Eigen::Array3d rms = (squares / 101).sqrt();
    return Errors{rms[0], rms[1], rms[2]};
  };
  const auto both = [&] {
    return inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), imu_options());
  };
  const auto alone = [&] { return fit<Curve<G>>(run.poses, pose_options<Curve<G>>()); };
  const auto a = errors(alone().spline, 0.2, 3.8), b = errors(both().spline, 0.2, 3.8);
  CHECK(b.force < a.force / 10);
  CHECK(b.position < a.position / 1.5);
  CHECK(b.rotation < a.rotation / 1.5);

  std::erase_if(run.poses, [](const auto& pose) { return pose.time > 1.5 && pose.time < 2.5; });
  const auto bridged = both();
  CHECK(bridged.converged);
  CHECK(bridged.gaps.size() == 1);
  const auto c = errors(alone().spline, 1.5, 2.5), d = errors(bridged.spline, 1.5, 2.5);
  CHECK(d.position < c.position / 10);
  CHECK(d.position < 0.02);
  CHECK(d.rotation < 0.005);
  CHECK((difference(bridged.imu.calibration, testing::some_imu()).cwiseQuotient(deviation(bridged.imu)))
            .cwiseAbs()
            .maxCoeff() < 4);
}

TEST_CASE("Along a fitted curve, samples inside its gaps do not count") {
  using G = SO3xR3<double>;
  // Of a curve through poses alone, the error of the readings is that of the curve: known and the same for all samples
  // outside of the gap. What is estimated are biases and gravity, which the invented motion inside the gap would turn.
  auto options = imu_options();
  options.estimate_lever_arm = options.estimate_time_offset = false;
  options.calibration = testing::some_imu();
  options.accel_standard_deviation =
      1.5;  // with 0.1 s from knot to knot, noise of poses leaves about that in the force
  options.gyro_standard_deviation = 0.05;
  double largest = 0, worst_with_gap = 0, squares = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Run<G> run(seed);
    std::erase_if(run.poses, [](const auto& pose) { return pose.time > 1.5 && pose.time < 2.6; });
    const auto fitted = fit<Curve<G>>(run.poses, {.knot_interval = 0.1, .standard_deviation = pose_deviation<G>()});
    REQUIRE(fitted.gaps.size() == 1);
    const auto imu = calibrate_imu(fitted, run.samples, options);
    CHECK(imu.converged);
    std::size_t outside = 0;
    for (const auto& sample : run.samples) {
      const double t = sample.time + options.calibration.time_offset;
      outside += t >= 0 && t <= 4 && (t <= fitted.gaps[0].start || t >= fitted.gaps[0].end) ? 1 : 0;
    }
    CHECK(imu.samples == outside);
    const auto normalised = [&](const CalibratedImu<double>& found) {
      return Eigen::Matrix<double, 8, 1>(
          difference(found.calibration, testing::some_imu()).cwiseQuotient(deviation(found)).head<8>());
    };
    const Eigen::Matrix<double, 8, 1> n = normalised(imu);
    largest = std::max(largest, n.cwiseAbs().maxCoeff());
    squares += n.squaredNorm();
    count += 8;
    worst_with_gap =
        std::max(worst_with_gap, normalised(calibrate_imu(fitted.spline, run.samples, options)).cwiseAbs().maxCoeff());
  }
  INFO("up to " << largest << " sigma, RMS " << std::sqrt(squares / count) << "; with the gap up to "
                << worst_with_gap);
  CHECK(largest < 4);
  CHECK(std::sqrt(squares / count) < 1.3);
  CHECK(worst_with_gap > 2 * largest);
}

TEST_CASE("Where only the IMU measures a hole, the errors are as large as it says, and the curve follows the truth") {
  using G = SO3xR3<double>;
  for (const double hole : {0.3, 1., 2.}) {
    Normalised normalised;
    double position_off = 0, rotation_off = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
      Run<G> run(100 + seed);
      const double from = 1 + 0.003 * static_cast<double>(seed);
      std::erase_if(run.poses, [&](const auto& pose) { return pose.time > from && pose.time < from + hole; });
      const auto fit = inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), imu_options());
      CHECK(fit.converged);
      CHECK(fit.gaps.size() == 1);
      normalised.add(fit.imu);
      for (double t = from; t <= from + hole; t += 0.02) {
        const auto got = fit.spline.evaluate<0>(t).value, expected = motion.evaluate<0>(t).value;
        position_off = std::max(position_off, (position(got) - position(expected)).norm());
        rotation_off = std::max(rotation_off, (rotation(got).inverse() * rotation(expected)).log().norm());
      }
    }
    INFO("hole of " << hole << " s: off by " << position_off << " m and " << rotation_off << " rad");
    normalised.check();
    // Integrated white noise of 0.1 m/s² at 100 Hz, held at both ends: σ = 0.01 √(T³/192) m, and the ends' 2 mm; the
    // gyro's 0.001 √(T/4) rad and 1 mrad. Four times that, of three axes.
    CHECK(position_off < 4 * 1.8 * (0.002 + 0.01 * std::sqrt(hole * hole * hole / 192)));
    CHECK(rotation_off < 4 * 1.8 * (0.001 + 0.001 * std::sqrt(hole / 4)));
  }
}

TEST_CASE("Outliers among the poses disturb neither curve nor calibration") {
  using G = SO3xR3<double>;
  Run<G> run(6);
  for (std::size_t i = 10; i < run.poses.size(); i += 20) {
    run.poses[i].value = make_pose<G>(rotation(run.poses[i].value) * Sophus::SO3d::exp(Eigen::Vector3d(0, 0.3, 0)),
                                      position(run.poses[i].value) + Eigen::Vector3d(0.5, 0, 0));
  }
  auto options = pose_options<Curve<G>>();
  options.loss = RobustLoss::cauchy();
  const auto fit = inertial_fit<Curve<G>>(run.poses, run.samples, options, imu_options());
  CHECK(fit.converged);
  CHECK(fit.outliers.size() == (run.poses.size() - 10 + 19) / 20);
  CHECK(difference(fit.imu.calibration, testing::some_imu()).cwiseQuotient(deviation(fit.imu)).cwiseAbs().maxCoeff() <
        4);
}

TEST_CASE("Poses and samples with epoch stamps give the same as from zero") {
  using G = SO3xR3<double>;
  using std::chrono::nanoseconds;
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const Run<G> run(7);
  std::vector<Stamped<G, nanoseconds>> poses;
  for (const auto& p : run.poses) poses.push_back({epoch + to_nanoseconds(p.time), p.value});
  std::vector<ImuSample<double, nanoseconds>> samples;
  for (const auto& s : run.samples) samples.push_back({epoch + to_nanoseconds(s.time), s.gyro, s.accel});
  using Epoch = Spline<G, 4, UniformKnots<nanoseconds>>;
  const auto expected = inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), imu_options());
  const auto fit = inertial_fit<Epoch>(poses, samples, pose_options<Epoch>(), imu_options());
  CHECK(fit.converged);
  CHECK(difference(fit.imu.calibration, expected.imu.calibration).cwiseQuotient(deviation(fit.imu)).norm() < 1e-4);
  CHECK((deviation(fit.imu) - deviation(expected.imu)).cwiseQuotient(deviation(fit.imu)).norm() < 1e-4);
}

TEST_CASE("In single precision") {
  using G = SO3xR3<float>;
  using C = Spline<G, 4>;
  const Run<SO3xR3<double>> run(8);
  std::vector<Stamped<G, double>> poses;
  for (const auto& p : run.poses) {
    poses.push_back({p.time, {rotation(p.value).cast<float>(), position(p.value).cast<float>()}});
  }
  std::vector<ImuSample<float, double>> samples;
  for (const auto& s : run.samples) samples.push_back({s.time, s.gyro.cast<float>(), s.accel.cast<float>()});
  const auto truth = testing::some_imu();
  InertialOptions<float> options{.gyro_standard_deviation = static_cast<float>(gyro_noise),
                                 .accel_standard_deviation = static_cast<float>(accel_noise)};
  options.calibration.gravity = truth.gravity.cast<float>();
  options.calibration.mounting.R_BI = truth.mounting.R_BI.cast<float>();
  options.estimate_lever_arm = options.estimate_time_offset = true;
  const FitOptions<C> pose{.knot_interval = 0.05, .standard_deviation = pose_deviation<SO3xR3<double>>().cast<float>()};
  const auto imu = inertial_fit<C>(poses, samples, pose, options).imu;
  CHECK(imu.converged);
  const auto& sigma = imu.standard_deviation;
  const auto within = [](const auto& got, const auto& expected, const auto& deviation) {
    return (got.template cast<double>() - expected)
               .cwiseQuotient(deviation.template cast<double>())
               .cwiseAbs()
               .maxCoeff() < 4;
  };
  CHECK(within(imu.calibration.gyro_bias, truth.gyro_bias, sigma.gyro_bias));
  CHECK(within(imu.calibration.accel_bias, truth.accel_bias, sigma.accel_bias));
  CHECK(within(imu.calibration.mounting.p_BI, truth.mounting.p_BI, sigma.lever_arm));
  CHECK(std::abs(imu.calibration.time_offset - truth.time_offset) < 4 * double{sigma.time_offset});
}

TEST_CASE("What is wrong with the poses, the samples or the options is said") {
  using G = SO3xR3<double>;
  Run<G> run(9);
  const auto message = [&] {
    return testing::message_of([&] {
      return inertial_fit<Curve<G>>(run.poses, run.samples, pose_options<Curve<G>>(), imu_options()).converged;
    });
  };
  CHECK(message() == "nothing thrown");
  std::swap(run.samples[3].time, run.samples[4].time);
  CHECK(message() == "IMU sample 4 is at time 0.05, expected a time after 0.06, that of the sample before it");
  run.poses.resize(1);
  CHECK(message() == "fit: 1 poses, expected at least 2");
}
