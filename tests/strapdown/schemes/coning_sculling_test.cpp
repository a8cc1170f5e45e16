// SPDX-License-Identifier: MIT
#include <array>
#include <splinertia/motion/coning.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "strapdown/stamp_patterns.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Increment = ImuIncrement<>;

/// How far the attitude has drifted about the axis of the cone after 20 s, rad.
template <typename Scheme>
double coning_drift(double rate) {
  const Coning<> motion{.angle = 0.1, .rate = 5};
  std::vector<double> stamps;
  for (int i = 0; i <= 20 * rate; ++i) stamps.push_back(i / rate);
  const auto states = integrate<Scheme>(nav_state(motion.evaluate<1>(0), 0.0), testing::increments(motion, stamps));
  const auto truth = rotation(motion.evaluate<0>(states.back().time).value);
  return std::abs((states.back().R_WB * truth.inverse()).log().z());
}

}  // namespace

TEST_CASE("Increments without correction converge with order 1") {
  testing::check_order<UncorrectedIncrements>(1, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<UncorrectedIncrements>(1);
  CHECK(testing::aggressive_error<UncorrectedIncrements>(testing::regular_stamps(200)) < 9.9);
}

TEST_CASE("Increments with the rotation of the axes converge with order 2") {
  testing::check_order<RotationCorrectedIncrements>(2, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<RotationCorrectedIncrements>(2);
  CHECK(testing::aggressive_error<RotationCorrectedIncrements>(testing::regular_stamps(200)) < 0.43);
}

TEST_CASE("Two increments at a time converge with order 4, whatever the intervals") {
  testing::check_order<TwoSampleIncrements>(4, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<TwoSampleIncrements>(4);
  CHECK(testing::aggressive_error<TwoSampleIncrements>(testing::regular_stamps(200)) < 2.35e-3);
}

TEST_CASE("Three increments at a time converge with order 4") {
  testing::check_order<ThreeSampleIncrements>(4, testing::regular_stamps);
  CHECK(testing::aggressive_error<ThreeSampleIncrements>(testing::regular_stamps(200)) < 1e-2);
}

TEST_CASE("Two increments left of three, or one left of two, keep order 4") {
  for (std::size_t missing = 1; missing <= 2; ++missing) {
    const auto stamps_at = [&](double rate) {
      auto stamps = testing::regular_stamps(rate);
      stamps.resize(stamps.size() - missing);
      return stamps;
    };
    testing::check_order<TwoSampleIncrements>(4, stamps_at);
    testing::check_order<ThreeSampleIncrements>(4, stamps_at);
  }
}

TEST_CASE("On coning each correction drifts less than the one before") {
  const double none = coning_drift<UncorrectedIncrements>(30), two = coning_drift<TwoSampleIncrements>(30),
               three = coning_drift<ThreeSampleIncrements>(30);
  INFO(none << " " << two << " " << three);
  CHECK(two < none / 100);
  CHECK(three < two / 10);
  // Of three the drift is of a higher order than other errors: Miller's coefficients are made for it.
  CHECK_THAT(std::log2(two / coning_drift<TwoSampleIncrements>(60)), WithinAbs(4, 0.1));
  CHECK_THAT(std::log2(three / coning_drift<ThreeSampleIncrements>(60)), WithinAbs(6, 0.2));
}

TEST_CASE("The rotation of two equal increments is Miller's") {
  using Step = StepMean<double>;
  const Eigen::Vector3d a(0.01, 0.02, -0.03), b(0.02, -0.01, 0.01), zero(0, 0, 0);
  const std::array<Step, 3> window{Step{a, zero, 0.5}, Step{b, zero, 0.5}, Step{a + b, zero, 0.5}};
  const auto omega = magnus4(TwoSampleIncrements::moments<double>(window, 0));
  CHECK((omega.phi - (a + b + 2.0 / 3.0 * a.cross(b))).norm() < 1e-17);
  CHECK(omega.tau == 1);
}

TEST_CASE("The moments of increments are exact for parabolas, of two equal ones without looking at a third") {
  // A(t) = t² e + t u: integral t³/3 e + t²/2 u.
  using Step = StepMean<double>;
  const Eigen::Vector3d e(1, 2, -1), u(0.5, 1, 3);
  const auto integral = [&](double t) -> Eigen::Vector3d { return e * (t * t * t / 3) + u * (t * t / 2); };
  const auto moment = [&](double a, double b) -> Eigen::Vector3d {
    // ∫ (t − m) A dt/h
    const double m = (a + b) / 2, h = b - a;
    const auto with_t = [&](double t) -> Eigen::Vector3d { return e * (t * t * t * t / 4) + u * (t * t * t / 3); };
    return (with_t(b) - with_t(a) - m * (integral(b) - integral(a))) / h;
  };
  const auto step = [&](double a, double b) {
    return Step{integral(b) - integral(a), 2 * (integral(b) - integral(a)), b - a};
  };
  const std::array<double, 4> t{0.2, 0.5, 1.25, 1.5};
  const std::array<Step, 3> window{step(t[0], t[1]), step(t[1], t[2]), step(t[2], t[3])};
  for (std::size_t from = 0; from < 3; ++from) {
    const double a = t[from], b = from == 2 ? t[3] : t[from + 2];
    const auto m = TwoSampleIncrements::moments<double>(window, from);
    CHECK_THAT(m.interval, WithinAbs(b - a, 1e-16));
    CHECK((m.phi - (integral(b) - integral(a))).norm() < 1e-15);
    CHECK((m.phi_moment - moment(a, b)).norm() < 2e-15);
    CHECK((m.nu_moment - 2 * moment(a, b)).norm() < 4e-15);
  }
  const std::array<Step, 3> equal{Step{{NAN, NAN, NAN}, {NAN, NAN, NAN}, 0}, step(1, 2), step(2, 3)};
  CHECK((TwoSampleIncrements::moments<double>(equal, 1).phi_moment - moment(1, 3)).norm() < 1e-14);
  CHECK(TwoSampleIncrements::moments<double>(std::array<Step, 3>{equal[0], equal[0], step(1, 2)}, 2).phi_moment ==
        Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("Three increments at a time are refused where they are unequal") {
  const NavState<double> initial{{}, {0, 0, 0}, {0, 0, 0}, 0};
  const auto at = [](double t) { return Increment{t, {0, 0, 0}, {0, 0, 0}}; };
  CHECK_THROWS_WITH(integrate<ThreeSampleIncrements>(initial, std::vector{at(0.5), at(1), at(1.75)}),
                    "integrate: sample 2 at 1.75 comes 0.75 s after the one before, expected 0.5 s: the scheme needs "
                    "equal intervals");
  CHECK_NOTHROW(integrate<ThreeSampleIncrements>(initial, std::vector{at(0.5), at(1), at(1.504)}));
}

TEMPLATE_TEST_CASE("Two increments at a time are off by at most twice as much as single ones, whatever the stamps", "",
                   float, double) {
  testing::check_never_amplifies<TwoSampleIncrements, RotationCorrectedIncrements, TestType>();
}
