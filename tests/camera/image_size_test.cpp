// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/camera/image_size.hpp>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;

TEST_CASE("An image contains pixels from 0 to below its size") {
  const ImageSize size{752, 480};
  using Pixel = Eigen::Vector2d;
  CHECK(size.contains(Pixel(0, 0)));
  CHECK(size.contains(Pixel(751.999, 479.999)));
  CHECK_FALSE(size.contains(Pixel(752, 100)));
  CHECK_FALSE(size.contains(Pixel(100, 480)));
  CHECK_FALSE(size.contains(Pixel(-1e-300, 100)));
  CHECK_FALSE(size.contains(Pixel(100, -1e-300)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(size.contains(Pixel(nan, 100)));
  CHECK_FALSE(size.contains(Pixel(100, nan)));
  CHECK(size.contains(Eigen::Vector2f(3, 4)));
}

TEST_CASE("The size of an image is positive") {
  CHECK(testing::message_of([] { return ImageSize(0, 480).width; }) ==
        "ImageSize: width is 0, expected at least 1 pixel");
  CHECK(testing::message_of([] { return ImageSize(752, -480).width; }) ==
        "ImageSize: height is -480, expected at least 1 pixel");
  STATIC_CHECK(ImageSize(1, 1) == ImageSize{1, 1});
}
