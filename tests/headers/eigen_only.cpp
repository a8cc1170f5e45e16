// SPDX-License-Identifier: MIT
// A curve on R² without Sophus: all that is done with curves is done once.
#include <eigen_only.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

#if __has_include(<sophus/se3.hpp>)
#error This test is about programs without Sophus, and Sophus is among the include folders.
#endif

using namespace splinertia;
using namespace splinertia::detail;
using Point = Eigen::Vector2d;
using Uniform = Spline<Point, 4>;
using NonUniform = Spline<Point, 4, NonUniformKnots<double>>;

namespace {

int faults = 0;

void check(const char* what, double off, double allowed) {
  if (off <= allowed) return;
  std::printf("%s is off by %g\n", what, off);
  ++faults;
}

Point truth(double t) { return {std::cos(t), std::sin(2 * t)}; }

}  // namespace

int main() {
  std::vector<Stamped<Point, double>> points;
  for (int i = 0; i <= 100; ++i) points.push_back({0.05 * i, truth(0.05 * i)});

  const auto fitted = fit<Uniform>(points, {.knot_interval = 0.1});
  check("fit", (fitted.spline.evaluate<0>(2.03).value - truth(2.03)).norm(), 1e-4);
  const auto chosen = fit<Uniform>(points, {.loss = RobustLoss::cauchy()});
  check("fit, robust", (chosen.spline.evaluate<0>(2.03).value - truth(2.03)).norm(), 1e-3);
  const auto adaptive = adaptive_fit<NonUniform>(points, Point::Constant(1e-3));
  check("adaptive_fit", (adaptive.spline.evaluate<0>(2.03).value - truth(2.03)).norm(), 1e-2);
  const auto through = interpolate<NonUniform>(points);
  check("interpolate", (through.evaluate<0>(points[30].time).value - points[30].value).norm(), 1e-12);

  const auto samples = sample<2>(fitted.spline, 0.0, 0.01, 500);
  check("sample", (samples[203].acceleration - fitted.spline.evaluate<2>(2.03).acceleration).norm(), 1e-9);

  std::vector<const double*> blocks;
  const auto linearization = fitted.spline.linearize<1>(2.03);
  for (std::size_t j = 0; j < 4; ++j) {
    blocks.push_back(fitted.spline.control_points()[linearization.first + j].data());
  }
  const auto& knots = fitted.spline.knots();
  const auto at = knots.basis<double, 4, 1>(2.03, fitted.spline.control_points().size());
  check("parameter blocks", (evaluate<1, Point>(blocks.data(), at.basis).velocity - linearization.velocity).norm(),
        1e-12);
  check("parameter blocks, Jacobian",
        (linearize<1, Point>(blocks.data(), at.basis).velocity_jacobian[2] - linearization.velocity_jacobian[2]).norm(),
        1e-12);
  return faults == 0 ? 0 : 1;
}
