// SPDX-License-Identifier: MIT
// ceres::Jet as the scalar of camera models: differentiating the code itself must give the analytic Jacobians.
#include <ceres/jet.h>

#include <limits>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"

using namespace splinertia;

namespace {

template <typename S>
using None = Pinhole<NoDistortion<S>>;
template <typename S>
using Polynomial = Pinhole<RadialTangential<S>>;
template <typename S>
using Quotient = Pinhole<Rational<S>>;
template <typename S>
using Fisheye = Pinhole<Equidistant<S>>;
template <typename S>
using Mei = Unified<RadialTangential<S>>;

template <int Rows, typename T, int N = decltype(T().v)::RowsAtCompileTime>
Eigen::Matrix<double, Rows, N> derivative(const Eigen::Matrix<T, Rows, 1>& m) {
  Eigen::Matrix<double, Rows, N> J;
  for (int i = 0; i < Rows; ++i) J.row(i) = m[i].v.transpose();
  return J;
}

/// Infinitesimals 0 to 2 are those of the point or the ray, the others those of the parameters.
template <template <typename> class Model>
void check(const testing::ModelCase& parameters) {
  using M = Model<double>;
  constexpr int count = M::parameter_count;
  using T = ceres::Jet<double, 3 + count>;
  using J = Model<T>;
  static_assert(CameraModel<J>);
  const M model = testing::model_of<M>(parameters);
  INFO(M::name << " " << model.parameters().transpose());
  typename J::Parameters with_infinitesimals;
  for (int i = 0; i < count; ++i) with_infinitesimals[i] = T(model.parameters()[i], 3 + i);
  const J jet_model = J::from_parameters(with_infinitesimals);
  const double tolerance = 256 * std::numeric_limits<double>::epsilon();
  testing::Uniform uniform(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d point = i == 0 ? Eigen::Vector3d(0, 0, 1) : testing::random_direction(model, uniform, 0.8);
    const auto p = model.template linearize<Wrt::point | Wrt::parameters>(point);
    REQUIRE(p);
    const auto jet = jet_model.project({T(point.x(), 0), T(point.y(), 1), T(point.z(), 2)});
    REQUIRE(jet);
    Eigen::Matrix<double, 2, 3 + count> expected;
    expected << p->point_jacobian, p->parameter_jacobian;
    const auto automatic = derivative(*jet);
    CHECK((automatic - expected).cwiseAbs().maxCoeff() <= tolerance * expected.cwiseAbs().maxCoeff());

    // The ray as a function of the pixel, and of the parameters by the implicit function theorem.
    const auto ray = model.linearize_ray(p->pixel);
    REQUIRE(ray);
    const auto jet_ray = jet_model.unproject({T(p->pixel.x(), 0), T(p->pixel.y(), 1)});
    REQUIRE(jet_ray);
    const auto by_all = derivative(*jet_ray);
    const Eigen::Matrix<double, 3, count> by_parameters = -ray->pixel_jacobian * p->parameter_jacobian;
    CHECK(by_all.template leftCols<2>().isApprox(ray->pixel_jacobian, 1e-11));
    CHECK((by_all.template rightCols<count>() - by_parameters).cwiseAbs().maxCoeff() <=
          1e-11 * (1 + by_parameters.cwiseAbs().maxCoeff()));
  }
}

}  // namespace

TEST_CASE("Jets: camera models have their analytic Jacobians") {
  check<None>({460, 461, 320, 240});
  check<Polynomial>({458, 457, 367, 248, -0.28, 0.074, 0.0002, 0.00002});
  check<Polynomial>({458, 457, 367, 248, 0, 0, 0, 0});
  check<Quotient>({603, 602, 640, 359, 12.4, 7.1, -0.0001, 0.00005, 0.36, 12.7, 11.3, 1.95});
  check<Fisheye>({191, 192, 255, 257, 0.0034, 0.0007, -0.002, 0.0002});
  check<Fisheye>({191, 192, 255, 257, 0, 0, 0, 0});
  check<Mei>({0.9, 400, 401, 330, 245, -0.11, 0.02, 0.0003, -0.0002});
  check<DoubleSphere>({158, 159, 254, 256, -0.17, 0.59});
  check<ExtendedUnified>({250, 251, 319, 239, 0.51, 0.9});
  check<FieldOfView>({258, 259, 320, 240, 0.93});
  check<FieldOfView>({258, 259, 320, 240, 0});
  check<Equirectangular>({2048, 1024});
}
