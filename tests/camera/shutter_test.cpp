// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/camera/detail/shutter_times.hpp>
#include <splinertia/camera/shutter.hpp>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using splinertia::detail::ShutterTimes;

TEMPLATE_TEST_CASE("The stamp of a frame is the time of the row that the type says", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar delay = Scalar(1) / 1024, back = -delay;
  const auto offset = [](const auto& shutter, int row) {
    return ShutterTimes<Scalar>(shutter, 481).offset(Scalar(row));
  };
  CHECK(offset(RollingShutter{delay}, 0) == 0);
  CHECK(offset(RollingShutter{delay}, 480) == 480 * delay);
  CHECK(offset(RollingShutter{delay, MiddleRow{}}, 240) == 0);
  CHECK(offset(RollingShutter{delay, MiddleRow{}}, 0) == -240 * delay);
  CHECK(offset(RollingShutter{delay, BottomRow{}}, 480) == 0);
  CHECK(offset(RollingShutter{delay, BottomRow{}}, 0) == -480 * delay);
  const ExposureStart exposure{Scalar(1) / 64};
  CHECK(offset(RollingShutter{delay, exposure}, 0) == Scalar(1) / 128);
  CHECK(offset(RollingShutter{delay, exposure}, 480) == 480 * delay + Scalar(1) / 128);
  // Read upwards, the bottom row is the first.
  CHECK(offset(RollingShutter{back, BottomRow{}}, 0) == 480 * delay);
  CHECK(offset(RollingShutter{back, exposure}, 480) == Scalar(1) / 128);
  CHECK(offset(RollingShutter{back}, 480) == -480 * delay);
}

TEST_CASE("Stamps are types and take no memory") {
  STATIC_CHECK(sizeof(RollingShutter<float>) == sizeof(float));
  STATIC_CHECK(sizeof(RollingShutter<double, MiddleRow>) == sizeof(double));
  STATIC_CHECK(std::is_empty_v<GlobalShutter>);
  CHECK(RollingShutter<double>{.line_delay = 29.4e-6}.line_delay == 29.4e-6);
}

TEST_CASE("The numbers of a shutter are finite") {
  const auto message = [](const auto& shutter) {
    return testing::message_of([&] {
      detail::check_shutter(shutter);
      return 0;
    });
  };
  CHECK(message(RollingShutter{std::numeric_limits<double>::quiet_NaN()}) ==
        "RollingShutter: line_delay is nan, expected a finite number");
  CHECK(message(RollingShutter{1e-5, ExposureStart{-1.0}}) ==
        "ExposureStart: exposure is -1, expected a finite number >= 0");
  CHECK(message(RollingShutter{-1e-5, ExposureStart{0.0}}) == "nothing thrown");
  CHECK(message(GlobalShutter{}) == "nothing thrown");
}
