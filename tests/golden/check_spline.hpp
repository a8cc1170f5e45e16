// SPDX-License-Identifier: MIT
/// What the tables of splines have in common. A table of group G is described by a Format:
///
///   template <typename Scalar> using Group        the group
///   static constexpr int numbers                  numbers of a control point
///   static G<Scalar> read(values, index)          control point `index` of a cell
///   static void compare(row, grader, motion, sizes)     a Motion<G, 3> with the row's outputs, or
///   static void compare_curve(row, grader, spline, t)   what else the spline gives at t
#pragma once

#include <array>
#include <chrono>
#include <splinertia/group/sophus.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>

#include "check_orders.hpp"
#include "golden_grade.hpp"

namespace golden {

/// x y z w, as they stand: not of exactly unit length, nor do they have to be.
template <typename Scalar>
[[nodiscard]] Sophus::SO3<Scalar> read_rotation(const std::vector<Scalar>& values, std::size_t begin) {
  return splinertia::rotation_from_unit_quaternion<Scalar>(
      Eigen::Quaternion<Scalar>(values.at(begin + 3), values.at(begin), values.at(begin + 1), values.at(begin + 2)));
}

/// The same, of unit length to the precision of Scalar, for groups that turn vectors by it. Only long double sees that
/// the doubles are not: normalising there is a rounding of the input by one eps.
template <typename Scalar>
[[nodiscard]] Sophus::SO3<Scalar> read_unit_rotation(const std::vector<Scalar>& values, std::size_t begin) {
  Sophus::SO3<Scalar> R = read_rotation<Scalar>(values, begin);
  if (std::numeric_limits<Scalar>::digits <= std::numeric_limits<double>::digits) return R;
  return splinertia::rotation_from_unit_quaternion<Scalar>(R.unit_quaternion().normalized());
}

template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> read_vector(const std::vector<Scalar>& values, std::size_t begin) {
  return {values.at(begin), values.at(begin + 1), values.at(begin + 2)};
}

/// A quaternion for comparison. The inputs are doubles of length 1 ± 1e-16, which is far from 1 in long double: the
/// truth is that of the rotation, so the length is taken out.
template <typename Scalar>
[[nodiscard]] Numbers rotation_numbers(const Sophus::SO3<Scalar>& R, const Numbers& gold) {
  const Eigen::Matrix<long double, 4, 1> q = R.unit_quaternion().coeffs().template cast<long double>();
  return signed_like(gold, flat(q.normalized()));
}

/// Natural magnitudes, of the increments d_j, for what the tables give none: Σ_j |d^mλ_j/dt^m| |d_j| of the three
/// components from `begin` on, m = 0 … 3.
template <typename Scalar, int Order>
[[nodiscard]] std::array<long double, 4> natural_sizes(const splinertia::CumulativeBasis<Scalar, Order, 3>& basis,
                                                       const auto& d, int begin) {
  std::array<long double, 4> sizes{};
  for (std::size_t m = 0; m < 4; ++m) {
    for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(Order); ++j) {
      sizes[m] += std::abs(static_cast<long double>(basis.lambda[m][j])) *
                  static_cast<long double>(d(j).template segment<3>(begin).stableNorm());
    }
  }
  return sizes;
}

/// The classes that README.md excuses from float: increments that round across π, or that underflow or vanish beside
/// the control point that they are added to.
[[nodiscard]] inline bool excused_from_float(const std::string& label) {
  for (const char* part : {"pi-1e-8", "e-300", "e-160", "mixed"}) {
    if (label.find(part) != std::string::npos) return true;
  }
  return false;
}

template <typename Format, typename Scalar, int Order, splinertia::Knots K>
void check_spline(const Row& row, Grader<Scalar>& grader, K knots, typename K::Time t) {
  using G = typename Format::template Group<Scalar>;
  const auto values = row.inputs<Scalar>("ctrl");
  std::vector<G> control_points;
  for (std::size_t i = 0; i < static_cast<std::size_t>(row.integer("n")); ++i) {
    control_points.push_back(Format::template read<Scalar>(values, i * Format::numbers));
  }
  const splinertia::Spline<G, Order, K> spline(std::move(knots), std::move(control_points));
  if (!(t >= spline.start() && t <= spline.end())) return grader.fail("t is in the domain, but not of the spline");
  if constexpr (requires { Format::compare_curve(row, grader, spline, t); }) {
    Format::compare_curve(row, grader, spline, t);
  } else {
    const auto place = spline.knots().template basis<Scalar, Order, 3>(t, spline.control_points().size());
    const auto d = [&](std::size_t j) { return spline.increments()[place.first + j]; };
    Format::compare(row, grader, spline.template at<3>(t),
                    Format::sizes(spline.control_points()[place.first], place.basis, d));
  }
}

template <typename Format, typename Scalar>
void check_spline_row(const Row& row, Report& report) {
  for_order(row, report, [&]<int Order>() {
    Grader<Scalar> grader(report, row);
    if (std::is_same_v<Scalar, float> && excused_from_float(row.text("class"))) return grader.skip();
    const std::string& mode = row.text("mode");
    if (mode == "ns") {
      using std::chrono::nanoseconds;
      const splinertia::UniformKnots knots{nanoseconds(row.integer64("t0")), nanoseconds(row.integer64("dt"))};
      check_spline<Format, Scalar, Order>(row, grader, knots, nanoseconds(row.integer64("t")));
    } else if (mode == "sec") {
      const splinertia::UniformKnots knots{row.input<double>("t0"), row.input<double>("dt")};
      check_spline<Format, Scalar, Order>(row, grader, knots, row.input<double>("t"));
    } else if (mode == "knots") {
      const splinertia::NonUniformKnots<double> knots{row.inputs<double>("dt")};
      check_spline<Format, Scalar, Order>(row, grader, knots, row.input<double>("t"));
    } else {
      grader.fail("mode " + mode + " is not known");
    }
  });
}

/// Splines given by their first control point and exact increments. The table has no condition, so that rows whose
/// inputs are not floats cannot be judged in float.
template <typename Format, typename Scalar>
void check_increments_row(const Row& row, Report& report) {
  for_order(row, report, [&]<int Order>() {
    Grader<Scalar> grader(report, row);
    if (grader.grade() == Grade::B) return grader.skip();
    using G = typename Format::template Group<Scalar>;
    using Tangent = splinertia::Tangent<G>;
    const G start = Format::template read<Scalar>(row.inputs<Scalar>(Format::first_column), 0);
    const auto increments = row.inputs<Scalar>("incs");
    const auto d = [&](std::size_t j) {
      return Tangent(
          Eigen::Map<const Tangent>(increments.data() + j * static_cast<std::size_t>(Tangent::RowsAtCompileTime)));
    };
    if (increments.size() != static_cast<std::size_t>((Order - 1) * Tangent::RowsAtCompileTime)) {
      throw std::runtime_error(row.table().name() + ", row " + row.text("id") + ": not Order - 1 increments");
    }
    const auto basis = splinertia::uniform_basis<Order, 3>(row.input<Scalar>("u"), row.input<Scalar>("dt"));
    Format::compare(row, grader, splinertia::detail::evaluate_increments<3>(start, d, basis),
                    Format::sizes(start, basis, d));
  });
}

template <typename Format>
void check_splines(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_spline_row<Format, Scalar>(row, report); });
}

template <typename Format>
void check_increments(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_increments_row<Format, Scalar>(row, report); });
  report.note(table.name(), "rows with f32 = 0 skipped in float: the table has no condition for grade B");
}

/// Numbers of a cell by index; 0 (NaN for a condition) where the table has no such column.
[[nodiscard]] inline long double cell(const Row& row, std::string_view column, std::size_t index) {
  if (!row.has(column)) return std::numeric_limits<long double>::quiet_NaN();
  return row.outputs(column).at(index);
}

}  // namespace golden
