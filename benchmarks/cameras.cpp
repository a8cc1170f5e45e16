// SPDX-License-Identifier: MIT
// What cameras cost, a point: projections alone, with both Jacobians and many at once; rays; and landmarks observed
// from a moving body with a global and a rolling shutter. Beside it, projections written by hand (--check-overhead).
//
// Workload: 1000 points at up to 40 degrees from the axis; a cubic on SO(3) × R³, 640 × 480 pixels, 30 ms of readout.

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/distortion/rational.hpp>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/linearize_observation.hpp>
#include <splinertia/camera/observe.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/project.hpp>
#include <splinertia/camera/unified.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
#include <vector>

#include "support/overhead.hpp"

using namespace splinertia;

namespace {

using Point = Eigen::Vector3d;
using Pixel = Eigen::Vector2d;
using Curve = Spline<SO3xR3<double>, 4>;

constexpr std::size_t many = 1000;

const std::vector<Point>& points() {
  static const std::vector<Point> the = [] {
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> side(-0.55, 0.55), depth(1, 9);
    std::vector<Point> p;
    for (std::size_t i = 0; i < many; ++i) p.push_back(depth(bits) * Point(side(bits), side(bits), 1));
    return p;
  }();
  return the;
}

/// Calls f(i), i < many, again and again.
benchmark::Kernel each_point(const std::string& name, auto f) {
  return {name, [f](std::size_t calls) {
            for (std::size_t i = 0; i < calls; ++i) f(i % many);
          }};
}

template <CameraModel Model>
void add_model(std::vector<benchmark::Kernel>& kernels, const std::string& name, const Model& model) {
  auto pixels = std::make_shared<std::vector<Pixel>>(many, Pixel(300, 200));
  for (std::size_t i = 0; i < many; ++i) {
    if (const auto pixel = model.project(points()[i])) (*pixels)[i] = *pixel;
  }
  auto inside = std::make_shared<std::array<bool, many>>();
  kernels.push_back(
      each_point("project_" + name, [model](std::size_t i) { benchmark::keep(model.project(points()[i])); }));
  kernels.push_back(each_point("linearize_" + name, [model](std::size_t i) {
    benchmark::keep(model.template linearize<Wrt::point | Wrt::parameters>(points()[i]));
  }));
  kernels.push_back(each_point("unproject_" + name,
                               [model, pixels](std::size_t i) { benchmark::keep(model.unproject((*pixels)[i])); }));
  kernels.push_back({"project_many_" + name, [model, pixels, inside](std::size_t calls) {
                       for (std::size_t n; calls > 0; calls -= n) {
                         n = std::min(calls, many);
                         project(model, std::span(points()).first(n), std::span(*pixels).first(n),
                                 std::span(*inside).first(n));
                         benchmark::keep(pixels->front());
                       }
                     }});
}

// The body turns by about 2 rad/s among landmarks that surround it.
const Curve& curve() {
  static const Curve the = [] {
    std::vector<SO3xR3<double>> p;
    for (int i = 0; i < 24; ++i) {
      p.push_back(
          {Sophus::SO3d::exp({0.2 * std::sin(0.7 * i), 0.2 * i, 0.1}), {std::cos(0.2 * i), std::sin(0.2 * i), 1}});
    }
    return Curve({.start = 0, .interval = 0.1}, p);
  }();
  return the;
}

template <typename Camera>
void add_camera(std::vector<benchmark::Kernel>& kernels, const std::string& name, const Camera& camera) {
  // Landmarks that the camera has before it at 1 s.
  auto landmarks = std::make_shared<std::vector<Point>>();
  const auto at = curve().evaluate<0>(1.0).value;
  for (const Point& p : points()) landmarks->push_back(rotation(at) * (camera.T_BC() * p) + position(at));
  const auto kept = std::make_shared<const Camera>(camera);  // which the frame refers to
  auto frame = std::make_shared<FrameObserver<Curve, Camera>>(curve(), *kept, 1.0);
  auto seen = std::make_shared<Observation<double, double>>();
  for (const Point& p : *landmarks) {
    for (const auto& o : (*frame)(p)) *seen = o;
  }
  kernels.push_back(each_point("observe_" + name, [camera, landmarks](std::size_t i) {
    benchmark::keep(observe(curve(), camera, (*landmarks)[i], 1.0));
  }));
  kernels.push_back(each_point("observe_frame_" + name, [frame, kept, landmarks](std::size_t i) {
    benchmark::keep((*frame)((*landmarks)[i]));
  }));
  kernels.push_back(each_point("linearize_observation_" + name, [camera, landmarks, seen](std::size_t i) {
    benchmark::keep(linearize_observation<Wrt::control_points | Wrt::landmark | Wrt::T_BC>(
        curve(), camera, (*landmarks)[i], 1.0, *seen));
  }));
}

// By hand: what people write, with the same checks.

struct PlainPinhole {
  double fx, fy, cx, cy, k1, k2, p1, p2, most_square;
};

using Radtan = Pinhole<RadialTangential<double>>;
const RadialTangential<double> distortion(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05);
const Radtan radtan(458.654, 457.296, 367.215, 248.375, distortion);
const Pinhole<NoDistortion<double>> pinhole(458.654, 457.296, 367.215, 248.375, {});
const PlainPinhole plain{458.654,    457.296,        367.215,
                         248.375,    -0.28340811,    0.07395907,
                         0.00019359, 1.76187114e-05, distortion.limit() * distortion.limit()};

}  // namespace

[[gnu::noinline]] std::optional<Pixel> project_pinhole_by_hand(const Point& p) {
  const double u = plain.fx * (p.x() / p.z()) + plain.cx, v = plain.fy * (p.y() / p.z()) + plain.cy;
  if (!(p.z() > 0) || !std::isfinite(u + v) || !std::isfinite(p.z())) return std::nullopt;
  return Pixel(u, v);
}
[[gnu::noinline]] std::optional<Pixel> project_radtan_by_hand(const Point& p) {
  const double x = p.x() / p.z(), y = p.y() / p.z(), xx = x * x, yy = y * y, s = xx + yy, xy = 2 * x * y;
  const double g = 1 + s * (plain.k1 + s * plain.k2);
  const double u = plain.fx * (x * g + (plain.p1 * xy + plain.p2 * (s + 2 * xx))) + plain.cx;
  const double v = plain.fy * (y * g + (plain.p1 * (s + 2 * yy) + plain.p2 * xy)) + plain.cy;
  if (!(p.z() > 0) || !(s < plain.most_square) || !std::isfinite(u + v) || !std::isfinite(p.z())) return std::nullopt;
  return Pixel(u, v);
}

namespace {

benchmark::Pair pair(const std::string& name, auto library, auto by_hand) {
  return {each_point(name, [library](std::size_t i) { benchmark::keep(library(points()[i])); }),
          each_point(name + "_by_hand", [by_hand](std::size_t i) { benchmark::keep(by_hand(points()[i])); }), [=] {
            double largest = 0;
            for (const Point& p : points()) largest = std::max(largest, (*library(p) - *by_hand(p)).norm());
            return largest / (4e3 * std::numeric_limits<double>::epsilon());  // pixels are below 1000
          }};
}

const std::vector<benchmark::Pair>& pairs() {
  static const std::vector<benchmark::Pair> the{
      pair(
          "pinhole_none", [](const Point& p) { return pinhole.project(p); }, project_pinhole_by_hand),
      pair("pinhole_radtan", [](const Point& p) { return radtan.project(p); }, project_radtan_by_hand)};
  return the;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<benchmark::Kernel> kernels = benchmark::kernels_of(pairs());
  const Pinhole fisheye(190.97, 190.97, 254.93, 256.89, Equidistant(0.00348, 0.000715, -0.00205, 0.000203));
  add_model(kernels, "pinhole", pinhole);
  add_model(kernels, "radtan", radtan);
  add_model(kernels, "rational",
            Pinhole(603.2, 603.0, 640.5, 359.2, Rational(12.4, 7.1, -1e-4, 5e-5, 0.36, 12.7, 11.3, 1.95)));
  add_model(kernels, "fisheye", fisheye);
  add_model(kernels, "double_sphere", DoubleSphere(313.0, 313.0, 638.0, 514.0, -0.18, 0.59));
  add_model(kernels, "extended_unified", ExtendedUnified(460.0, 460.0, 320.0, 240.0, 0.57, 1.18));
  add_model(kernels, "unified", Unified(1.2, 750.0, 750.0, 320.0, 240.0, distortion));
  add_model(kernels, "field_of_view", FieldOfView(379.0, 379.0, 505.0, 509.0, 0.92));
  add_model(kernels, "equirectangular", Equirectangular(2048.0, 1024.0));
  const Sophus::SE3d T_BC(Sophus::SO3d::exp({0.1, -0.2, 0.3}), Point(0.05, 0.04, -0.03));
  const ImageSize size{640, 480};
  add_camera(kernels, "global", Camera(radtan, size, T_BC));
  add_camera(kernels, "rolling", Camera(radtan, size, T_BC, RollingShutter{30e-3 / 480}));
  benchmark::OverheadOptions overhead;
  return benchmark::run(argc, argv, "Costs of projections, rays and observations.", kernels,
                        {.options = [&](CLI::App& app) { overhead.add(app); },
                         .instead = [&] { return overhead.run(pairs(), "point"); }});
}
