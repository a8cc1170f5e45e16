// SPDX-License-Identifier: MIT
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/pinhole.hpp>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

struct NoModel {
  using Scalar = double;
  static constexpr int parameter_count = 1;
};

}  // namespace

TEST_CASE("what a camera model is") {
  static_assert(CameraModel<Pinhole<Equidistant<float>>>);
  static_assert(CameraModel<DoubleSphere<double>>);
  static_assert(!CameraModel<NoModel>);
  static_assert(!CameraModel<Equidistant<double>>);
  static_assert(includes(Wrt::point | Wrt::parameters, Wrt::point));
  static_assert(!includes(Wrt::point, Wrt::parameters));
  static_assert(!includes(Wrt::nothing, Wrt::point));
  SUCCEED();
}
