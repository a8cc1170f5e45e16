// SPDX-License-Identifier: MIT
// A rolling shutter reads an image row by row. observe() finds the rows in which a landmark appears while they are read.

#include <cmath>
#include <cstdio>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/linearize_observation.hpp>
#include <splinertia/camera/observe.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/constant_twist.hpp>

using namespace splinertia;

int main() {
  using Pose = SO3xR3<double>;
  const Pinhole model(460.0, 460.0, 320.0, 240.0, RadialTangential(-0.28, 0.07, 2e-4, 2e-5));
  const ImageSize size{640, 480};
  const Sophus::SE3d T_BC;  // the camera's axes are those of the body: x to the right, y down, z forward
  const Camera global(model, size, T_BC);
  const Camera rolling(model, size, T_BC, RollingShutter{30e-3 / 480});  // 30 ms for an image
  const Eigen::Vector3d landmark(0.4, 0.1, 4);                           // m

  // A drone pitches about its x axis. An image that moves down faster than rows are read is never caught up with.
  std::puts("pitch [rad/s]   global shutter     rolling shutter      row read after");
  for (const double pitch : {0.0, 0.5, 2.0, 10.0, 40.0, -2.0, -40.0}) {
    const ConstantTwist<Pose> drone{Pose{}, pitch * Tangent<Pose>::UnitX()};
    const auto at_once = observe(drone, global, landmark, 0.0);
    std::printf("%8.1f       %7.2f %7.2f", pitch, at_once[0].pixel.x(), at_once[0].pixel.y());
    const auto row_by_row = observe(drone, rolling, landmark, 0.0);
    if (row_by_row.empty()) std::printf("    not seen");
    for (const auto& o : row_by_row) {
      std::printf("    %7.2f %7.2f   %8.3f ms", o.pixel.x(), o.pixel.y(), 1e3 * o.row_offset);
    }
    std::puts("");
  }

  // What an error of the line delay does to a pixel, for calibrating it.
  const ConstantTwist<Pose> drone{Pose{}, 2 * Tangent<Pose>::UnitX()};
  const auto seen = observe(drone, rolling, landmark, 0.0);
  const auto linear = linearize_observation<Wrt::line_delay>(drone, rolling, landmark, 0.0, seen[0]);
  std::printf("1 us more a row moves it by %.4f %.4f pixels\n", 1e-6 * linear->line_delay_jacobian.x(),
              1e-6 * linear->line_delay_jacobian.y());
}

// prints
// pitch [rad/s]   global shutter     rolling shutter      row read after
//      0.0        365.86  251.47     365.86  251.47     15.717 ms
//      0.5        365.86  251.47     365.87  255.12     15.945 ms
//      2.0        365.86  251.47     365.89  266.77     16.673 ms
//     10.0        365.86  251.47     366.46  353.01     22.063 ms
//     40.0        365.86  251.47    not seen
//     -2.0        365.86  251.47     365.86  237.83     14.864 ms
//    -40.0        365.86  251.47     366.56  116.96      7.310 ms
// 1 us more a row moves it by 0.0007 0.2598 pixels
