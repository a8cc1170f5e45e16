// SPDX-License-Identifier: MIT
/// What the residuals for Ceres are held against: Ceres' own gradient checker, and automatic differentiation of the
/// same library templates with ceres::Jet as their scalar.
#pragma once

#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/gradient_checker.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <splinertia/adapters/ceres_manifold.hpp>
#include <splinertia/group/with_scalar.hpp>
#include <splinertia/spline/parameter_blocks.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

#undef CHECK  // glog, which Ceres includes, has a macro of the same name
#define CHECK(...) INTERNAL_CATCH_TEST("CHECK", Catch::ResultDisposition::ContinueOnFailure, __VA_ARGS__)

namespace splinertia::testing {

using namespace splinertia::detail;

using splinertia::detail::with_scalar;

template <typename T, typename S, int Order, int D>
CumulativeBasis<T, Order, D> with_scalar(const CumulativeBasis<S, Order, D>& basis) {
  CumulativeBasis<T, Order, D> result;
  for (std::size_t m = 0; m <= D; ++m) {
    for (std::size_t j = 0; j + 1 < Order; ++j) result.lambda[m][j] = T(basis.lambda[m][j]);
  }
  return result;
}

/// How far neighbouring control points are apart: |rotation| = rotation exactly, translations of some metres.
struct Regime {
  std::string name;
  double rotation;
  double translation;
  /// Whether numeric differences tell anything: they miss entries of the size of a tiny step, and suffer near π.
  bool good_for_differences() const { return rotation == 0.5 || rotation == 0; }
};
inline std::vector<Regime> regimes() {
  constexpr double pi = std::numbers::pi;
  return {{"ordinary", 0.5, 1}, {"equal", 0, 0},           {"tiny", 1e-8, 1e-8},       {"small", 1e-4, 1e-3},
          {"large", 2.5, 1},    {"near pi", pi - 1e-3, 1}, {"nearer pi", pi - 1e-6, 1}};
}

/// Order control points with such steps in random directions.
template <LieGroup G>
std::vector<G> control_points(std::size_t count, const Regime& regime, Random& random) {
  std::vector<G> points = random.walk<G>(1);
  while (points.size() < count) {
    Tangent<G> tau = random.tangent<G>(regime.translation);
    const int rotation = RigidPose<G> ? 3 : 0;
    if constexpr (DofOf<G> >= 3 && !is_commutative<G>) {
      tau.template segment<3>(rotation) = regime.rotation * tau.template segment<3>(rotation).stableNormalized();
    }
    points.push_back(GroupTraits<G>::compose(points.back(), GroupTraits<G>::exp(tau)));
  }
  return points;
}

/// A residual's parameter blocks and their manifolds.
struct Parameters {
  std::vector<std::vector<double>> blocks;
  std::vector<std::unique_ptr<ceres::Manifold>> manifolds;

  template <LieGroup G>
  void add(const std::vector<G>& points) {
    for_each_part<G>([&]<std::size_t I>() {
      for (const G& x : points) {
        const auto& part = ControlPointParts<G>::template part<I>(x);
        using Part = std::remove_cvref_t<decltype(part)>;
        write_parameters<Part>(part, blocks.emplace_back(parameter_count<Part>).data());
        manifolds.push_back(std::make_unique<CeresManifold<Part>>());
      }
    });
  }
  void add(const Eigen::VectorXd& numbers) {
    blocks.emplace_back(numbers.begin(), numbers.end());
    manifolds.push_back(nullptr);
  }
  std::vector<const double*> pointers() const {
    std::vector<const double*> result;
    for (const auto& block : blocks) result.push_back(block.data());
    return result;
  }
};

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Evaluation {
  Eigen::VectorXd residuals;
  std::vector<Eigen::MatrixXd> jacobians;  // by the tangent of each block
};
inline Evaluation evaluate_cost(const ceres::CostFunction& cost, const Parameters& p) {
  const auto pointers = p.pointers();
  Evaluation e{Eigen::VectorXd(cost.num_residuals()), {}};
  std::vector<RowMajorMatrix> ambient;
  std::vector<double*> memory;
  for (const auto& block : p.blocks) ambient.emplace_back(cost.num_residuals(), block.size());
  for (auto& J : ambient) memory.push_back(J.data());
  REQUIRE(cost.Evaluate(pointers.data(), e.residuals.data(), memory.data()));
  for (std::size_t i = 0; i < ambient.size(); ++i) {
    if (p.manifolds[i] == nullptr) {
      e.jacobians.emplace_back(ambient[i]);
    } else {
      RowMajorMatrix plus(p.manifolds[i]->AmbientSize(), p.manifolds[i]->TangentSize());
      REQUIRE(p.manifolds[i]->PlusJacobian(pointers[i], plus.data()));
      e.jacobians.emplace_back(ambient[i] * plus);
    }
  }
  return e;
}

/// The analytic Jacobians against numeric ones, which are good to 1e-6 of each entry; Jets tell more.
inline void check_gradients(const ceres::CostFunction& cost, const Parameters& p) {
  std::vector<const ceres::Manifold*> manifolds;
  for (const auto& m : p.manifolds) manifolds.push_back(m.get());
  ceres::NumericDiffOptions options;
  options.ridders_relative_initial_step_size = 1e-3;
  const ceres::GradientChecker checker(&cost, &manifolds, options);
  ceres::GradientChecker::ProbeResults results;
  const bool good = checker.Probe(p.pointers().data(), 1e-5, &results);
  INFO(results.error_log);
  CHECK(good);
}

/// The residuals and Jacobians of `cost` against those of `functor` by automatic differentiation. Returns the largest
/// difference of a Jacobian in eps of the largest entry of all Jacobians of its block.
template <typename Functor>
double compare_with_jets(const ceres::CostFunction& cost, const Functor& functor, const Parameters& p) {
  ceres::DynamicAutoDiffCostFunction<Functor, 7> automatic(new Functor(functor));
  automatic.SetNumResiduals(cost.num_residuals());
  for (const auto& block : p.blocks) automatic.AddParameterBlock(static_cast<int>(block.size()));
  const Evaluation analytic = evaluate_cost(cost, p), jets = evaluate_cost(automatic, p);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  CHECK((analytic.residuals - jets.residuals).cwiseAbs().maxCoeff() <= 64 * eps * (1 + jets.residuals.norm()));
  // With and without Jacobians the residuals are the same.
  Eigen::VectorXd alone(cost.num_residuals());
  CHECK(cost.Evaluate(p.pointers().data(), alone.data(), nullptr));
  CHECK((alone - analytic.residuals).cwiseAbs().maxCoeff() <= 64 * eps * (1 + jets.residuals.norm()));
  // Blocks that are constant have no memory for a Jacobian.
  std::vector<double*> none(p.blocks.size(), nullptr);
  CHECK(cost.Evaluate(p.pointers().data(), alone.data(), none.data()));

  double largest = 0, worst = 0;
  for (const auto& J : jets.jacobians) largest = std::max(largest, J.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < jets.jacobians.size(); ++i) {
    worst = std::max(worst, (analytic.jacobians[i] - jets.jacobians[i]).cwiseAbs().maxCoeff() / (eps * largest));
  }
  return worst;
}

/// A square root of information that mixes the rows.
template <int N>
Eigen::Matrix<double, N, N> some_weight(Random& random) {
  Eigen::Matrix<double, N, N> W = 3 * Eigen::Matrix<double, N, N>::Identity();
  for (int i = 0; i < N * N; ++i) W.data()[i] += random.symmetric();
  return W;
}

}  // namespace splinertia::testing
