// SPDX-License-Identifier: MIT
// Calibrates a camera from the noisy corners of a chessboard in twelve images, with Ceres.

#include <ceres/ceres.h>

#include <cstdio>
#include <splinertia/adapters/ceres_manifold.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/group/sophus.hpp>
#include <splinertia/random/normal.hpp>
#include <vector>

using namespace splinertia;
using Sophus::SE3, Sophus::SO3d, Eigen::Vector2d, Eigen::Vector3d;
template <typename T>
using Model = Pinhole<RadialTangential<T>>;

struct Residual {
  Vector3d corner;
  Vector2d pixel;

  template <typename T>
  bool operator()(const T* parameters, const T* pose, T* residual) const {
    const auto model = Model<T>::from_parameters(Eigen::Map<const typename Model<T>::Parameters>(parameters));
    const auto seen = model.project(Eigen::Map<const SE3<T>>(pose) * corner.cast<T>());
    if (seen) Eigen::Map<Eigen::Vector2<T>>{residual} = *seen - pixel.cast<T>();
    return seen.has_value();  // outside of the domain Ceres takes a shorter step
  }
};

int main() {
  const Model<double> truth(458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
  // The search begins without distortion, and with all cameras half a metre in front of the board.
  auto found = Model<double>(400, 400, 376, 240, {0, 0, 0, 0}).parameters();
  std::vector<SE3<double>> poses(12, {SO3d(), Vector3d(-0.15, -0.1, 0.5)});
  ceres::Problem problem;
  NormalStream<> normal(StreamKey(1));
  for (SE3<double>& pose : poses) {
    const Vector3d turn{normal(), normal(), normal()}, shift{normal(), normal(), normal()};
    const SE3<double> T_CW = pose * SE3<double>(SO3d::exp(0.25 * turn), 0.05 * shift);
    for (int i = 0; i < 88; ++i) {
      const Vector3d corner(0.03 * (i % 11), 0.03 * (i / 11), 0);
      const Vector2d noise{normal(), normal()}, pixel = truth.project(T_CW * corner).value() + 0.2 * noise;
      using Cost = ceres::AutoDiffCostFunction<Residual, 2, 8, 7>;
      problem.AddResidualBlock(new Cost(new Residual{corner, pixel}), nullptr, found.data(), pose.data());
    }
    problem.SetManifold(pose.data(), new CeresManifold<SE3<double>>());
  }
  ceres::Solver::Summary summary;
  ceres::Solve({}, &problem, &summary);

  for (const auto& p : {found, truth.parameters()}) {
    std::printf("f %6.2f %6.2f  c %6.2f %6.2f  k %6.3f %6.3f\n", p[0], p[1], p[2], p[3], p[4], p[5]);
  }
}

// prints
// f 458.02 456.54  c 367.77 247.45  k -0.280  0.068
// f 458.65 457.30  c 367.21 248.38  k -0.283  0.074
