// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/units.hpp>

#include "support/catch.hpp"

using namespace splinertia::units;

// The expected numbers are worked out by hand from π/180 = 0.0174532925199433.
TEST_CASE("A gyroscope's units") {
  CHECK_THAT(degree, WithinRel(0.0174532925199433, 1e-14));
  CHECK_THAT(degree_per_second, WithinRel(0.0174532925199433, 1e-14));
  CHECK_THAT(degree_per_hour, WithinRel(4.84813681109536e-6, 1e-14));
  CHECK_THAT(degree_per_root_hour, WithinRel(2.90888208665722e-4, 1e-14));
  CHECK_THAT(degree_per_second_per_root_hertz, WithinRel(0.0174532925199433, 1e-14));
  CHECK_THAT(milli_degree_per_second_per_root_hertz, WithinRel(1.74532925199433e-5, 1e-14));
  CHECK_THAT(degree_per_hour_per_root_hertz, WithinRel(4.84813681109536e-6, 1e-14));
  CHECK_THAT(degree_per_hour_per_root_hour, WithinRel(8.08022801849227e-8, 1e-14));
  CHECK_THAT(degree_per_second_per_g, WithinRel(1.77974053524326e-3, 1e-14));
  CHECK_THAT(degree_per_hour_per_g, WithinRel(4.94372370900905e-7, 1e-14));
}

TEST_CASE("An accelerometer's units") {
  CHECK(standard_g == 9.80665);
  CHECK_THAT(milli_g, WithinRel(9.80665e-3, 1e-14));
  CHECK_THAT(micro_g, WithinRel(9.80665e-6, 1e-14));
  CHECK_THAT(meter_per_second_per_root_hour, WithinRel(0.0166666666666667, 1e-14));
  CHECK_THAT(milli_g_per_root_hertz, WithinRel(9.80665e-3, 1e-14));
  CHECK_THAT(micro_g_per_root_hertz, WithinRel(9.80665e-6, 1e-14));
  CHECK_THAT(micro_g_per_root_hour, WithinRel(1.63444166666667e-7, 1e-14));
}

TEST_CASE("Angles, times and ratios") {
  CHECK(hour == 3600);
  CHECK(milliradian == 1e-3);
  CHECK(percent == 1e-2);
  CHECK(ppm == 1e-6);
}

TEST_CASE("A random walk in an hour is what its unit says") {
  // White noise of density N integrates to N·√t.
  CHECK_THAT(0.66 * degree_per_root_hour * std::sqrt(hour), WithinRel(0.66 * degree, 1e-15));
  CHECK_THAT(0.11 * meter_per_second_per_root_hour * std::sqrt(hour), WithinRel(0.11, 1e-15));
  // So does K to a bias.
  CHECK_THAT(2 * degree_per_hour_per_root_hour * std::sqrt(hour), WithinRel(2 * degree_per_hour, 1e-15));
  CHECK_THAT(5 * micro_g_per_root_hour * std::sqrt(hour), WithinRel(5 * micro_g, 1e-15));
}

TEST_CASE("Dividing by a unit gives the data sheet's figure back") {
  STATIC_CHECK(0.66 * degree_per_root_hour / degree_per_root_hour == 0.66);
  CHECK_THAT(1.6968e-4 / degree_per_hour_per_root_hertz, WithinRel(35.0, 1e-4));  // EuRoC's gyroscope
}
