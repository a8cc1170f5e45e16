// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/camera/image_region.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using Pixel = Eigen::Vector2d;

TEST_CASE("A circle contains what is nearer to its centre than the radius") {
  const ImageCircle circle{100.0, 80.0, 50.0};
  CHECK(circle.contains(Pixel(100, 129.999)));
  CHECK_FALSE(circle.contains(Pixel(100, 130.001)));
  CHECK(circle.contains(Pixel(135, 115)));
  CHECK_FALSE(circle.contains(Pixel(136, 116)));
  CHECK(circle.contains(Eigen::Vector2f(100, 80)));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(testing::message_of([&] { return ImageCircle{infinity, 1.0, 1.0}; }) ==
        "ImageCircle: u is inf, expected a finite number");
  CHECK(testing::message_of([] { return ImageCircle{1.0, 1.0, 0.0}; }) ==
        "ImageCircle: radius is 0, expected a finite number > 0");
}

TEST_CASE("A mask has one value for each pixel, row by row") {
  const ImageMask mask({3, 2}, {true, true, false, false, true, true});
  CHECK(mask.contains(Pixel(0, 0)));
  CHECK(mask.contains(Pixel(1.99, 0.99)));
  CHECK_FALSE(mask.contains(Pixel(2, 0.5)));
  CHECK_FALSE(mask.contains(Pixel(0.5, 1)));
  CHECK(mask.contains(Pixel(2.9, 1.9)));
  CHECK(testing::message_of([] { return ImageMask({3, 2}, std::vector<bool>(5)); }) ==
        "ImageMask: the number of values is 5, expected 6 = width * height");
  CHECK(testing::message_of([&] {
          mask.check({2, 3});
          return 0;
        }) == "ImageMask: size is 3 x 2, expected 2 x 3 as the image");
}

TEST_CASE("The whole image is a region that takes no memory") {
  STATIC_CHECK(std::is_empty_v<WholeImage>);
  STATIC_CHECK(WholeImage{}.contains(0));
}
