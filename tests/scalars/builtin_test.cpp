// SPDX-License-Identifier: MIT
// Every class template, with every member, for every built-in scalar; and what each of them is good for.
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/parameter_blocks.hpp>
#include <splinertia/splinertia.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

template class splinertia::Product<Sophus::SO3f, Eigen::Vector3f>;
template class splinertia::Product<Sophus::SO3d, Eigen::Vector3d>;
template class splinertia::Product<Sophus::SO3<long double>, Vector3<long double>>;

template struct splinertia::UniformKnots<float>;
template struct splinertia::UniformKnots<double>;
template struct splinertia::UniformKnots<long double>;
template struct splinertia::UniformKnots<nanoseconds>;

// What each scalar brings with it, as a macro because explicit instantiation is a declaration.
#define SPLINERTIA_INSTANTIATE(Scalar)                                                       \
  template struct splinertia::GroupTraits<splinertia::Vector3<Scalar>>;                      \
  template struct splinertia::GroupTraits<Sophus::SO2<Scalar>>;                              \
  template struct splinertia::GroupTraits<Sophus::SO3<Scalar>>;                              \
  template struct splinertia::GroupTraits<Sophus::SE2<Scalar>>;                              \
  template struct splinertia::GroupTraits<Sophus::SE3<Scalar>>;                              \
  template struct splinertia::GroupTraits<splinertia::SO3xR3<Scalar>>;                       \
  template struct splinertia::DualMatrix3<Scalar>;                                           \
  template struct splinertia::ParameterLayout<splinertia::Vector3<Scalar>>;                  \
  template struct splinertia::ParameterLayout<Sophus::SO2<Scalar>>;                          \
  template struct splinertia::ParameterLayout<Sophus::SO3<Scalar>>;                          \
  template struct splinertia::ParameterLayout<Sophus::SE2<Scalar>>;                          \
  template struct splinertia::ParameterLayout<Sophus::SE3<Scalar>>;                          \
  template struct splinertia::ParameterLayout<splinertia::SO3xR3<Scalar>>;                   \
  template class splinertia::Spline<splinertia::Vector3<Scalar>, 4>;                         \
  template class splinertia::Spline<Sophus::SO2<Scalar>, 3>;                                 \
  template class splinertia::Spline<Sophus::SO3<Scalar>, 4, UniformKnots<Scalar>>;           \
  template class splinertia::Spline<Sophus::SE2<Scalar>, 5, UniformKnots<nanoseconds>>;      \
  template class splinertia::Spline<Sophus::SE3<Scalar>, 4, UniformKnots<nanoseconds>>;      \
  template class splinertia::Spline<splinertia::SO3xR3<Scalar>, 6, NonUniformKnots<double>>; \
  template struct splinertia::Circle<Scalar>;                                                \
  template struct splinertia::Ellipse<Scalar>;                                               \
  template struct splinertia::Coning<Scalar>;                                                \
  template struct splinertia::ConstantTwist<Sophus::SE3<Scalar>>;                            \
  template class splinertia::PerAxis<Scalar>;                                                \
  template struct splinertia::WhiteNoise<Scalar>;                                            \
  template struct splinertia::RandomWalk<Scalar>;                                            \
  template class splinertia::ErrorModel<WhiteNoise<Scalar>, RandomWalk<Scalar>>;             \
  template struct splinertia::LeverArm<Scalar>;                                              \
  template struct splinertia::NavState<Scalar>;

SPLINERTIA_INSTANTIATE(float)
SPLINERTIA_INSTANTIATE(double)
SPLINERTIA_INSTANTIATE(long double)

TEMPLATE_TEST_CASE("A curve is as accurate as its scalar", "", float, double, long double) {
  using Scalar = TestType;
  using G = SO3xR3<Scalar>;
  using Wide = SO3xR3<long double>;
  testing::Random random(1);
  const auto points = random.walk<G>(4);
  std::vector<Wide> wide;
  for (const G& x : points) {
    Sophus::SO3<long double> R;
    for (int i = 0; i < 4; ++i) R.data()[i] = rotation(x).data()[i];
    wide.emplace_back(R, position(x).template cast<long double>());
  }
  const auto basis = uniform_basis<4, 2>(Scalar(0.375), Scalar(0.5));  // exact in every scalar
  const auto m = evaluate<2>(std::span<const G, 4>(points), basis);
  const auto expected = evaluate<2>(std::span<const Wide, 4>(wide), uniform_basis<4, 2>(0.375L, 0.5L));
  const long double eps = std::numeric_limits<Scalar>::epsilon();
  CHECK((position(m.value).template cast<long double>() - position(expected.value)).norm() < 16 * eps);
  // The norm of a float's quaternion is 1 to rounding only, which the truth in long double sees.
  CHECK((m.velocity.template cast<long double>() - expected.velocity).norm() < 64 * eps);
  CHECK((m.acceleration.template cast<long double>() - expected.acceleration).norm() < 256 * eps);
  const auto imu = ideal_imu(m);
  const auto truth = ideal_imu(expected);
  CHECK((imu.accel.template cast<long double>() - truth.accel).norm() < 512 * eps);
}
