// SPDX-License-Identifier: MIT
// The numbers of the picture of docs/cameras.md, which camera_models_plot.py draws: lines of equal angle and of equal
// direction in the images of all models. With --steps: how many Newton steps the inverses take.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>
#include <splinertia/detail/pi.hpp>
#include <string>
#include <utility>

using namespace splinertia;

namespace {

constexpr double degree = detail::pi_of<double>() / 180;

Eigen::Vector3d direction(double angle, double azimuth) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

/// One line of the picture, broken where there is nothing.
void print_line(const std::string& panel, const char* kind, double value, const auto& model, const auto& point_at) {
  for (int i = 0; i <= 180; ++i) {
    const auto pixel = model.project(point_at(i / 180.0));
    std::printf("%s,%s,%.4g,%.3f,%.3f\n", panel.c_str(), kind, value, pixel ? pixel->x() : NAN,
                pixel ? pixel->y() : NAN);
  }
}

template <CameraModel Model>
void print_grid(const Model& model) {
  const std::string name = Model::name;
  double end = 180 * degree;
  if constexpr (requires { model.largest_angle(); }) end = std::min(end, model.largest_angle());
  for (int angle = 15; angle < 180; angle += 15) {
    if (angle * degree >= end) break;
    print_line(name, "circle", angle, model,
               [&](double s) { return direction(angle * degree, (360 * s + 1e-6) * degree); });
  }
  for (int azimuth = 0; azimuth < 360; azimuth += 30) {
    print_line(name, "meridian", azimuth, model, [&](double s) { return direction(end * s, azimuth * degree); });
  }
  std::printf("%s,end,%.1f,nan,nan\n", name.c_str(), end / degree);
  const auto inside = [&](double s) { return direction(end * (1 - 1e-9), 360 * s * degree); };
  print_line(name, "border", 0, model, inside);
}

/// The radius in the image against the angle, for a fisheye whose coefficients fold it.
void print_fold() {
  const double k1 = 0.02, k2 = -0.06;
  const Equidistant fisheye(k1, k2, 0.0, 0.0);
  for (int i = 0; i <= 220; ++i) {
    const double angle = 0.5 * i * degree, s = angle * angle;
    const double radius = 300 * angle * (1 + s * (k1 + s * k2));
    std::printf("fold,%s,0,%.3f,%.3f\n", angle < fisheye.largest_angle() ? "inside" : "outside", angle / degree,
                radius);
  }
}

struct Steps {
  int total = 0, most = 0;
  double rays = 0;

  void add(int steps) {
    total += steps;
    most = std::max(most, steps);
    rays += 1;
  }
  void print(const char* name, const char* where) const {
    std::printf("%-16s %-28s mean %.2f, most %d\n", name, where, total / rays, most);
  }
};

/// A distortion that counts how often it is differentiated in two dimensions.
template <typename Distortion>
struct Counting {
  const Distortion& distortion;
  int* calls;

  template <Wrt wrt, typename T>
  auto distort(const T& x, const T& y) const {
    ++*calls;
    return distortion.template distort<wrt, T>(x, y);
  }
};

constexpr std::pair<double, double> ranges[] = {{0, 0.9}, {0.9, 0.999}, {0.999, 0.999999}};

/// Inverts points at shares of the radius at which the domain of the random lens ends, or of 2 where it does not.
template <typename Distortion>
void count_brown(const char* name, const auto& random_lens) {
  for (const auto& [low, high] : ranges) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    Steps radial, plane;
    for (int i = 0; i < 100000; ++i) {
      const Distortion lens = random_lens([&](double a, double b) { return a + (b - a) * uniform(random); });
      const double r = std::min(2.0, lens.limit()) * (low + (high - low) * uniform(random));
      const double azimuth = 360 * degree * uniform(random);
      int radial_calls = 0, plane_calls = 0;
      auto p = lens.parameters().eval();
      p[2] = p[3] = 0;
      const auto without = Distortion::from(p);
      const auto evaluate = [&](double x, double& slope) {
        ++radial_calls;
        const auto d = without.template distort<Wrt::point, double>(x, 0.0);
        slope = d.by_point(0, 0);
        return d.x;
      };
      const auto d = lens.template distort<Wrt::nothing, double>(r * std::cos(azimuth), r * std::sin(azimuth));
      double unused;
      const double end = lens.limit() < 1e100 ? evaluate(lens.limit(), unused) : 1e300;
      radial_calls = 0;
      const auto found = detail::undistort_brown<double>(Counting<Distortion>{lens, &plane_calls}, evaluate, d.x, d.y,
                                                         lens.limit(), end, true);
      if (!found) continue;
      radial.add(radial_calls);
      plane.add(plane_calls);
    }
    char where[64];
    std::snprintf(where, sizeof where, "radius %g to %g", low, high);
    radial.print(name, where);
    plane.print("", "  and in two dimensions");
  }
}

void count_equidistant(const char* name, double spread) {
  for (const auto& [low, high] : ranges) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> large(-4 * spread, 4 * spread), small(-spread, spread), uniform(0, 1);
    Steps steps;
    for (int i = 0; i < 100000; ++i) {
      const double k1 = 0.0034823 + large(random), k2 = 0.000715 + large(random);
      const double k3 = -0.0020532 + small(random), k4 = 0.0002029 + small(random);
      const Equidistant lens(k1, k2, k3, k4);
      const double limit = lens.largest_angle();
      int calls = 0;
      const auto evaluate = [&](double x, double& slope) {
        ++calls;
        const double s = x * x;
        slope = 1 + s * (3 * k1 + s * (5 * k2 + s * (7 * k3 + s * 9 * k4)));
        return x * (1 + s * (k1 + s * (k2 + s * (k3 + s * k4))));
      };
      double unused;
      const double r = evaluate(limit * (low + (high - low) * uniform(random)), unused);
      calls = 0;
      (void)detail::increasing_inverse<double>(evaluate, r, 0, limit, r < limit ? r : limit / 2);
      steps.add(calls);
    }
    char where[64];
    std::snprintf(where, sizeof where, "angle %g to %g", low, high);
    steps.print(name, where);
  }
}

void print_steps() {
  std::puts("EuRoC's left camera and a camera of TUM-VI");
  count_brown<RadialTangential<double>>("pinhole-radtan", [](const auto&) {
    return RadialTangential(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05);
  });
  count_equidistant("pinhole-equi", 0);
  std::puts("100,000 random lenses");
  count_brown<RadialTangential<double>>("pinhole-radtan", [](const auto& in) {
    const double k1 = in(-0.4, 0.2), k2 = in(-0.1, 0.15), p1 = in(-2e-3, 2e-3), p2 = in(-2e-3, 2e-3);
    return RadialTangential(k1, k2, p1, p2);
  });
  count_brown<Rational<double>>("pinhole-radtan8", [](const auto& in) {
    const double k1 = in(-0.4, 0.2), k2 = in(-0.1, 0.15), p1 = in(-2e-3, 2e-3), p2 = in(-2e-3, 2e-3);
    const double k3 = in(-0.03, 0.03), k4 = in(-0.1, 0.3), k5 = in(-0.02, 0.05), k6 = in(-0.02, 0.05);
    return Rational(k1, k2, p1, p2, k3, k4, k5, k6);
  });
  count_equidistant("pinhole-equi", 0.02);
}

void print_picture() {
  std::puts("panel,kind,value,u,v");
  const double cx = 256, cy = 256;
  print_grid(Pinhole(190.0, 190.0, cx, cy, NoDistortion<double>{}));
  print_grid(Pinhole(300.0, 300.0, cx, cy, RadialTangential(-0.29, 0.0, 4e-3, -4e-3)));
  print_grid(Pinhole(190.0, 190.0, cx, cy, Rational(0.7778, 0.0677, 0.0, 0.0, 0.0, 1.1111, 0.2381, 0.0)));
  print_grid(Pinhole(190.98, 190.97, cx, cy, Equidistant(0.0034823, 0.0007150, -0.0020532, 0.0002029)));
  print_grid(FieldOfView(190.0, 190.0, cx, cy, 0.93));
  print_grid(Unified(1.0, 420.0, 420.0, cx, cy, RadialTangential(-0.2, 0.05, 1e-4, 1e-4)));
  print_grid(DoubleSphere(158.28, 158.27, cx, cy, -0.172, 0.593));
  print_grid(ExtendedUnified(191.0, 191.0, cx, cy, 0.63, 1.04));
  print_grid(Equirectangular(512.0, 256.0));
  print_fold();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Lines of equal angle in the images of all camera models, as CSV."};
  bool steps = false;
  app.add_flag("--steps", steps, "print how many Newton steps inverses take");
  CLI11_PARSE(app, argc, argv);
  steps ? print_steps() : print_picture();
}
