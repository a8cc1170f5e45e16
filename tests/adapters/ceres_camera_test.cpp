// SPDX-License-Identifier: MIT
#include <splinertia/adapters/ceres_camera.hpp>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <type_traits>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// The residual from the library's own functions, for automatic differentiation.
template <LieGroup G, int Order, template <typename> typename ModelOf, typename Landmark>
struct ReprojectionFunctor {
  double u, interval, rows, line_delay;
  Eigen::Vector2d pixel;
  Eigen::Matrix2d weight;
  Landmark landmark;

  template <typename T>
  bool operator()(T const* const* parameters, T* residuals) const {
    using H = WithScalar<G, T>;
    using Vector = Eigen::Vector3<T>;
    T const* const* others = parameters + Order * ControlPointParts<G>::count;
    const T at = T(u) + (*others[2] + T(rows) * (*others[3] - T(line_delay))) / T(interval);
    const auto curve = evaluate<0, H>(parameters, uniform_basis<Order, 0, T>(at, T(interval)));
    const auto T_BC = read_parameters<Sophus::SE3<T>>(others[0]);
    Vector point, position_of_body = position(curve.value);
    T w(1);
    if constexpr (std::is_same_v<Landmark, PointLandmark>) {
      point = Eigen::Map<const Vector>(others[1]);
    } else {
      w = *others[1];
      point = w * landmark.origin.template cast<T>() + landmark.ray.template cast<T>();
    }
    const Vector p_B = rotation(curve.value).unit_quaternion().conjugate() * Vector(point - w * position_of_body);
    const Vector p_C = T_BC.unit_quaternion().conjugate() * Vector(p_B - w * T_BC.translation());
    using Model = ModelOf<T>;
    const auto image = Model::from_parameters(Eigen::Map<const typename Model::Parameters>(others[4])).project(p_C);
    if (!image) return false;
    Eigen::Map<Eigen::Vector2<T>>{residuals} = weight.cast<T>() * (*image - pixel.cast<T>());
    return true;
  }
};

template <typename T>
using RadtanModel = Pinhole<RadialTangential<T>>;
template <typename T>
using FisheyeModel = Pinhole<Equidistant<T>>;

template <LieGroup G, int Order, template <typename> typename ModelOf, typename Landmark>
void check_reprojection(const typename ModelOf<double>::Parameters& intrinsics) {
  using Model = ModelOf<double>;
  testing::Random random(Order);
  const double u = 0.4, interval = 1, rows = 20, line_delay = 3e-5;
  const Eigen::Vector2d pixel(310, 250);
  for (const double turn : {0.5, 1e-8}) {
    const auto points = testing::control_points<G>(Order, {"", turn, 1}, random);
    const auto weight = testing::some_weight<2>(random);
    const Sophus::SE3d T_BC(Sophus::SO3d::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(0.05, 0.04, -0.03));
    const G body = evaluate<0>(std::span<const G, Order>(points), uniform_basis<Order, 0>(u, interval)).value;
    const Sophus::SE3d T_WC = Sophus::SE3d(rotation(body), position(body)) * T_BC;
    const Eigen::Vector3d seen = T_WC * Eigen::Vector3d(0.4, -0.3, 5);

    testing::Parameters p;
    p.add(points);
    p.add(std::vector<Sophus::SE3d>{T_BC});
    Landmark landmark{};
    if constexpr (std::is_same_v<Landmark, PointLandmark>) {
      p.add(Eigen::VectorXd(seen));
    } else {
      landmark.origin = T_WC * Eigen::Vector3d(0.5, 0, 0);
      landmark.ray = (seen - landmark.origin).normalized();
      p.add(Eigen::VectorXd::Constant(1, 1 / (seen - landmark.origin).norm()));
    }
    p.add(Eigen::VectorXd::Constant(1, 2e-3));
    p.add(Eigen::VectorXd::Constant(1, 2.9e-5));
    p.add(Eigen::VectorXd(intrinsics));
    const CeresReprojectionResidual<G, Order, Model, Landmark> cost(u, interval, rows, line_delay, pixel, weight,
                                                                    landmark);
    const ReprojectionFunctor<G, Order, ModelOf, Landmark> functor{u,     interval, rows,    line_delay,
                                                                   pixel, weight,   landmark};
    CHECK(testing::compare_with_jets(cost, functor, p) <= 20);
    if (turn > 0.1) testing::check_gradients(cost, p);
  }
}

using SE3d = Sophus::SE3d;
using Split = SO3xR3<double>;

const Eigen::Vector<double, 8> radtan{458, 457, 367, 248, -0.28, 0.07, 2e-4, 2e-5};
const Eigen::Vector<double, 8> fisheye{191, 190, 255, 257, 3e-3, 7e-4, -2e-3, 2e-4};
const Eigen::Vector<double, 6> sphere{313, 314, 320, 240, -0.18, 0.59};

}  // namespace

TEST_CASE("The Jacobians of a reprojection are those of automatic differentiation") {
  check_reprojection<SE3d, 4, RadtanModel, PointLandmark>(radtan);
  check_reprojection<Split, 4, RadtanModel, PointLandmark>(radtan);
  check_reprojection<Split, 5, FisheyeModel, PointLandmark>(fisheye);
  check_reprojection<SE3d, 4, DoubleSphere, InverseDepthLandmark>(sphere);
  check_reprojection<Split, 4, DoubleSphere, InverseDepthLandmark>(sphere);
}

TEST_CASE("A reprojection is evaluated or refused, and never NaN") {
  using Cost = CeresReprojectionResidual<Split, 4, RadtanModel<double>>;
  const Cost cost(0.5, 0.1, 0, 0, {320, 240}, Eigen::Matrix2d::Identity());
  testing::Parameters p;
  p.add(std::vector<Split>(4));
  p.add(std::vector<SE3d>(1));
  p.add(Eigen::VectorXd(Eigen::Vector3d(0, 0, 2)));
  p.add(Eigen::VectorXd::Zero(1));
  p.add(Eigen::VectorXd::Zero(1));
  p.add(Eigen::VectorXd(radtan));
  const auto evaluates = [&] {
    Eigen::Vector2d r(0, 0);
    return cost.Evaluate(p.pointers().data(), r.data(), nullptr) && r.allFinite();
  };
  const std::size_t landmark = 9, offset = 10, intrinsics = 12;
  REQUIRE(p.blocks[intrinsics].size() == 8);
  CHECK(evaluates());
  p.blocks[landmark] = {0, 0, -2};  // behind the camera
  CHECK_FALSE(evaluates());
  p.blocks[landmark] = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  CHECK_FALSE(evaluates());
  p.blocks[landmark] = {0, 0, 2};
  p.blocks[offset] = {0.14};  // within an interval of the segment
  CHECK(evaluates());
  p.blocks[offset] = {0.16};
  CHECK_FALSE(evaluates());
  p.blocks[offset] = {0};
  p.blocks[intrinsics][0] = -458;
  CHECK_FALSE(evaluates());
}
