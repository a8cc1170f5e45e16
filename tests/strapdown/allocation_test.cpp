// SPDX-License-Identifier: MIT
// Integrating allocates nothing: counted in operator new, and refused by Eigen.
#define EIGEN_RUNTIME_NO_MALLOC
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/rotating_frame.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::allocations, testing::allocations_of;

TEMPLATE_TEST_CASE("Integrating allocates nothing", "", Euler, ZeroOrderHold, Midpoint, Trapezoid, RungeKutta4,
                   RungeKutta4DoubleStep, Magnus4, UncorrectedIncrements, RotationCorrectedIncrements,
                   TwoSampleIncrements, ThreeSampleIncrements) {
  const testing::AggressiveMotion<> motion;
  const auto stamps = testing::regular_stamps(10);
  const auto samples = [&] {
    if constexpr (TestType::takes_increments) {
      return testing::increments(motion, stamps);
    } else {
      return testing::point_samples(motion, stamps);
    }
  }();
  const auto initial = nav_state(motion.evaluate<1>(0), 0.0);
  CHECK(allocations > 0);  // the counter counts
  double sum = 0;
  const auto visit = [&](const NavState<double>& state) { sum += state.p_WB.norm(); };
  CHECK(allocations_of([&] {
          Integrator<TestType, double> integrator(initial);
          for (const auto& sample : samples) integrator.push(sample, visit);
          integrator.finish(visit);
        }) == 0);
  CHECK(allocations_of([&] { integrate<TestType>(initial, samples, standard_gravity<double>(), visit); }) == 0);
  const IntegrationOptions<double, RotatingFrame<double>> turning{.frame = {{0, 0, 0.1}}};
  CHECK(allocations_of([&] { integrate<TestType>(initial, samples, standard_gravity<double>(), visit, turning); }) ==
        0);
  CHECK(sum > 0);
}
