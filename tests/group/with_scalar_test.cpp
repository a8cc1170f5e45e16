// SPDX-License-Identifier: MIT
#include <splinertia/group/with_scalar.hpp>

#include <concepts>
#include <splinertia/group/pose.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

using L = NativeSimdPack<double>;
static_assert(std::same_as<WithScalar<Sophus::SO3d, L>, Sophus::SO3<L>>);
static_assert(std::same_as<WithScalar<SO3xR3<double>, L>, SO3xR3<L>>);
static_assert(std::same_as<WithScalar<Sophus::SE3d, float>, Sophus::SE3f>);
static_assert(HasSimdPack<Eigen::Vector2d, L> && HasSimdPack<SO3xR3<double>, L>);
// exp takes the sine of any angle, of which there is none in lanes.
static_assert(!HasSimdPack<Sophus::SO2d, L> && !HasSimdPack<Sophus::SE2d, L>);
static_assert(!HasSimdPack<Product<Sophus::SO2d, Eigen::Vector2d>, L>);

TEST_CASE("an element is the same in all lanes") {
  const Sophus::SO3d R = GroupTraits<Sophus::SO3d>::exp({0.1, -0.2, 0.3});
  const Eigen::Vector3d p(1, -2, 3e9);
  const auto lanes = with_scalar<L>(SO3xR3<double>{R, p});
  const auto rigid = with_scalar<L>(make_pose<Sophus::SE3d>(R, p));
  const auto each_is = [](const L& x, double value) {
    double numbers[L::size];
    x.store(numbers);
    for (const double number : numbers) CHECK(number == value);
  };
  for (int i = 0; i < 4; ++i) {
    each_is(rotation(lanes).unit_quaternion().coeffs()[i], R.unit_quaternion().coeffs()[i]);
    each_is(rotation(rigid).unit_quaternion().coeffs()[i], R.unit_quaternion().coeffs()[i]);
  }
  for (int i = 0; i < 3; ++i) {
    each_is(position(lanes)[i], p[i]);
    each_is(position(rigid)[i], p[i]);
  }
}
