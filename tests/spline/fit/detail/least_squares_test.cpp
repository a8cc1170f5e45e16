// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/spline/fit/detail/least_squares.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Line = BandedSystem<double, 1, 1>;
using Number = Eigen::Matrix<double, 1, 1>;
const Convergence<double> to_rounding{.relative = 0, .absolute = 1e-24, .most_iterations = 200};

struct OnNumbers {
  [[nodiscard]] std::vector<double> retracted(std::vector<double> x, const Line::Vector& step) const {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step.blocks[i][0];
    return x;
  }
};

/// Rosenbrock's valley, one for each pair of neighbours; its minimum is 0 at ones (of four numbers it has another).
struct Valley : OnNumbers {
  double linearize(const std::vector<double>& x, Line& system) const {
    double cost = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const Eigen::Vector2d r(10 * (x[i + 1] - x[i] * x[i]), 1 - x[i]);
      system.add(i, r, std::array{Eigen::Vector2d(-20 * x[i], -1), Eigen::Vector2d(10, 0)});
      cost += r.squaredNorm();
    }
    return cost;
  }
};

/// atan(x)²: full steps from beyond ±1.39 lead further and further away.
struct Arctangent : OnNumbers {
  double linearize(const std::vector<double>& x, Line& system) const {
    const double r = std::atan(x[0]);
    system.add(0, Number(r), std::array{Number(1 / (1 + x[0] * x[0]))});
    return r * r;
  }
};

/// Only the distances of neighbours are known: the matrix is singular.
struct Distances : OnNumbers {
  double linearize(const std::vector<double>& x, Line& system) const {
    double cost = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double r = x[i + 1] - x[i] - 1;
      system.add(i, Number(r), std::array{Number(-1), Number(1)});
      cost += r * r;
    }
    return cost;
  }
};

/// x² = −1 as well as can be.
struct Parabola : OnNumbers {
  double linearize(const std::vector<double>& x, Line& system) const {
    const double r = x[0] * x[0] + 1;
    system.add(0, Number(r), std::array{Number(2 * x[0])});
    return r * r;
  }
};

template <typename Model>
Minimum<double> run(const Model& model, std::vector<double>& x, Convergence<double> until = to_rounding) {
  Line system(x.size());
  BandedCholesky<Line> factor;
  return minimize(model, x, system, factor, until);
}

}  // namespace

TEST_CASE("A step that does not lower the cost is damped") {
  std::vector<double> x{-1.2, 1, 0.5};
  const auto minimum = run(Valley{}, x);
  CHECK(minimum.converged);
  CHECK(minimum.cost < 1e-24);
  for (const double number : x) CHECK_THAT(number, WithinAbs(1, 1e-11));

  std::vector<double> y{20};
  CHECK(run(Arctangent{}, y).converged);
  CHECK_THAT(y[0], WithinAbs(0, 1e-12));
}

TEST_CASE("A linear model takes one step, and one that shows it") {
  std::vector<double> x{5, 7, -3};
  Line system(3);
  BandedCholesky<Line> factor;
  struct Linear : OnNumbers {
    double linearize(const std::vector<double>& at, Line& to) const {
      double cost = 0;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double r = at[i] - static_cast<double>(i);
        to.add(i, Number(r), std::array{Number(1)});
        cost += r * r;
      }
      return cost;
    }
  };
  const auto minimum = minimize(Linear{}, x, system, factor, to_rounding);
  CHECK(minimum.converged);
  CHECK(minimum.iterations == 2);
  CHECK(x == std::vector<double>{0, 1, 2});
  CHECK(system.right.dot(system.right) == 0);  // the gradient where it stopped
}

TEST_CASE("A singular matrix is damped as well") {
  std::vector<double> x{0, 5, 3};
  const auto minimum = run(Distances{}, x);
  CHECK(minimum.converged);
  CHECK_THAT(x[1] - x[0], WithinAbs(1, 1e-11));
  CHECK_THAT(x[2] - x[1], WithinAbs(1, 1e-11));
}

TEST_CASE("minimize() says whether it got there") {
  std::vector<double> x{-1.2, 1};
  const auto few = run(Valley{}, x, {.relative = 0, .absolute = 1e-24, .most_iterations = 2});
  CHECK_FALSE(few.converged);
  CHECK(few.iterations == 2);
  CHECK(few.cost <= 24.2);  // no worse than where it began

  std::vector<double> y{3};
  const auto large = run(Parabola{}, y, {.relative = 1e-12, .absolute = 0, .most_iterations = 500});
  CHECK_THAT(large.cost, WithinRel(1.0, 1e-9));
  CHECK_THAT(y[0], WithinAbs(0, 1e-4));
}

TEST_CASE("The estimate of the condition is a lower bound within a factor of three") {
  testing::Random random(5);
  const auto check = [&]<int Border>(std::size_t blocks, double smoothing) {
    using System = BandedSystem<double, 2, 3, Border>;
    System system(blocks);
    const auto number = [&](auto&&...) { return random.symmetric(); };
    for (std::size_t i = 0; i + 3 < blocks; ++i) {
      std::array<Eigen::Matrix<double, 2, 2>, 4> J;
      for (int again = 0; again < 8; ++again) {
        // Neighbours alike, as the control points of a spline: the more, the worse the condition.
        const Eigen::Matrix2d common = Eigen::Matrix2d::NullaryExpr(number);
        for (auto& block : J) block = common + smoothing * Eigen::Matrix2d::NullaryExpr(number);
        if constexpr (Border > 0) {
          system.add(i, Eigen::Vector2d(1, -1), J, Eigen::Matrix<double, 2, Border>::NullaryExpr(number).eval());
        } else {
          system.add(i, Eigen::Vector2d(1, -1), J);
        }
      }
    }
    BandedCholesky<System> factor;
    REQUIRE(factor.compute(system, 0));

    // All columns of the matrix, scaled to a diagonal of ones.
    const auto n = static_cast<Eigen::Index>(2 * blocks) + Border;
    Eigen::MatrixXd A(n, n);
    for (Eigen::Index column = 0; column < n; ++column) {
      auto unit = system.right;
      unit.scale(0);
      const auto entry = [](auto& vector, Eigen::Index i) -> double& {
        const auto block = static_cast<std::size_t>(i / 2);
        return block < vector.blocks.size()
                   ? vector.blocks[block][i % 2]
                   : vector.border.data()[i - 2 * static_cast<Eigen::Index>(vector.blocks.size())];
      };
      entry(unit, column) = 1;
      auto image = multiply(system, unit);
      for (Eigen::Index row = 0; row < n; ++row) A(row, column) = entry(image, row);
    }
    const Eigen::VectorXd root = A.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = root.asDiagonal() * A * root.asDiagonal();
    const auto eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues();
    const double expected = eigenvalues[n - 1] / eigenvalues[0];
    const double estimate = condition_estimate(system, factor);
    INFO("condition " << expected << ", estimate " << estimate);
    CHECK(estimate <= expected * (1 + 1e-6));
    CHECK(estimate >= expected / 3);
  };
  for (const double smoothing : {1.0, 0.1, 0.01}) {
    for (const std::size_t blocks : {5UL, 10UL, 40UL}) {
      check.operator()<0>(blocks, smoothing);
      check.operator()<3>(blocks, smoothing);
    }
  }
}
