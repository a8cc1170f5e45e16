// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <splinertia/camera/linearize_observation.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

namespace {

using Real = long double;
using Vector3 = Eigen::Vector3<Real>;
using Pixel = Eigen::Vector2<Real>;
using SE3 = Sophus::SE3<Real>;

constexpr ImageSize size{752, 480};
constexpr Real frame_time = 1.02L, step = 1e-6L;
constexpr Wrt all =
    Wrt::parameters | Wrt::pose | Wrt::control_points | Wrt::landmark | Wrt::T_BC | Wrt::clock_offset | Wrt::line_delay;

const SE3 T_BC(Sophus::SO3<Real>::exp(Vector3(0.4L, -0.8L, 1.1L)), Vector3(0.1L, 0.05L, -0.02L));
const Pinhole model{458.654L, 457.296L, 367.215L, 248.375L, RadialTangential{-0.283L, 0.0739L, 0.00019L, 1.76e-5L}};

template <typename T>
concept HasLandmarkJacobian = requires(T t) { t.landmark_jacobian; };
template <typename T>
concept HasPoseJacobian = requires(T t) { t.pose_jacobian; };

/// A camera on a fast curve that sees one landmark.
template <typename G>
struct Setting {
  std::vector<G> points = testing::Random(5).walk<G>(20, 0.8);
  SE3 T_BC = ::T_BC;
  Pinhole<RadialTangential<Real>> model = ::model;
  RollingShutter<Real, MiddleRow> shutter{50e-6L};
  Real time = frame_time;
  Vector3 landmark = landmark_ahead();

  [[nodiscard]] Spline<G, 4, UniformKnots<Real>> curve() const { return {{.start = 0, .interval = 0.1L}, points}; }
  [[nodiscard]] auto camera() const { return Camera{model, size, T_BC, shutter}; }
  [[nodiscard]] Vector3 landmark_ahead() const {
    const auto pose = curve().template evaluate<0>(frame_time).value;
    return SE3(rotation(pose), position(pose)) * (T_BC * Vector3(0.3L, -0.4L, 4));
  }
  [[nodiscard]] auto observation() const {
    const auto found = observe(curve(), camera(), landmark, time);
    REQUIRE(found.size() == 1);
    return found[0];
  }
  [[nodiscard]] Pixel pixel() const { return observation().pixel; }
};

/// d pixel/dx of what `change(setting, x)` changes.
template <typename G>
Pixel derivative(const auto& change) {
  const auto at = [&](Real x) {
    Setting<G> setting;
    change(setting, x);
    return setting.pixel();
  };
  return (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
}

void check_near(const Pixel& analytic, const Pixel& numeric, Real scale) {
  CHECK((analytic - numeric).norm() <= 1e-9L * scale);
}

}  // namespace

TEMPLATE_TEST_CASE("Derivatives of an observed pixel are those of observing again", "", SO3xR3<Real>, SE3) {
  using G = TestType;
  const Setting<G> setting;
  const auto found = setting.observation();
  const auto at = linearize_observation<all>(setting.curve(), setting.camera(), setting.landmark, frame_time, found);
  REQUIRE(at);
  CHECK((at->pixel - found.pixel).norm() < 1e-15L);
  CHECK(at->rate.norm() > 1000);
  const Real size_of_rate = at->rate.norm();

  for (int i = 0; i < 3; ++i) {
    check_near(at->landmark_jacobian.col(i), derivative<G>([&](auto& s, Real x) { s.landmark[i] += x; }), 1000);
  }
  for (int i = 0; i < 6; ++i) {
    check_near(at->T_BC_jacobian.col(i), derivative<G>([&](auto& s, Real x) {
                 using Traits = GroupTraits<SE3>;
                 s.T_BC = Traits::compose(s.T_BC, Traits::exp(Tangent<SE3>::Unit(i) * x));
               }),
               1000);
  }
  check_near(at->clock_offset_jacobian, derivative<G>([](auto& s, Real x) { s.time += x; }), size_of_rate);
  check_near(at->line_delay_jacobian / 1000, derivative<G>([](auto& s, Real x) { s.shutter.line_delay += x / 1000; }),
             size_of_rate);
  for (int i = 0; i < 8; ++i) {
    check_near(at->parameter_jacobian.col(i), derivative<G>([&](auto& s, Real x) {
                 auto p = s.model.parameters();
                 p[i] += x;
                 s.model = Pinhole<RadialTangential<Real>>::from_parameters(p);
               }),
               1000);
  }
  // 4 control points move the pixel; others do not.
  for (std::size_t point = 0; point < setting.points.size(); ++point) {
    const bool moves = point >= at->first && point < at->first + 4;
    for (int i = 0; i < 6; ++i) {
      const Pixel numeric = derivative<G>([&](auto& s, Real x) {
        s.points[point] = GroupTraits<G>::compose(s.points[point], GroupTraits<G>::exp(Tangent<G>::Unit(i) * x));
      });
      if (moves) {
        check_near(at->control_point_jacobian[point - at->first].col(i), numeric, 1000);
      } else {
        CHECK(numeric.norm() < 1e-9L);
      }
    }
  }
}

TEMPLATE_TEST_CASE("The derivative by the pose moves the whole curve", "", SO3xR3<Real>, SE3) {
  using G = TestType;
  const Setting<G> setting;
  const auto curve = setting.curve();
  const auto found = setting.observation();
  const auto at = linearize_observation<Wrt::pose>(curve, setting.camera(), setting.landmark, frame_time, found);
  REQUIRE(at);
  // X(t) E with constant E: all poses have the same right perturbation.
  const auto moved = [&](Real t, const Tangent<G>& tau) {
    auto m = curve.template evaluate<1>(t);
    const G E = GroupTraits<G>::exp(tau);
    m.value = GroupTraits<G>::compose(m.value, E);
    m.velocity = GroupTraits<G>::adjoint(GroupTraits<G>::inverse(E), m.velocity);
    return m;
  };
  for (int i = 0; i < 6; ++i) {
    const auto pixel = [&](Real x) {
      // Newton's method from the observation without the perturbation.
      auto offset = found.row_offset;
      Pixel p;
      for (int k = 0; k < 40; ++k) {
        const auto m = moved(frame_time + offset, Tangent<G>::Unit(i) * x);
        const auto l = linearize_observation<Wrt::nothing>(m, setting.camera(), setting.landmark);
        REQUIRE(l);
        p = l->pixel;
        const Real delay = setting.shutter.line_delay, row = offset / delay + Real(size.height - 1) / 2;
        offset -= delay * (row - p.y()) / (1 - delay * l->rate.y());
      }
      return p;
    };
    const Pixel numeric = (8 * (pixel(step) - pixel(-step)) - (pixel(2 * step) - pixel(-2 * step))) / (12 * step);
    check_near(at->pose_jacobian.col(i), numeric, 1000);
  }
}

TEST_CASE("A global shutter leaves the plain derivatives of the projection") {
  using G = SO3xR3<double>;
  const auto points = testing::Random(5).walk<G>(20, 0.8);
  const Spline<G, 4> curve({.start = 0, .interval = 0.1}, points);
  const auto pose = curve.evaluate<0>(1.02).value;
  const Pinhole lens{458.654, 457.296, 367.215, 248.375, NoDistortion<double>{}};
  const Camera camera{lens, size, T_BC.cast<double>()};
  const Eigen::Vector3d p_C(0.3, -0.4, 4);
  const Eigen::Vector3d landmark = Sophus::SE3d(rotation(pose), position(pose)) * (camera.T_BC() * p_C);
  const auto found = observe(curve, camera, landmark, 1.02);
  REQUIRE(found.size() == 1);
  const auto at = linearize_observation<Wrt::landmark | Wrt::clock_offset | Wrt::line_delay>(curve, camera, landmark,
                                                                                             1.02, found[0]);
  REQUIRE(at);
  const auto plain = lens.linearize<Wrt::point>(p_C);
  const Eigen::Matrix3d R_WC = (rotation(pose) * camera.T_BC().so3()).matrix();
  CHECK((at->landmark_jacobian - plain->point_jacobian * R_WC.transpose()).norm() < 1e-10);
  CHECK(at->clock_offset_jacobian == at->rate);
  CHECK(at->line_delay_jacobian.norm() == 0);
}

TEST_CASE("The time of a row may be between two ticks") {
  using std::chrono::nanoseconds;
  using G = SO3xR3<double>;
  const auto points = testing::Random(5).walk<G>(20, 0.8);
  const Spline<G, 4> fine({.start = 0, .interval = 0.1}, points);
  const nanoseconds epoch(1'403'636'579'763'555'584);
  const Spline<G, 4, UniformKnots<nanoseconds>> coarse({epoch, nanoseconds(100'000'000)}, points);
  const Camera camera{Pinhole{458.654, 457.296, 367.215, 248.375, NoDistortion<double>{}}, size, T_BC.cast<double>(),
                      RollingShutter{50.123456e-6}};
  const auto pose = fine.evaluate<0>(1.02).value;
  const Eigen::Vector3d landmark =
      Sophus::SE3d(rotation(pose), position(pose)) * (camera.T_BC() * Eigen::Vector3d(0.3, -0.4, 4));
  const auto a = observe(fine, camera, landmark, 1.02);
  const auto b = observe(coarse, camera, landmark, epoch + nanoseconds(1'020'000'000));
  REQUIRE((a.size() == 1 && b.size() == 1));
  const auto at_a = linearize_observation<Wrt::landmark>(fine, camera, landmark, 1.02, a[0]);
  const auto at_b =
      linearize_observation<Wrt::landmark>(coarse, camera, landmark, epoch + nanoseconds(1'020'000'000), b[0]);
  REQUIRE((at_a && at_b));
  // The rate of the pixel is that of the nearest tick.
  CHECK((at_a->landmark_jacobian - at_b->landmark_jacobian).norm() < 1e-9 * at_a->landmark_jacobian.norm());
  CHECK((at_a->pixel - at_b->pixel).norm() < 1e-10);
}

TEST_CASE("What is not requested does not exist, and nothing is derived outside the domain") {
  using Nothing = ObservationLinearization<double, 4, Wrt::nothing>;
  STATIC_CHECK(sizeof(Nothing) == sizeof(Eigen::Vector4d));
  STATIC_CHECK_FALSE(HasLandmarkJacobian<Nothing>);
  using Landmark = ObservationLinearization<double, 4, Wrt::landmark>;
  STATIC_CHECK(HasLandmarkJacobian<Landmark>);
  STATIC_CHECK_FALSE(HasPoseJacobian<Landmark>);
  Motion<SO3xR3<double>, 1> still;
  still.value = GroupTraits<SO3xR3<double>>::identity();
  still.velocity.setZero();
  const Camera camera{Pinhole{458.654, 457.296, 367.215, 248.375, NoDistortion<double>{}}, size};
  CHECK_FALSE(linearize_observation<Wrt::landmark>(still, camera, Eigen::Vector3d(0, 0, -1)));
  CHECK(linearize_observation<Wrt::landmark>(still, camera, Eigen::Vector3d(0, 0, 1)));
}
