// SPDX-License-Identifier: MIT
// What evaluating and linearizing a spline costs: by group, order and derivative, beside a hand-written loop and, where
// Ceres is installed, beside automatic differentiation.
//
// Workload: 100 control points 0.1 s apart, rotation increments up to 0.5 rad, positions ~ N(0, 1) m, calls at random
// times.

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/with_scalar.hpp>
#include <splinertia/spline/linearize.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/harness.hpp"
#if __has_include(<ceres/jet.h>)
#include <ceres/jet.h>
#endif

using namespace splinertia;
using namespace splinertia::detail;

namespace {

struct Workload {
  std::vector<Sophus::SO3d> rotations;
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> phases;  // in [0, 1): where the calls are in the domain

  Workload() {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(-0.29, 0.29), phase(0, 1);
    Sophus::SO3d R;
    for (int i = 0; i < 100; ++i) {
      R = GroupTraits<Sophus::SO3d>::compose(R,
                                             GroupTraits<Sophus::SO3d>::exp({angle(bits), angle(bits), angle(bits)}));
      rotations.push_back(R);
      positions.emplace_back(normal(bits), normal(bits), normal(bits));
    }
    for (int i = 0; i < 4096; ++i) phases.push_back(phase(bits));
  }

  template <typename G>
  [[nodiscard]] std::vector<G> control_points() const {
    std::vector<G> points;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      if constexpr (std::same_as<G, Sophus::SO3d>) {
        points.push_back(rotations[i]);
      } else if constexpr (std::same_as<G, Eigen::Vector3d>) {
        points.push_back(positions[i]);
      } else if constexpr (std::same_as<G, Sophus::SE2d>) {
        points.push_back(Sophus::SE2d(0.3 * static_cast<double>(i), positions[i].head<2>()));
      } else {
        points.push_back(make_pose<G>(rotations[i], positions[i]));
      }
    }
    return points;
  }
};

const Workload& workload() {
  static const Workload the;
  return the;
}

/// Calls f(t) at random times of the curve.
template <typename Curve>
void at_random_times(const Curve& curve, std::size_t calls, const auto& f) {
  const auto& phases = workload().phases;
  const double start = curve.start(), length = curve.end() - curve.start();
  for (std::size_t i = 0; i < calls; ++i) f(start + length * phases[i % phases.size()]);
}

template <typename G, int Order, typename K = UniformKnots<double>>
std::shared_ptr<const Spline<G, Order, K>> make_curve() {
  if constexpr (std::same_as<K, UniformKnots<double>>) {
    return std::make_shared<Spline<G, Order>>(K{0.0, 0.1}, workload().control_points<G>());
  } else {
    K knots;
    for (int i = 0; i < 100 + Order; ++i) knots.knots.push_back(0.1 * i);
    return std::make_shared<Spline<G, Order, K>>(knots, workload().control_points<G>());
  }
}

template <typename G, int Order, int D, typename K = UniformKnots<double>>
benchmark::Kernel evaluation(const std::string& name) {
  return {name, [curve = make_curve<G, Order, K>()](std::size_t calls) {
            at_random_times(*curve, calls, [&](double t) { benchmark::keep(curve->template evaluate<D>(t)); });
          }};
}

template <typename G, int Order, int D>
benchmark::Kernel linearization(const std::string& name) {
  return {name, [curve = make_curve<G, Order>()](std::size_t calls) {
            at_random_times(*curve, calls, [&](double t) { benchmark::keep(curve->template linearize<D>(t)); });
          }};
}

/// From control points alone, as an optimiser has them: with logarithms.
template <typename G, int Order, int D>
benchmark::Kernel on_span(const std::string& name, const auto& f) {
  return {name, [curve = make_curve<G, Order>(), f](std::size_t calls) {
            at_random_times(*curve, calls, [&](double t) {
              const auto place = curve->knots().template basis<double, Order, D>(t, curve->control_points().size());
              benchmark::keep(
                  f(std::span<const G, Order>(curve->control_points().data() + place.first, Order), place.basis));
            });
          }};
}

/// The value of a cubic on SO(3), written by hand on plain numbers, with no type of the spline in it.
benchmark::Kernel by_hand() {
  struct Points {
    std::vector<Eigen::Quaterniond> q;
    std::vector<Eigen::Vector3d> d;
  };
  auto points = std::make_shared<Points>();
  for (const auto& R : workload().rotations) points->q.push_back(R.unit_quaternion());
  for (std::size_t i = 0; i + 1 < points->q.size(); ++i) {
    points->d.push_back(rotation_increment<double>(points->q[i], points->q[i + 1]));
  }
  return {"so3_order4_value_by_hand", [points, curve = make_curve<Sophus::SO3d, 4>()](std::size_t calls) {
            at_random_times(*curve, calls, [&](double t) {
              const double s = t / 0.1;
              std::size_t i = std::min(static_cast<std::size_t>(s), points->q.size() - 4);
              double rest = std::fma(-static_cast<double>(i), 0.1, t);
              if (rest < 0 && i > 0) rest = std::fma(-static_cast<double>(--i), 0.1, t);
              const double u = rest / 0.1;
              const double sixth = 1.0 / 6;
              const double lambda[] = {(((u - 3) * u + 3) * u + 5) * sixth, (((-2 * u + 3) * u + 3) * u + 1) * sixth,
                                       u * u * u * sixth};
              const Eigen::Quaterniond a = rotation_exp<double>(lambda[0] * points->d[i]);
              const Eigen::Quaterniond b = rotation_exp<double>(lambda[1] * points->d[i + 1]);
              const Eigen::Quaterniond c = rotation_exp<double>(lambda[2] * points->d[i + 2]);
              benchmark::keep(quaternion_product(points->q[i], quaternion_product(a, quaternion_product(b, c))));
            });
          }};
}

#if __has_include(<ceres/jet.h>)
/// The work of linearize<2> by forward-mode automatic differentiation through evaluate<2>.
template <typename G>
benchmark::Kernel automatic(const std::string& name) {
  constexpr int dof = DofOf<G>;
  using Jet = ceres::Jet<double, 4 * dof>;
  using H = WithScalar<G, Jet>;
  return {name, [curve = make_curve<G, 4>()](std::size_t calls) {
            at_random_times(*curve, calls, [&](double t) {
              const auto place = curve->knots().template basis<double, 4, 2>(t, curve->control_points().size());
              CumulativeBasis<Jet, 4, 2> basis;
              for (std::size_t m = 0; m < 3; ++m) {
                for (std::size_t j = 0; j < 3; ++j) basis.lambda[m][j] = Jet(place.basis.lambda[m][j]);
              }
              std::array<H, 4> points;
              for (std::size_t i = 0; i < 4; ++i) {
                const G& x = curve->control_points()[place.first + i];
                H at;
                for (int n = 0; n < G::num_parameters; ++n) at.data()[n] = Jet(x.data()[n]);
                Tangent<H> delta;
                for (int k = 0; k < dof; ++k) delta[k] = Jet(0.0, static_cast<int>(i) * dof + k);
                points[i] = GroupTraits<H>::compose(at, GroupTraits<H>::exp(delta));
              }
              benchmark::keep(evaluate<2>(std::span<const H, 4>(points), basis));
            });
          }};
}
#endif

}  // namespace

int main(int argc, char** argv) {
  using SO3 = Sophus::SO3d;
  using SE3 = Sophus::SE3d;
  using Split = SO3xR3<double>;
  using R3 = Eigen::Vector3d;
  using NonUniform = NonUniformKnots<double>;
  std::vector<benchmark::Kernel> kernels{
      by_hand(),
      evaluation<SO3, 4, 0>("so3_order4_evaluate0"),
      evaluation<SO3, 4, 1>("so3_order4_evaluate1"),
      evaluation<SO3, 4, 2>("so3_order4_evaluate2"),
      evaluation<SO3, 4, 3>("so3_order4_evaluate3"),
      evaluation<SO3, 2, 2>("so3_order2_evaluate2"),
      evaluation<SO3, 3, 2>("so3_order3_evaluate2"),
      evaluation<SO3, 5, 2>("so3_order5_evaluate2"),
      evaluation<SO3, 6, 2>("so3_order6_evaluate2"),
      evaluation<SO3, 7, 2>("so3_order7_evaluate2"),
      evaluation<SO3, 8, 2>("so3_order8_evaluate2"),
      evaluation<R3, 4, 2>("r3_order4_evaluate2"),
      evaluation<Sophus::SE2d, 4, 2>("se2_order4_evaluate2"),
      evaluation<Split, 4, 2>("so3xr3_order4_evaluate2"),
      evaluation<SE3, 4, 0>("se3_order4_evaluate0"),
      evaluation<SE3, 4, 1>("se3_order4_evaluate1"),
      evaluation<SE3, 4, 2>("se3_order4_evaluate2"),
      evaluation<SO3, 4, 2, NonUniform>("so3_order4_nonuniform_evaluate2"),
      on_span<SO3, 4, 2>("so3_order4_span_evaluate2",
                         [](const auto& points, const auto& basis) { return evaluate<2>(points, basis); }),
      linearization<SO3, 4, 0>("so3_order4_linearize0"),
      linearization<SO3, 4, 1>("so3_order4_linearize1"),
      linearization<SO3, 4, 2>("so3_order4_linearize2"),
      linearization<SO3, 6, 2>("so3_order6_linearize2"),
      linearization<SO3, 8, 2>("so3_order8_linearize2"),
      linearization<Split, 4, 2>("so3xr3_order4_linearize2"),
      linearization<SE3, 4, 2>("se3_order4_linearize2"),
      on_span<SO3, 4, 2>("so3_order4_span_linearize2",
                         [](const auto& points, const auto& basis) { return linearize<2>(points, basis); }),
      on_span<SE3, 4, 2>("se3_order4_span_linearize2",
                         [](const auto& points, const auto& basis) { return linearize<2>(points, basis); }),
  };
#if __has_include(<ceres/jet.h>)
  kernels.push_back(automatic<SO3>("so3_order4_span_jets2"));
  kernels.push_back(automatic<SE3>("se3_order4_span_jets2"));
#endif
  return benchmark::run(argc, argv, "Costs of evaluating and linearizing splines.", kernels);
}
