// SPDX-License-Identifier: MIT
// A camera model takes points to pixels and pixels to rays. It knows where it is one-to-one, and gives nothing elsewhere.

#include <cmath>
#include <cstdio>
#include <splinertia/camera/pinhole.hpp>

using namespace splinertia;

int main() {
  // The left camera of EuRoC: fx, fy, cx, cy in pixels, then k1, k2, p1, p2. Pixel (0, 0) is the centre of the upper left
  // pixel. Points are in the camera frame: x right, y down, z forward.
  const Pinhole camera(458.654, 457.296, 367.215, 248.375,
                       RadialTangential(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05));
  const Eigen::Vector3d point(1, -0.5, 2);
  const auto pixel = camera.project(point);
  std::printf("pixel                  %8.3f %8.3f\n", pixel->x(), pixel->y());

  // The way back: the ray, of length 1.
  const auto ray = camera.unproject(*pixel);
  std::printf("ray                    %8.3f %8.3f %8.3f\n", ray->x(), ray->y(), ray->z());

  // Jacobians of the pixel, with respect to what is named: the point, the parameters or both.
  const auto p = camera.linearize<Wrt::point | Wrt::parameters>(point);
  std::printf("pixels per m of x      %8.3f %8.3f\n", p->point_jacobian(0, 0), p->point_jacobian(1, 0));
  std::printf("pixels per unit of k1  %8.3f %8.3f\n", p->parameter_jacobian(0, 4), p->parameter_jacobian(1, 4));

  // Outside of the domain there is nothing: behind this camera, at angles that the fisheye sees, and beyond the angle at
  // which the third lens would fold its image.
  const Pinhole fisheye(190.98, 190.97, 254.93, 256.90, Equidistant(0.0034823, 0.0007150, -0.0020532, 0.0002029));
  const Pinhole folding(458.0, 457.0, 367.0, 248.0, RadialTangential(-0.3, 0.0, 0.0, 0.0));
  constexpr double degree = 3.14159265358979 / 180;
  std::puts("angle [deg]       radtan      fisheye      folding");
  for (const double angle : {30.0, 50.0, 70.0, 95.0}) {
    const Eigen::Vector3d far(std::sin(angle * degree), 0, std::cos(angle * degree));
    std::printf("%11.0f", angle);
    for (const auto& found : {camera.project(far), fisheye.project(far), folding.project(far)}) {
      found ? std::printf("  %8.2f px", found->x()) : std::printf("  %11s", "-");
    }
    std::puts("");
  }
  std::printf("the end     %11.1f  %11.1f  %11.1f\n", camera.largest_angle() / degree, fisheye.largest_angle() / degree,
              folding.largest_angle() / degree);
}

// prints
// pixel                   577.872  143.387
// ray                       0.436   -0.218    0.873
// pixels per m of x       183.467   13.600
// pixels per unit of k1    71.665  -35.726
// angle [deg]       radtan      fisheye      folding
//          30    609.19 px    355.02 px    604.98 px
//          50    775.38 px    421.96 px            -
//          70   4242.31 px    488.48 px            -
//          95            -    566.49 px            -
// the end            90.0        180.0         46.5
