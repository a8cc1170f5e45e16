// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <random>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/camera/detail/polar_angle.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEMPLATE_TEST_CASE("The polar angle is right to rounding, alone and in lanes", "", float, double) {
  using Scalar = TestType;
  using Pack = NativeSimdPack<Scalar>;
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> exponent(-20, 20), side(-1, 1);
  long double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto r = static_cast<Scalar>(std::exp(exponent(bits))), z = static_cast<Scalar>(side(bits));
    const long double exact = std::atan2(static_cast<long double>(r), static_cast<long double>(z));
    const Scalar angle = polar_angle<Scalar>(r, z);
    worst = std::max(worst, std::abs(static_cast<long double>(angle) - exact) / exact);
    Scalar lanes[static_cast<std::size_t>(Pack::size)];
    polar_angle<Pack>(Pack(r), Pack(z)).store(lanes);
    CHECK(std::abs(lanes[0] - angle) <= 2 * std::numeric_limits<Scalar>::epsilon() * angle);
  }
  CHECK(worst <= 2 * static_cast<long double>(std::numeric_limits<Scalar>::epsilon()));
  CHECK(polar_angle<Scalar>(0, 1) == 0);
  CHECK(polar_angle<Scalar>(1, 0) == static_cast<Scalar>(std::acos(0.0L)));
  CHECK(polar_angle<Scalar>(0, -1) == static_cast<Scalar>(std::acos(-1.0L)));
}

TEMPLATE_TEST_CASE("The scale of a direction is a power of two that brings it to between 1 and 4", "", float, double,
                   long double) {
  using Scalar = TestType;
  using Limits = std::numeric_limits<Scalar>;
  for (const Scalar x : {Scalar(1), Scalar(1.99), Scalar(-3), Limits::max(), Limits::max() / 3, Limits::min(),
                         std::sqrt(Limits::min()), Scalar(1e30)}) {
    for (int axis = 0; axis < 3; ++axis) {
      Scalar p[3] = {x / 16, x / 16, x / 16};
      p[axis] = x;
      const Scalar scale = direction_scale<Scalar>(p[0], p[1], p[2]);
      int unused = 0;
      CHECK(std::frexp(scale, &unused) == Scalar(0.5));
      CHECK(std::abs(x * scale) >= 1);
      CHECK(std::abs(x * scale) < 4);
      if constexpr (sizeof(Scalar) <= 8) {
        using Pack = NativeSimdPack<Scalar>;
        Scalar lanes[static_cast<std::size_t>(Pack::size)];
        direction_scale<Pack>(Pack(p[0]), Pack(p[1]), Pack(p[2])).store(lanes);
        CHECK(lanes[0] == scale);
      }
    }
  }
  CHECK(std::isfinite(direction_scale<Scalar>(0, 0, 0)));
  CHECK(std::isfinite(direction_scale<Scalar>(Limits::denorm_min(), 0, 0)));
}
