// SPDX-License-Identifier: MIT
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/rig.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("A rig holds cameras of several types, in order") {
  const Camera left{Pinhole{458.0, 457.0, 367.0, 248.0, NoDistortion<double>{}}, ImageSize{752, 480}};
  const Camera right{Pinhole{300.0, 300.0, 320.0, 240.0, Equidistant{0.0, 0.01, 0.0, 0.0}}, ImageSize{640, 481},
                     Sophus::SE3d(), RollingShutter{1e-5}};
  const Rig rig{left, right};
  STATIC_CHECK(rig.size() == 2);
  STATIC_CHECK(sizeof(rig) == sizeof(left) + sizeof(right));
  CHECK(rig.get<0>().size().height == 480);
  CHECK(rig.get<1>().shutter().line_delay == 1e-5);
  std::vector<int> heights;
  rig.for_each([&](const auto& camera) { heights.push_back(camera.size().height); });
  CHECK(heights == std::vector{480, 481});
  std::vector<std::size_t> indices;
  rig.for_each([&](const auto&, std::size_t index) { indices.push_back(index); });
  CHECK(indices == std::vector<std::size_t>{0, 1});
}

TEST_CASE("A rig of one camera and of none") {
  const Camera camera{Pinhole{458.0, 457.0, 367.0, 248.0, NoDistortion<double>{}}, ImageSize{752, 480}};
  STATIC_CHECK(sizeof(Rig{camera}) == sizeof(camera));
  const Rig<> none;
  STATIC_CHECK(std::is_empty_v<Rig<>>);
  none.for_each([](const auto&) { FAIL("there is none"); });
}
