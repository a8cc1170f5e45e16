// SPDX-License-Identifier: MIT
// An integration scheme of your own is a type that turns neighbouring samples into the motion over a step. This one
// holds the later of two samples; Euler's scheme holds the earlier.

#include <cstdio>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>

using namespace splinertia;

struct BackwardEuler : PointScheme<2> {  // looks at two samples
  /// The integrals of rate and specific force over the step from window[from] to the next sample.
  template <typename Scalar, typename Window>
  static StepMean<Scalar> moments(const Window& window, std::size_t from) {
    const Scalar h = step_interval<Scalar>(window, from);
    return {window[from + 1].gyro * h, window[from + 1].accel * h, h};
  }
};
static_assert(IntegrationScheme<BackwardEuler, double, double>);

int main() {
  const Ellipse<> truth;
  std::puts("rate [Hz]  error after 20 s [m]");
  for (const double rate : {100.0, 200.0, 400.0}) {  // first order: half the interval, half the error
    const auto samples = simulate(truth, Imu{}, {.rate = rate, .start = 0.0, .end = 20.0});
    const auto states = integrate<BackwardEuler>(nav_state(truth.evaluate<1>(0.0), 0.0), samples);
    std::printf("%9.0f  %.3f\n", rate, (states.back().p_WB - position(truth.evaluate<0>(20.0).value)).norm());
  }
}

// prints
// rate [Hz]  error after 20 s [m]
//       100  1.948
//       200  0.974
//       400  0.487
