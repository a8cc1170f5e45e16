// SPDX-License-Identifier: MIT
// Projects points and unprojects pixels for compare_opencv.py and compare_colmap.py. Each line of the standard input is
//   MODEL project   PARAMETERS... X Y Z
//   MODEL unproject PARAMETERS... U V
// and gives one line: the pixel; or the ray and the largest singular value of its derivative, 1/pixel; or "nothing".
#include <Eigen/SVD>
#include <cstdio>
#include <iostream>
#include <map>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace splinertia;

namespace {

template <typename Vector>
Vector read(std::istream& in) {
  Vector v;
  for (int i = 0; i < static_cast<int>(v.size()); ++i) {
    if (std::string word; in >> word) {
      v[i] = std::stod(word);
    } else {
      throw std::runtime_error("expected a number");
    }
  }
  return v;
}

void print(const auto& numbers) {
  for (const double number : numbers) std::printf("%.17g ", number);
}

template <CameraModel Model>
void answer(const std::string& what, std::istream& in) {
  const Model model = Model::from_parameters(read<Eigen::Matrix<double, Model::parameter_count, 1>>(in));
  if (what == "project") {
    const auto pixel = model.project(read<Eigen::Vector3d>(in));
    if (pixel) {
      print(*pixel);
    } else {
      std::printf("nothing");
    }
  } else if (what == "unproject") {
    const auto ray = model.linearize_ray(read<Eigen::Vector2d>(in));
    if (ray) {
      print(ray->direction);
      std::printf("%.3g", ray->pixel_jacobian.jacobiSvd().singularValues()[0]);
    } else {
      std::printf("nothing");
    }
  } else {
    throw std::runtime_error(what + ": expected project or unproject");
  }
  std::printf("\n");
}

using Answer = void (*)(const std::string&, std::istream&);

template <CameraModel... Models>
std::map<std::string, Answer> by_name() {
  return {{Models::name, answer<Models>}...};
}

const std::map<std::string, Answer> models =
    by_name<Pinhole<NoDistortion<double>>, Pinhole<RadialTangential<double>>, Pinhole<Rational<double>>,
            Pinhole<Equidistant<double>>, FieldOfView<double>, Unified<RadialTangential<double>>, DoubleSphere<double>,
            ExtendedUnified<double>>();

}  // namespace

int main() try {
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream in(line);
    std::string model, what;
    in >> model >> what;
    models.at(model)(what, in);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "camera_rows: %s\n", error.what());
  return 1;
}
