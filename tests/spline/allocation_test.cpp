// SPDX-License-Identifier: MIT
// Nothing in evaluation allocates: counted in operator new, and refused by Eigen.
#define EIGEN_RUNTIME_NO_MALLOC
#include <cstdlib>
#include <new>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace splinertia;

template <typename Curve>
std::size_t allocations_of(const Curve& curve) {
  Eigen::internal::set_is_malloc_allowed(false);
  const std::size_t before = allocations;
  double sum = 0;
  for (int i = 0; i <= 10; ++i) {
    const double t = curve.start() + (curve.end() - curve.start()) * i / 10;
    sum += curve.template at<3>(t).jerk.norm() + curve.template linearize<2>(t).acceleration_jacobian[0].norm();
  }
  const std::size_t after = allocations;
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(sum > 0);
  return after - before;
}

TEMPLATE_TEST_CASE("Evaluating and linearizing allocate nothing", "", Sophus::SO3d, Sophus::SE2d, Sophus::SE3d,
                   SO3xR3<double>) {
  testing::Random random(1);
  const auto points = random.walk<TestType>(8);
  CHECK(allocations > 0);  // the counter counts
  CHECK(allocations_of(Spline<TestType, 4>({.start = 0, .interval = 0.5}, points)) == 0);
  NonUniformKnots<double> knots;
  for (int i = 0; i < 12; ++i) knots.knots.push_back(i + 0.1 * (i % 3));
  CHECK(allocations_of(Spline<TestType, 4, NonUniformKnots<double>>(knots, points)) == 0);
}
