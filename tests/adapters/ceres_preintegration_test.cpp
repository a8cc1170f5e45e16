// SPDX-License-Identifier: MIT
#include <ceres/ceres.h>

#include <array>
#include <splinertia/adapters/ceres_preintegration.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

const Eigen::Vector3d gravity(0, 0, -9.81);
const ImuNoise<double> noise{2e-4, 2e-3, 2e-5, 3e-3};
const ImuBias<double> bias{{0.01, -0.02, 0.03}, {0.1, 0.2, -0.15}};

template <typename T>
ImuSample<T, double> sample_at(double t) {
  const auto sine = [](double x) { return T(std::sin(x)); };
  return {t,
          {sine(7 * t), T(2.0) * sine(5 * t), sine(3 * t + 1)},
          {T(3.0) * sine(8 * t), sine(2 * t), T(9.0) + sine(9 * t)}};
}

/// From `start` on, in steps of 10 ms.
template <typename T, typename Noise = Noiseless>
auto preintegrated(double start, int steps, const ImuBias<T>& with, const Noise& densities = {}) {
  Preintegrator<Midpoint, T, double, Noise> preintegrator(start, with, densities);
  for (int i = 0; i <= steps; ++i) preintegrator.push(sample_at<T>(start + 0.01 * i));
  preintegrator.finish();
  return preintegrator.result();
}

struct State {
  NavState<double> nav;
  Eigen::Matrix<double, 6, 1> biases;

  std::vector<double*> blocks() { return {nav.R_WB.data(), nav.v_WB.data(), nav.p_WB.data(), biases.data()}; }
};

Eigen::Matrix<double, 6, 1> as_vector(const ImuBias<double>& b) {
  Eigen::Matrix<double, 6, 1> v;
  v << b.gyro, b.accel;
  return v;
}

/// A state that is moved by up to `angle`, `size` m/s and m, and `size` of the biases.
State moved(State s, double angle, double size, testing::Random& random) {
  Eigen::Vector3d axis = random.tangent<Eigen::Vector3d>();
  s.nav.R_WB *= GroupTraits<Sophus::SO3d>::exp(angle * axis.normalized());
  s.nav.v_WB += random.tangent<Eigen::Vector3d>(size);
  s.nav.p_WB += random.tangent<Eigen::Vector3d>(size);
  for (int k = 0; k < 6; ++k) s.biases[k] += size * random.symmetric();
  return s;
}

State origin(testing::Random& random) {
  return {{random.walk<Sophus::SO3d>(1)[0], random.tangent<Eigen::Vector3d>(3), random.tangent<Eigen::Vector3d>(9), 1},
          as_vector(bias)};
}

void add(testing::Parameters& p, const State& s) {
  p.add(std::vector<Sophus::SO3d>{s.nav.R_WB});
  p.add(s.nav.v_WB);
  p.add(s.nav.p_WB);
  p.add(s.biases);
}

/// The library's own residual in Jets.
struct Functor {
  Eigen::Matrix<double, 15, 15> weight;

  template <typename T>
  static NavState<T> state(T const* const* p) {
    return {read_parameters<Sophus::SO3<T>>(p[0]), Eigen::Map<const Eigen::Vector3<T>>(p[1]),
            Eigen::Map<const Eigen::Vector3<T>>(p[2]), 0.0};
  }
  template <typename T>
  static ImuBias<T> biases(const T* p) {
    return {Eigen::Map<const Eigen::Vector3<T>>(p), Eigen::Map<const Eigen::Vector3<T>>(p + 3)};
  }

  template <typename T>
  bool operator()(T const* const* p, T* residuals) const {
    const auto fixed = preintegrated<T>(1, 30, {bias.gyro.cast<T>(), bias.accel.cast<T>()});
    Eigen::Map<PreintegrationResidual<T>>{residuals} =
        weight.cast<T>() * preintegration_residual(fixed, state(p), biases(p[3]), state(p + 4), biases(p[7]),
                                                   Eigen::Vector3<T>(gravity.cast<T>()));
    return true;
  }
};

}  // namespace

TEST_CASE("The Jacobians of a preintegrated motion's residual are right") {
  testing::Random random(1);
  const auto imu = preintegrated<double>(1, 30, bias, noise);
  const CeresPreintegrationResidual cost(imu, gravity);
  const Functor functor{square_root_information(imu.covariance())};
  for (const double angle : {0.0, 1e-8, 1e-3, 1.0, 3.0}) {
    INFO("attitude off by " << angle);
    const State i = origin(random);
    State j{InertialFrame{}.advance(i.nav, imu.delta(), gravity, 1.3), i.biases};
    j = moved(j, angle, 0.3, random);
    testing::Parameters p;
    add(p, moved(i, 0, 0.1, random));
    add(p, j);
    CHECK(testing::compare_with_jets(cost, functor, p) <= 64);
    if (angle >= 1) testing::check_gradients(cost, p);
  }
}

TEST_CASE("The weight is the square root of the inverse of the covariance") {
  const auto imu = preintegrated<double>(1, 30, bias, noise);
  const Eigen::Matrix<double, 15, 15> P = imu.covariance().matrix(), W = square_root_information(imu.covariance());
  CHECK((W * P * W.transpose() - Eigen::Matrix<double, 15, 15>::Identity()).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(W.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().isZero(0));
}

TEST_CASE("What the IMU has measured itself has no residual") {
  testing::Random random(2);
  const auto imu = preintegrated<double>(1, 30, bias, noise);
  const State i = origin(random);
  testing::Parameters p;
  add(p, i);
  add(p, {InertialFrame{}.advance(i.nav, imu.delta(), gravity, 1.3), i.biases});
  // Rounding of positions of 10 m, weighed by up to 1e5.
  CHECK(testing::evaluate_cost(CeresPreintegrationResidual(imu, gravity), p).residuals.norm() < 1e-8);
}

TEST_CASE("A covariance without an inverse is refused, and what it lacks is said") {
  const auto message_of = [](int steps, const ImuNoise<double>& densities) -> std::string {
    try {
      const CeresPreintegrationResidual cost(preintegrated<double>(1, steps, bias, densities), gravity);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const std::string end = "; expected noise densities > 0 and at least two steps";
  const std::string begin = "square_root_information: the covariance is singular, ";
  CHECK(message_of(2, noise).empty());
  CHECK(message_of(1, noise) == begin + "position component 0 is determined by the components before it" + end);
  CHECK(message_of(0, noise) == begin + "attitude component 0 has no variance" + end);
  CHECK(message_of(30, {0, 2e-3, 0, 3e-3}) == begin + "attitude component 0 has no variance" + end);
  CHECK(message_of(30, {2e-4, 2e-3, 0, 3e-3}) == begin + "gyro bias component 0 has no variance" + end);
  CHECK(message_of(30, {2e-4, 2e-3, 2e-5, 0}) == begin + "accel bias component 0 has no variance" + end);
  CHECK(!message_of(30, {2e-4, std::numeric_limits<double>::quiet_NaN(), 2e-5, 1}).empty());
}

// Three states in a row, the first and the last known: the middle one, and the biases, follow.
TEST_CASE("Ceres finds the state between two known ones, and the biases") {
  testing::Random random(3);
  const ImuBias<double> wrong{{0, 0, 0}, {0, 0, 0}};  // what it is preintegrated with
  std::array<State, 3> truth{origin(random), {}, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto exact = preintegrated<double>(1 + 0.3 * static_cast<double>(k), 30, bias);
    truth[k + 1] = {InertialFrame{}.advance(truth[k].nav, exact.delta(), gravity, 0.0), as_vector(bias)};
  }
  std::array<State, 3> guess = truth;
  guess[1] = moved(truth[1], 0.5, 1, random);
  for (State& s : guess) s.biases.setZero();

  ceres::Problem problem;
  for (State& s : guess) {
    problem.AddParameterBlock(s.nav.R_WB.data(), 4, new CeresManifold<Sophus::SO3d>);
    for (double* block : {s.nav.v_WB.data(), s.nav.p_WB.data()}) problem.AddParameterBlock(block, 3);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    auto blocks = guess[k].blocks();
    for (double* block : guess[k + 1].blocks()) blocks.push_back(block);
    problem.AddResidualBlock(new CeresPreintegrationResidual(
                                 preintegrated<double>(1 + 0.3 * static_cast<double>(k), 30, wrong, noise), gravity),
                             nullptr, blocks);
  }
  for (State* known : {&guess[0], &guess[2]}) {
    for (double* block : {known->nav.R_WB.data(), known->nav.v_WB.data(), known->nav.p_WB.data()}) {
      problem.SetParameterBlockConstant(block);
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-16;
  options.max_num_iterations = 100;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  INFO(summary.BriefReport());
  CHECK(summary.IsSolutionUsable());
  // The correction for biases is of first order: (|d| t)²/2 of a second order is left, d = 0.04 rad/s, t = 0.3 s.
  CHECK(increment(guess[1].nav.R_WB, truth[1].nav.R_WB).norm() < 1e-4);
  CHECK((guess[1].nav.v_WB - truth[1].nav.v_WB).norm() < 1e-3);
  CHECK((guess[1].nav.p_WB - truth[1].nav.p_WB).norm() < 1e-3);
  for (const State& s : guess) CHECK((s.biases - as_vector(bias)).norm() < 1e-2);
}
