// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <type_traits>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;

namespace {

const Pinhole model{458.654, 457.296, 367.215, 248.375, RadialTangential{-0.283, 0.0739, 0.00019, 1.76e-5}};
const Sophus::SE3d T_BC(Sophus::SO3d::exp({0.4, -0.8, 1.1}), Eigen::Vector3d(0.1, 0.05, -0.02));

}  // namespace

TEST_CASE("The type of a camera follows from its parts") {
  using Model = Pinhole<RadialTangential<double>>;
  const Camera plain{model, ImageSize{752, 480}};
  STATIC_CHECK(std::is_same_v<decltype(plain), const Camera<Model, GlobalShutter, WholeImage>>);
  const Camera rolling{model, ImageSize{752, 480}, T_BC, RollingShutter{29.4e-6}};
  STATIC_CHECK(std::is_same_v<decltype(rolling), const Camera<Model, RollingShutter<double>, WholeImage>>);
  const Camera fisheye{model, ImageSize{752, 480}, T_BC, RollingShutter{29.4e-6, MiddleRow{}},
                       ImageCircle{376.0, 240.0, 240.0}};
  CHECK(plain.T_BC().matrix() == Eigen::Matrix4d::Identity());
  CHECK(rolling.T_BC().matrix() == T_BC.matrix());
  CHECK(rolling.size() == ImageSize{752, 480});
  CHECK(rolling.shutter().line_delay == 29.4e-6);
  CHECK(rolling.model().fx() == 458.654);
  using Pixel = Eigen::Vector2d;
  CHECK(plain.sees(Pixel(1, 1)));
  CHECK_FALSE(plain.sees(Pixel(1, 481)));
  CHECK_FALSE(fisheye.sees(Pixel(1, 1)));
  CHECK(fisheye.sees(Pixel(376, 470)));
  CHECK_FALSE(fisheye.sees(Pixel(376, -1)));
}

TEST_CASE("What a camera does not have takes no memory") {
  struct Bare {
    Pinhole<RadialTangential<double>> model;
    ImageSize size;
    Sophus::SE3d T_BC;
  };
  STATIC_CHECK(sizeof(Camera<Pinhole<RadialTangential<double>>>) == sizeof(Bare));
}

TEST_CASE("A camera of any scalar, with parts of another") {
  const Camera wide{Pinhole{400.0L, 400.0L, 300.0L, 200.0L, NoDistortion<long double>{}}, ImageSize{600, 400},
                    T_BC.cast<long double>(), RollingShutter{1e-5}};
  STATIC_CHECK(std::is_same_v<decltype(wide)::Scalar, long double>);
  const Camera narrow{Pinhole{400.0f, 400.0f, 300.0f, 200.0f, NoDistortion<float>{}}, ImageSize{600, 400},
                      T_BC.cast<float>(), RollingShutter{1e-5f}};
  CHECK(narrow.sees(Eigen::Vector2f(10, 10)));
}

TEST_CASE("A camera refuses what is not a rigid motion, and what its parts refuse") {
  const auto message = [](const Sophus::SE3d& pose) {
    return testing::message_of([&] { return Camera{model, ImageSize{752, 480}, pose}; });
  };
  auto bad = T_BC;
  bad.translation().y() = std::numeric_limits<double>::infinity();
  CHECK(message(bad) == "Camera: the translation of T_BC[1] is inf, expected a finite number");
  // Sophus checks its numbers itself, but not those that are written into it.
  bad = T_BC;
  bad.data()[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(bad) == "Camera: the rotation of T_BC[0] is nan, expected a finite number");
  bad = T_BC;
  for (int i = 0; i < 4; ++i) bad.data()[i] *= 1.5;
  CHECK(message(bad) == "Camera: the norm of T_BC's quaternion is 1.5, expected 1");
  for (int i = 0; i < 4; ++i) bad.data()[i] = T_BC.data()[i] * (1 + 1e-6);
  CHECK(std::abs(Camera{model, ImageSize{752, 480}, bad}.T_BC().unit_quaternion().norm() - 1) < 4e-16);
  CHECK(testing::message_of([] {
          return Camera{model, ImageSize{752, 480}, T_BC, RollingShutter{std::numeric_limits<double>::infinity()}};
        }) == "RollingShutter: line_delay is inf, expected a finite number");
  CHECK(testing::message_of([] {
          return Camera{model, ImageSize{752, 480}, T_BC, GlobalShutter{}, ImageMask({2, 1}, {true, true})};
        }) == "ImageMask: size is 2 x 1, expected 752 x 480 as the image");
}
