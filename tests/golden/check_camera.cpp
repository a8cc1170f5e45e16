// SPDX-License-Identifier: MIT
/// Tables of camera models: camera_project, camera_unproject. An error is judged by e ≤ C eps scale, where the table's
/// scale contains |gold|. The limit of C is 4 for pixels and rays, 16 for Jacobians.
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>

#include "golden_checks.hpp"

namespace golden {

namespace {

using namespace splinertia;

constexpr double camera_jacobian_limit = 16;

template <typename... Models>
struct ModelList {};

template <typename Scalar>
using AllModels = ModelList<Pinhole<NoDistortion<Scalar>>, Pinhole<RadialTangential<Scalar>>, Pinhole<Rational<Scalar>>,
                            Pinhole<Equidistant<Scalar>>, Unified<NoDistortion<Scalar>>,
                            Unified<RadialTangential<Scalar>>, Unified<Rational<Scalar>>, DoubleSphere<Scalar>,
                            ExtendedUnified<Scalar>, FieldOfView<Scalar>, Equirectangular<Scalar>>;

/// Calls work(model) with the row's model. Returns false if there is none of that name.
template <typename... Models>
[[nodiscard]] bool with_model(const Row& row, ModelList<Models...>, const auto& work) {
  const auto matches = [&]<typename Model>(const Model*) {
    if (row.text("model") != Model::name) return false;
    work(Model::from_parameters(input_vector<typename Model::Scalar, Model::parameter_count>(row, "params")));
    return true;
  };
  return (matches(static_cast<const Models*>(nullptr)) || ...);
}

/// Rows for float have inputs that are floats, and none whose square underflows.
template <typename Scalar>
[[nodiscard]] bool is_for(const Row& row, const char* input) {
  if constexpr (std::is_same_v<Scalar, float>) {
    const std::string& label = row.text("class");
    if (!row.flag("f32") || label == "edge" || label.starts_with("scaled")) return false;
    for (const double x : row.inputs<double>(input)) {
      if (x != 0 && std::abs(x) < 1e-30) return false;
    }
  }
  return true;
}

[[nodiscard]] Measure measure(const Numbers& scale, std::size_t index, const Numbers& gold, double limit) {
  constexpr long double none = std::numeric_limits<long double>::quiet_NaN();  // grade A only
  return {.scale = scale.at(index) - magnitude(gold), .cond = none, .limit = limit};
}

template <typename Scalar>
void check_projection(const Row& row, Grader<Scalar>& grader, const auto& model) {
  const auto p = model.template linearize<Wrt::point | Wrt::parameters>(input_vector<Scalar, 3>(row, "point"));
  const auto value = model.project(input_vector<Scalar, 3>(row, "point"));
  if (p.has_value() != row.flag("valid") || value.has_value() != row.flag("valid")) return grader.fail("valid");
  if (!p) return;
  const Numbers scale = row.outputs("scale"), pixel = row.outputs("pixel"), by_point = row.outputs("J_point");
  grader.check("pixel", flat(p->pixel), pixel, measure(scale, 0, pixel, value_limit));
  grader.check("pixel, value only", flat(*value), pixel, measure(scale, 0, pixel, value_limit));
  grader.check("J_point", flat(p->point_jacobian), by_point, measure(scale, 1, by_point, camera_jacobian_limit));
  const Numbers by_parameters = row.outputs("J_params");
  const auto count = static_cast<std::size_t>(p->parameter_jacobian.cols());
  for (std::size_t i = 0; i < count; ++i) {
    const Numbers gold{by_parameters.at(i), by_parameters.at(count + i)};
    grader.check("J_params, column " + std::to_string(i), flat(p->parameter_jacobian.col(static_cast<Eigen::Index>(i))),
                 gold, measure(scale, 2 + i, gold, camera_jacobian_limit));
  }
}

/// Whether tangential terms are larger than the radial ones. There they fold the image, and up to four rays of the
/// domain have the same pixel.
[[nodiscard]] bool is_folded(const Row& row, const Numbers& ray) {
  const bool unified = row.text("model") == "omni-radtan";
  if (!unified && !row.text("model").starts_with("pinhole-radtan")) return false;
  const auto p = row.inputs<long double>("params"), pixel = row.inputs<long double>("pixel");
  const std::size_t at = unified ? 1 : 0;
  const long double depth = ray.at(2) + (unified ? p.at(0) : 0), x = ray.at(0) / depth, y = ray.at(1) / depth;
  const long double s = x * x + y * y, p1 = p.at(at + 6), p2 = p.at(at + 7);
  const long double tx = 2 * p1 * x * y + p2 * (s + 2 * x * x), ty = p1 * (s + 2 * y * y) + 2 * p2 * x * y;
  const long double u = (pixel.at(0) - p.at(at + 2)) / p.at(at), v = (pixel.at(1) - p.at(at + 3)) / p.at(at + 1);
  return std::hypot(tx, ty) > std::hypot(u - tx, v - ty);
}

template <typename Scalar>
void check_ray(const Row& row, Grader<Scalar>& grader, const auto& model) {
  const auto ray = model.linearize_ray(input_vector<Scalar, 2>(row, "pixel"));
  if (ray.has_value() != row.flag("valid")) return grader.fail("valid");
  if (!ray) return;
  const Numbers scale = row.outputs("scale"), direction = row.outputs("ray"), by_pixel = row.outputs("J_pixel");
  if (is_folded(row, direction)) return grader.skip();
  grader.check("ray", flat(ray->direction), direction, measure(scale, 0, direction, value_limit));
  grader.check("J_pixel", flat(ray->pixel_jacobian), by_pixel, measure(scale, 1, by_pixel, camera_jacobian_limit));
}

template <typename Scalar>
void check_row(const Row& row, Report& report, const char* input, const auto& check) {
  Grader<Scalar> grader(report, row);
  if (!is_for<Scalar>(row, input)) return grader.skip();
  const bool known = with_model(row, AllModels<Scalar>{}, [&](const auto& model) { check(row, grader, model); });
  if (!known) grader.fail("model " + row.text("model"));
}

}  // namespace

void check_camera_project(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) {
    check_row<Scalar>(row, report, "point", [](const Row& r, Grader<Scalar>& grader, const auto& model) {
      check_projection(r, grader, model);
    });
  });
}

void check_camera_unproject(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) {
    check_row<Scalar>(row, report, "pixel",
                      [](const Row& r, Grader<Scalar>& grader, const auto& model) { check_ray(r, grader, model); });
  });
  report.note(table.name(), "rows where tangential terms exceed the radial ones are checked for `valid` only");
}

}  // namespace golden
