// SPDX-License-Identifier: MIT
// What is made of temporaries outlives them: what is kept by reference refuses them, everything else owns what it
// keeps. Compiled with the address sanitizer where there is one, else these tests say little.
#include <cmath>
#include <splinertia/splinertia.hpp>
#include <splinertia/strapdown/inertial_fit.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
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
Spline<SO3xR3<double>, 4> pose_curve() {
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 20; ++i) points.push_back({Sophus::SO3d::exp({0.1 * i, 0, 0}), {std::cos(0.2 * i), 0, 1}});
  return {{.start = 0, .interval = 0.1}, points};
}

template <typename T, typename... Given>
constexpr bool takes = std::is_constructible_v<T, Given...>;
template <typename Problem>
concept LendsPoses = requires(Problem&& problem) { std::forward<Problem>(problem).pose_term(RobustLoss::squares()); };

}  // namespace

TEST_CASE("A fit keeps its poses and options") {
  FitProblem<Curve> problem(poses(), {.knot_interval = 0.1, .weights = Weights(40, 1.0)});
  const Weights other(1000, 7.0);  // where temporaries were
  problem.solve();
  CHECK(std::move(problem).report(problem.curve()).converged);
}

TEST_CASE("A fit of an Allan curve needs that no longer") {
  const allan::CurveFit<double> fit(allan::overlapping(signal(), 100.0));
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
  const allan::Identification<double> identification(Spectra{spectrum(), spectrum()}, options);
  const std::vector<double> other(1000, 7.0);
  CHECK(identification.estimates().N.value > 0);
  STATIC_CHECK_FALSE(std::is_copy_constructible_v<allan::Identification<double>>);
  STATIC_CHECK_FALSE(std::is_move_constructible_v<allan::Identification<double>>);
}

TEST_CASE("Rows of temporary samples are copies") {
  const auto values = sample<1>(pose_curve(), 0.0, 0.01, 100).value();
  const auto velocity = sample<1>(pose_curve(), 0.0, 0.01, 100).velocity();
  const auto gyro = sample_imu(pose_curve(), 0.0, 0.01, 100).gyro();
  const std::vector<double> other(10000, 7.0);
  CHECK_THAT(velocity(0, 50), WithinAbs(1, 1e-9));
  CHECK_THAT(gyro(0, 50), WithinAbs(1, 1e-9));
  CHECK(values.cols() == 100);

  // Of samples that stay they are views.
  const auto samples = sample<1>(pose_curve(), 0.0, 0.01, 100);
  CHECK(samples.velocity().data() == samples.velocity().data());
}

TEST_CASE("A simulation keeps a motion that is a temporary, and its sensors and options") {
  const auto readings = simulate(pose_curve(), Imu{ErrorModel{WhiteNoise{1e-3}}, ErrorModel{}}, {.rate = 100});
  const std::vector<double> other(1000, 7.0);
  std::size_t count = 0;
  for (const auto& reading : readings) count += reading.gyro.allFinite() ? 1 : 0;
  CHECK(count == readings.size());
}

TEST_CASE("What keeps a reference takes no temporary") {
  using Term = PoseTerm<Curve>;
  STATIC_CHECK(takes<Term, Poses&, Weights&, Eigen::Vector3d, RobustLoss>);
  STATIC_CHECK_FALSE(takes<Term, Poses, Weights&, Eigen::Vector3d, RobustLoss>);
  STATIC_CHECK_FALSE(takes<Term, Poses&, Weights, Eigen::Vector3d, RobustLoss>);
  STATIC_CHECK(LendsPoses<FitProblem<Curve>&>);
  STATIC_CHECK_FALSE(LendsPoses<FitProblem<Curve>>);

  using Model = CurveModel<Curve, 3, Term, EndTerm<Curve>>;
  STATIC_CHECK(takes<Model, const Term&, const EndTerm<Curve>&>);
  STATIC_CHECK_FALSE(takes<Model, Term, const EndTerm<Curve>&>);
  STATIC_CHECK_FALSE(takes<Model, const Term&, EndTerm<Curve>>);
  STATIC_CHECK_FALSE(takes<AccelerationDensity<Curve>, Curve, Eigen::Vector3d>);

  using Spans = std::vector<UnmeasuredSpan<double>>;
  using V = Eigen::Vector3d;
  STATIC_CHECK(takes<GapBridges<Curve>, Curve&, Spans&, V, V, double, Weights&>);
  STATIC_CHECK_FALSE(takes<GapBridges<Curve>, Curve, Spans&, V, V, double, Weights&>);
  STATIC_CHECK_FALSE(takes<GapBridges<Curve>, Curve&, Spans, V, V, double, Weights&>);
  STATIC_CHECK_FALSE(takes<GapBridges<Curve>, Curve&, Spans&, V, V, double, Weights>);

  using PoseCurve = Spline<SO3xR3<double>, 4>;
  using Inertial = InertialTerm<PoseCurve>;
  STATIC_CHECK(takes<InertialModel<PoseCurve, PoseTerm<PoseCurve>>, Inertial&, PoseTerm<PoseCurve>&>);
  STATIC_CHECK_FALSE(takes<InertialModel<PoseCurve, PoseTerm<PoseCurve>>, Inertial, PoseTerm<PoseCurve>&>);
  STATIC_CHECK_FALSE(takes<InertialModel<PoseCurve, PoseTerm<PoseCurve>>, Inertial&, PoseTerm<PoseCurve>>);
  STATIC_CHECK_FALSE(takes<CalibrationModel<PoseCurve>, Inertial, PoseCurve&>);
  STATIC_CHECK_FALSE(takes<CalibrationModel<PoseCurve>, Inertial&, PoseCurve>);

  using allan::NoiseTerms;
  using Fit = allan::SpectralFit<double>;
  using Spectrum = allan::PooledSpectrum<double>;
  using Likelihood = allan::ModelLikelihood<double>;
  using Selection = allan::ModelSelection<double>;
  STATIC_CHECK(takes<Fit, Spectrum&, std::vector<bool>>);
  STATIC_CHECK_FALSE(takes<Fit, Spectrum, std::vector<bool>>);
  STATIC_CHECK_FALSE(takes<Likelihood, Fit>);
  STATIC_CHECK_FALSE(takes<Selection, Fit, NoiseTerms>);
  STATIC_CHECK_FALSE(takes<allan::ModelEstimates<double>, Selection, double, NoiseTerms>);
  STATIC_CHECK_FALSE(takes<allan::ProfileLikelihood<double>, Likelihood, NoiseTerms, Fit::Result>);
  STATIC_CHECK_FALSE(takes<allan::BandSelection<double>, Spectrum, double, std::vector<allan::Interval<double>>>);
  STATIC_CHECK_FALSE(takes<allan::StepSearch<double>, allan::IntegratedSignal<double>, allan::StepOptions>);
  STATIC_CHECK_FALSE(takes<allan::StepFitter, std::vector<double>>);
}
