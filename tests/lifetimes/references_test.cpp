// SPDX-License-Identifier: MIT
// What keeps a reference takes no temporary.
#include <splinertia/calibration/inertial_fit.hpp>
#include <splinertia/splinertia.hpp>
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

template <typename T, typename... Given>
constexpr bool takes = std::is_constructible_v<T, Given...>;
template <typename Problem>
concept LendsPoses = requires(Problem&& problem) { std::forward<Problem>(problem).pose_term(RobustLoss::squares()); };

}  // namespace

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
  STATIC_CHECK(takes<GapRegularization<Curve>, Curve&, Spans&, V, V, double, Weights&>);
  STATIC_CHECK_FALSE(takes<GapRegularization<Curve>, Curve, Spans&, V, V, double, Weights&>);
  STATIC_CHECK_FALSE(takes<GapRegularization<Curve>, Curve&, Spans, V, V, double, Weights&>);
  STATIC_CHECK_FALSE(takes<GapRegularization<Curve>, Curve&, Spans&, V, V, double, Weights>);

  using PoseCurve = Spline<SO3xR3<double>, 4>;
  using Inertial = InertialTerm<PoseCurve>;
  STATIC_CHECK(takes<InertialModel<PoseCurve, PoseTerm<PoseCurve>>, Inertial&, PoseTerm<PoseCurve>&>);
  STATIC_CHECK_FALSE(takes<InertialModel<PoseCurve, PoseTerm<PoseCurve>>, Inertial, PoseTerm<PoseCurve>&>);
  STATIC_CHECK_FALSE(takes<InertialModel<PoseCurve, PoseTerm<PoseCurve>>, Inertial&, PoseTerm<PoseCurve>>);
  STATIC_CHECK_FALSE(takes<CalibrationModel<PoseCurve>, Inertial, PoseCurve&>);
  STATIC_CHECK_FALSE(takes<CalibrationModel<PoseCurve>, Inertial&, PoseCurve>);

  using allan::NoiseTerms;
  using Fit = allan::detail::SpectralFit<double>;
  using Spectrum = allan::detail::PooledSpectrum<double>;
  using Likelihood = allan::detail::ModelLikelihood<double>;
  using Selection = allan::detail::ModelSelection<double>;
  STATIC_CHECK(takes<Fit, Spectrum&, std::vector<bool>>);
  STATIC_CHECK_FALSE(takes<Fit, Spectrum, std::vector<bool>>);
  STATIC_CHECK_FALSE(takes<Likelihood, Fit>);
  STATIC_CHECK_FALSE(takes<Selection, Fit, NoiseTerms>);
  STATIC_CHECK_FALSE(takes<allan::detail::ModelEstimates<double>, Selection, double, NoiseTerms>);
  STATIC_CHECK_FALSE(takes<allan::detail::ProfileLikelihood<double>, Likelihood, NoiseTerms, Fit::Result>);
  STATIC_CHECK_FALSE(
      takes<allan::detail::BandSelection<double>, Spectrum, double, std::vector<allan::Interval<double>>>);
  STATIC_CHECK_FALSE(takes<allan::detail::StepSearch<double>, allan::IntegratedSignal<double>, allan::StepOptions>);
  STATIC_CHECK_FALSE(takes<allan::detail::StepFitter, std::vector<double>>);
}
