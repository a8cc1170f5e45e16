// SPDX-License-Identifier: MIT
// The numbers of the picture of docs/cameras.md, which camera_models_plot.py draws: lines of equal angle and of equal
// direction in the images of all models. With --steps: how many Newton steps the inverses take. With --round-trip: how far
// a pixel is from the projection of its ray.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>
#include <splinertia/detail/pi.hpp>
#include <string>
#include <type_traits>
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

/// The largest |project(unproject(pixel)) − pixel| of random pixels up to a radius of `most` focal lengths from the
/// centre, or to the end of the domain, in eps of the focal length.
template <CameraModel Model>
double round_trip(const Model& model, double most) {
  using Scalar = typename Model::Scalar;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double r = most * std::sqrt(uniform(random)), azimuth = 360 * degree * uniform(random);
    const Eigen::Vector2<Scalar> pixel(model.cx() + static_cast<Scalar>(r * std::cos(azimuth)) * model.fx(),
                                       model.cy() + static_cast<Scalar>(r * std::sin(azimuth)) * model.fy());
    const auto ray = model.unproject(pixel);
    const auto again = ray ? model.project(*ray) : std::nullopt;
    if (again) worst = std::max(worst, static_cast<double>((*again - pixel).norm() / model.fx()));
  }
  return worst / static_cast<double>(std::numeric_limits<Scalar>::epsilon());
}

void print_round_trips() {
  std::puts("largest error of 10^6 pixels [eps f]  to f: float   double     to 2 f: float   double");
  const auto print = [](const auto& single, const auto& model) {
    std::printf("%-36s %9.2f %8.2f %14.2f %8.2f\n", std::remove_cvref_t<decltype(model)>::name, round_trip(single, 1),
                round_trip(model, 1), round_trip(single, 2), round_trip(model, 2));
  };
  const auto each = [&](const auto& make) { print(make(0.0F), make(0.0)); };
  each([](auto zero) {
    using S = decltype(zero);
    return Pinhole<NoDistortion<S>>(460, 460, 320, 240, {});
  });
  each([](auto zero) {
    using S = decltype(zero);
    return Pinhole(S(458), S(457), S(367), S(248), RadialTangential(S(-0.283), S(0.074), S(2e-4), S(2e-5)));
  });
  each([](auto zero) {
    using S = decltype(zero);
    return Pinhole(S(603), S(603), S(640), S(359),
                   Rational(S(12.4), S(7.1), S(-1e-4), S(5e-5), S(0.36), S(12.7), S(11.3), S(1.95)));
  });
  each([](auto zero) {
    using S = decltype(zero);
    return Pinhole(S(191), S(191), S(255), S(257), Equidistant(S(3.5e-3), S(7e-4), S(-2e-3), S(2e-4)));
  });
  each([](auto zero) {
    using S = decltype(zero);
    return Unified(S(1.2), S(750), S(750), S(320), S(240), RadialTangential(S(-0.2), S(0.05), S(1e-4), S(1e-4)));
  });
  each([](auto zero) {
    using S = decltype(zero);
    return DoubleSphere<S>(158, 158, 254, 256, S(-0.172), S(0.593));
  });
  each([](auto zero) {
    using S = decltype(zero);
    return ExtendedUnified<S>(191, 191, 256, 256, S(0.63), S(1.04));
  });
  each([](auto zero) {
    using S = decltype(zero);
    return FieldOfView<S>(190, 190, 256, 256, S(0.93));
  });
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
  bool steps = false, round_trips = false;
  app.add_flag("--steps", steps, "print how many Newton steps inverses take");
  app.add_flag("--round-trip", round_trips, "print how far pixels are from the projections of their rays");
  CLI11_PARSE(app, argc, argv);
  if (steps) print_steps();
  if (round_trips) print_round_trips();
  if (!steps && !round_trips) print_picture();
}
