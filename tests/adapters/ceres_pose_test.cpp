// SPDX-License-Identifier: MIT
#include <splinertia/adapters/ceres_pose.hpp>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <LieGroup G, int Order>
struct PoseFunctor {
  CumulativeBasis<double, Order, 0> basis;
  G measured;
  Jacobian<G> weight;

  template <typename T>
  bool operator()(T const* const* parameters, T* residuals) const {
    using H = WithScalar<G, T>;
    const auto curve = evaluate<0, H>(parameters, testing::with_scalar<T>(basis));
    Eigen::Map<Tangent<H>>{residuals} =
        weight.template cast<T>() * increment<H>(testing::with_scalar<T>(measured), curve.value);
    return true;
  }
};

template <LieGroup G, int Order>
struct ShiftedPoseFunctor {
  double u, interval;
  G measured;
  Jacobian<G> weight;

  template <typename T>
  bool operator()(T const* const* parameters, T* residuals) const {
    using H = WithScalar<G, T>;
    const T& tau = *parameters[Order * ControlPointParts<G>::count];
    const auto curve = evaluate<0, H>(parameters, uniform_basis<Order, 0, T>(T(u) + tau / T(interval), T(interval)));
    Eigen::Map<Tangent<H>>{residuals} =
        weight.template cast<T>() * increment<H>(testing::with_scalar<T>(measured), curve.value);
    return true;
  }
};

template <LieGroup G, int Order>
void check_pose() {
  testing::Random random(Order);
  const double u = 0.3, interval = 0.1;
  const auto basis = uniform_basis<Order, 0>(u, interval);
  for (const auto& regime : testing::regimes()) {
    INFO("order " << Order << ", " << regime.name);
    const auto points = testing::control_points<G>(Order, regime, random);
    const auto weight = testing::some_weight<DofOf<G>>(random);
    const G value = evaluate<0>(std::span<const G, Order>(points), basis).value;
    for (const double error : {0.0, 1e-8, 0.3, 1.6}) {  // 1.6: rotations up to 2.8
      const G measured = GroupTraits<G>::compose(value, GroupTraits<G>::exp(random.tangent<G>(error)));
      testing::Parameters p;
      p.add(points);
      const CeresPoseResidual<G, Order> cost(basis, measured, weight);
      CHECK(testing::compare_with_jets(cost, PoseFunctor<G, Order>{basis, measured, weight}, p) <= 16);
      if (regime.good_for_differences() && error < 1) testing::check_gradients(cost, p);

      p.add(Eigen::VectorXd::Constant(1, 0.013));
      const CeresShiftedPoseResidual<G, Order> shifted(u, interval, measured, weight);
      CHECK(testing::compare_with_jets(shifted, ShiftedPoseFunctor<G, Order>{u, interval, measured, weight}, p) <= 16);
      if (regime.good_for_differences() && error < 1) testing::check_gradients(shifted, p);
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("The Jacobians of a measured value are right", "", Eigen::Vector3d, Sophus::SO3d, Sophus::SE3d,
                   SO3xR3<double>) {
  check_pose<TestType, 4>();
  check_pose<TestType, 5>();
}

TEST_CASE("The residual of a value is its distance, in tangents of its group") {
  using G = SO3xR3<double>;
  testing::Random random(7);
  const auto points = random.walk<G>(4);
  const auto basis = uniform_basis<4, 0>(0.6, 0.1);
  const G value = evaluate<0>(std::span<const G, 4>(points), basis).value;
  Tangent<G> tau;
  tau << 0.1, -0.2, 0.3, 4, 5, 6;
  const G measured = GroupTraits<G>::compose(value, GroupTraits<G>::exp(-tau));
  const CeresPoseResidual<G, 4> cost(basis, measured, 2 * Jacobian<G>::Identity());
  const std::vector<std::int32_t> sizes{4, 4, 4, 4, 3, 3, 3, 3};
  CHECK(cost.parameter_block_sizes() == sizes);
  testing::Parameters p;
  p.add(points);
  CHECK((testing::evaluate_cost(cost, p).residuals - 2 * tau).norm() < 1e-14);
}

TEST_CASE("A time offset may leave the segment by an interval, not more") {
  using G = Sophus::SE3d;
  testing::Random random(8);
  const auto points = random.walk<G>(4);
  const CeresShiftedPoseResidual<G, 4> cost(0.5, 0.1, points[1], Jacobian<G>::Identity());
  for (const double tau : {0.14, 0.16, -0.14, -0.16}) {
    testing::Parameters p;
    p.add(points);
    p.add(Eigen::VectorXd::Constant(1, tau));
    Eigen::VectorXd r(6);
    CHECK(cost.Evaluate(p.pointers().data(), r.data(), nullptr) == (std::abs(tau) < 0.15));
  }
}
