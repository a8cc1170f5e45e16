// SPDX-License-Identifier: MIT
// What is made of temporaries outlives them: it owns what it keeps. Compiled with the address sanitizer where there is
// one, else these tests say little. In long double nothing is done in lanes or inlined as a whole, which the sanitizer
// would take minutes to compile.
#include <cmath>
#include <splinertia/splinertia.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Curve = Spline<Eigen::Vector3d, 4>;
using Poses = PosesOf<Curve>;
using Weights = std::vector<double>;

namespace {

Poses poses() {
  Poses made;
  for (int i = 0; i < 40; ++i) made.push_back({0.05 * i, {std::sin(0.1 * i), std::cos(0.1 * i), 0}});
  return made;
}
std::vector<double> signal() {
  std::vector<double> made;
  for (int i = 0; i < 4096; ++i) made.push_back(std::sin(1e3 * i * i));
  return made;
}
using Pose3 = SO3xR3<long double>;
Spline<Pose3, 4> pose_curve() {
  using R3 = Eigen::Vector3<long double>;
  std::vector<Pose3> points;
  for (int i = 0; i < 20; ++i) points.push_back({Sophus::SO3<long double>::exp(R3(0.1L * i, 0, 0)), R3(i, 0, 1)});
  return {{.start = 0, .interval = 0.1}, points};
}

}  // namespace

TEST_CASE("A fit keeps its poses and options") {
  FitProblem<Curve> problem(poses(), {.knot_interval = 0.1, .weights = Weights(40, 1.0)});
  const Weights other(1000, 7.0);  // where temporaries were
  problem.solve();
  CHECK(std::move(problem).report(problem.curve()).converged);
}

TEST_CASE("A fit of an Allan curve needs that no longer") {
  const allan::DeviationFit<double> fit(allan::overlapping(signal(), 100.0));
  const std::vector<double> other(1000, 7.0);
  CHECK(fit.fit(allan::NoiseTerms::all()).theta.allFinite());
}

TEST_CASE("An Allan curve keeps the name that it is given") {
  auto curve = allan::overlapping(signal(), 100.0);
  curve.name = std::string(40, 'x');
  const std::string other(40, 'y');
  CHECK(curve.name == std::string(40, 'x'));
}

TEST_CASE("An identification keeps the spectra of its axes, and stays where it is") {
  using Spectra = std::vector<allan::DifferenceSpectrum<double>>;
  const auto spectrum = [] {
    return allan::DifferenceSpectrum<double>(allan::IntegratedSignal<double>(signal(), 100.0));
  };
  const allan::IdentifyOptions<double> options{
      .candidates = allan::NoiseTerms{allan::NoiseTerm::white, allan::NoiseTerm::random_walk}};
  const allan::detail::Identification<double> identification(Spectra{spectrum(), spectrum()}, options);
  const std::vector<double> other(1000, 7.0);
  CHECK(identification.estimates().N.value > 0);
  STATIC_CHECK_FALSE(std::is_copy_constructible_v<allan::detail::Identification<double>>);
  STATIC_CHECK_FALSE(std::is_move_constructible_v<allan::detail::Identification<double>>);
}

TEST_CASE("Rows of temporary samples are copies") {
  const auto values = sample<1>(pose_curve(), 0.0, 0.01, 100).value();
  const auto velocity = sample<1>(pose_curve(), 0.0, 0.01, 100).velocity();
  const auto gyro = sample_imu(pose_curve(), 0.0, 0.01, 100).gyro();
  const std::vector<double> other(10000, 7.0);
  CHECK(std::abs(velocity(0, 50) - 1) < 1e-9L);
  CHECK(std::abs(gyro(0, 50) - 1) < 1e-9L);
  CHECK(values.cols() == 100);

  // Of samples that stay they are views.
  const auto samples = sample<1>(pose_curve(), 0.0, 0.01, 100);
  CHECK(samples.velocity().data() == samples.velocity().data());
}

TEST_CASE("A simulation keeps a motion that is a temporary, and its sensors and options") {
  const auto readings = simulate(pose_curve(), Imu{ErrorModel{ConstantBias{1e-3L}}, ErrorModel{}}, {.rate = 100});
  const std::vector<double> other(1000, 7.0);
  std::size_t count = 0;
  for (const auto& reading : readings) count += reading.gyro.allFinite() ? 1 : 0;
  CHECK(count == readings.size());
}
