// SPDX-License-Identifier: MIT
#include <splinertia/camera/kalibr_camera.hpp>

#include <cstdint>
#include <limits>
#include <splinertia/camera/any_camera_model.hpp>
#include <splinertia/camera/kalibr_mounting.hpp>
#include <variant>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::message_of;

namespace {

/// Parameters, all different, that any model accepts.
template <typename Model>
Model some_model() {
  Eigen::Matrix<typename Model::Scalar, Model::parameter_count, 1> p;
  constexpr auto layout = detail::kalibr_layout<Model>();
  for (int i = 0; i < Model::parameter_count; ++i) p[i] = typename Model::Scalar(i + 1) / 64;
  const int focal = layout.camera_model == "omni" ? 1 : 0;
  for (int i = 0; i < 4 && focal + i < Model::parameter_count; ++i) p[focal + i] *= 8192;
  return Model::from_parameters(p);
}

}  // namespace

TEMPLATE_TEST_CASE("A model becomes an entry and back, to the same bits", "", Pinhole<NoDistortion<double>>,
                   Pinhole<RadialTangential<double>>, Pinhole<Rational<double>>, Pinhole<Equidistant<double>>,
                   FieldOfView<double>, Unified<NoDistortion<double>>, Unified<RadialTangential<double>>,
                   DoubleSphere<double>, ExtendedUnified<double>, Equirectangular<double>,
                   Pinhole<RadialTangential<float>>, DoubleSphere<float>) {
  const auto model = some_model<TestType>();
  const KalibrCamera entry = to_kalibr(model);
  CHECK(from_kalibr<TestType>(entry).parameters() == model.parameters());
  CHECK(names_model<TestType>(entry));
  if constexpr (std::same_as<typename TestType::Scalar, double>) {
    const AnyCameraModel any = any_camera_model(entry);
    REQUIRE(std::holds_alternative<TestType>(any));
    CHECK(std::get<TestType>(any).parameters() == model.parameters());
  }
}

TEST_CASE("Entries have Kalibr's names and order") {
  using Numbers = std::vector<double>;
  const auto pinhole = to_kalibr(Pinhole(458.0, 457.0, 367.0, 248.0, Equidistant(0.1, 0.2, 0.3, 0.4)));
  CHECK(pinhole.camera_model == "pinhole");
  CHECK(pinhole.intrinsics == Numbers{458, 457, 367, 248});
  CHECK(pinhole.distortion_model == "equidistant");
  CHECK(pinhole.distortion_coeffs == Numbers{0.1, 0.2, 0.3, 0.4});

  const auto omni = to_kalibr(Unified(1.5, 458.0, 457.0, 367.0, 248.0, RadialTangential(0.1, 0.2, 0.01, 0.02)));
  CHECK(omni.camera_model == "omni");
  CHECK(omni.intrinsics == Numbers{1.5, 458, 457, 367, 248});
  CHECK(omni.distortion_model == "radtan");
  CHECK(omni.distortion_coeffs == Numbers{0.1, 0.2, 0.01, 0.02});

  const auto ds = to_kalibr(DoubleSphere(458.0, 457.0, 367.0, 248.0, -0.2, 0.6));
  CHECK(ds.camera_model == "ds");
  CHECK(ds.intrinsics == Numbers{-0.2, 0.6, 458, 457, 367, 248});
  CHECK(ds.distortion_model == "none");
  CHECK(ds.distortion_coeffs.empty());

  CHECK(to_kalibr(ExtendedUnified(458.0, 457.0, 367.0, 248.0, 0.6, 1.1)).intrinsics ==
        Numbers{0.6, 1.1, 458, 457, 367, 248});
  const auto fov = to_kalibr(FieldOfView(458.0, 457.0, 367.0, 248.0, 0.9));
  CHECK(fov.camera_model == "pinhole");
  CHECK(fov.distortion_model == "fov");
  CHECK(fov.distortion_coeffs == Numbers{0.9});
}

TEST_CASE("An entry that is not of the model is refused by name and count") {
  using Radtan = Pinhole<RadialTangential<double>>;
  KalibrCamera entry = to_kalibr(some_model<Radtan>());
  CHECK(message_of([&] { return from_kalibr<Pinhole<Equidistant<double>>>(entry); }) ==
        "KalibrCamera: camera_model is pinhole, distortion_model is radtan, expected pinhole and equidistant");
  entry.intrinsics.pop_back();
  CHECK(message_of([&] { return from_kalibr<Radtan>(entry); }) ==
        "KalibrCamera: intrinsics has 3 numbers, expected 4 for pinhole-radtan");
  entry = to_kalibr(some_model<Radtan>());
  entry.distortion_coeffs.push_back(0);
  CHECK(message_of([&] { return any_camera_model(entry); }) ==
        "KalibrCamera: distortion_coeffs has 5 numbers, expected 4 for pinhole-radtan");
  entry.distortion_model = "plumb_bob";
  CHECK(message_of([&] { return any_camera_model(entry); }) ==
        "KalibrCamera: camera_model is pinhole, distortion_model is plumb_bob, expected one of pinhole none, pinhole "
        "radtan, pinhole radtan8, pinhole equidistant, pinhole fov, omni none, omni radtan, omni radtan8, ds none, "
        "eucm none, equirectangular none");
  entry = to_kalibr(some_model<Radtan>());
  entry.intrinsics[1] = -1;
  CHECK(message_of([&] { return any_camera_model(entry); }) == "Pinhole: fy is -1, expected a finite number > 0");
  entry.intrinsics[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(message_of([&] { return any_camera_model(entry); }) == "Pinhole: fy is nan, expected a finite number > 0");
}

TEST_CASE("equi is read as equidistant") {
  KalibrCamera entry = to_kalibr(some_model<Pinhole<Equidistant<double>>>());
  entry.distortion_model = "equi";
  CHECK(from_kalibr<Pinhole<Equidistant<double>>>(entry).parameters() ==
        some_model<Pinhole<Equidistant<double>>>().parameters());
}

TEST_CASE("T_cam_imu is the inverse of T_BC") {
  const Sophus::SE3d T_BC(Sophus::SO3d::exp({0.3, -0.4, 1.2}), Eigen::Vector3d(0.1, 0.2, -0.05));
  KalibrCamera entry;
  CHECK(message_of([&] { return T_BC_of(entry); }) == "KalibrCamera: no T_cam_imu, expected one");
  entry.T_cam_imu = T_cam_imu_of(T_BC);
  const Eigen::Vector3d of_imu(1, 2, 3), of_camera = (*entry.T_cam_imu * of_imu.homogeneous()).head<3>();
  CHECK((T_BC * of_camera - of_imu).norm() < 1e-14);
  CHECK((T_BC_of(entry).matrix() - T_BC.matrix()).norm() < 1e-15);
  CHECK((T_BC_of<float>(entry).matrix() - T_BC.cast<float>().matrix()).norm() < 1e-6F);

  entry.T_cam_imu = (*entry.T_cam_imu * 1e6).array().round() / 1e6;  // as a file with six decimals
  CHECK((T_BC_of(entry).matrix() - T_BC.matrix()).norm() < 3e-6);
  CHECK(std::abs(T_BC_of(entry).rotationMatrix().determinant() - 1) < 1e-15);
}

TEST_CASE("A matrix that is no pose is refused") {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T(0, 0) = 1.01;
  CHECK(
      message_of([&] { return pose_of_matrix(T); }).starts_with("pose_of_matrix: a rotation has the determinant 1.01"));
  T = Eigen::Matrix4d::Identity();
  T(2, 2) = -1;
  CHECK(message_of([&] { return pose_of_matrix(T); }) ==
        "pose_of_matrix: a rotation has the determinant -1 and deviates from an orthogonal matrix by 0, expected 1 and "
        "at "
        "most 0.0001");
  T = Eigen::Matrix4d::Identity();
  T(3, 0) = 2;
  CHECK(message_of([&] { return pose_of_matrix(T); }) == "pose_of_matrix: the last row is 2 0 0 1, expected 0 0 0 1");
  T = Eigen::Matrix4d::Identity();
  T(1, 3) = std::numeric_limits<double>::infinity();
  CHECK(message_of([&] { return pose_of_matrix(T); }) != "nothing thrown");
}

TEST_CASE("A camera becomes an entry and back") {
  using Model = DoubleSphere<double>;
  const Sophus::SE3d T_BC(Sophus::SO3d::exp({0.3, -0.4, 1.2}), Eigen::Vector3d(0.1, 0.2, -0.05));
  const Camera camera{some_model<Model>(), ImageSize{752, 480}, T_BC, RollingShutter{29.4e-6}};
  const KalibrCamera entry = to_kalibr(camera);
  CHECK(entry.camera_model == "ds");
  CHECK(entry.resolution == std::array{752, 480});
  CHECK(entry.line_delay == 29.4e-6);
  const auto again = camera_from_kalibr<Model>(entry, RollingShutter{*entry.line_delay});
  CHECK(again.model().parameters() == camera.model().parameters());
  CHECK((again.T_BC().matrix() - T_BC.matrix()).norm() < 1e-15);
  CHECK(again.shutter().line_delay == 29.4e-6);
  CHECK(again.size().width == 752);

  CHECK_FALSE(to_kalibr(Camera{some_model<Model>(), ImageSize{752, 480}, T_BC}).line_delay);
  KalibrCamera bad = entry;
  bad.resolution[1] = 0;
  CHECK(message_of([&] { return camera_from_kalibr<Model>(bad); }).starts_with("ImageSize: height is 0, expected "));
}
