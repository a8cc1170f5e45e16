// SPDX-License-Identifier: MIT
/// Tables of splines on SO(3): so3_spline, so3_spline_inc.
#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

struct Rotations {
  template <typename Scalar>
  using Group = Sophus::SO3<Scalar>;
  static constexpr std::size_t numbers = 4;
  static constexpr const char* first_column = "q0";

  template <typename Scalar>
  [[nodiscard]] static Sophus::SO3<Scalar> read(const std::vector<Scalar>& values, std::size_t begin) {
    return read_rotation<Scalar>(values, begin);
  }
  [[nodiscard]] static int sizes(const auto&, const auto&, const auto&) { return 0; }  // all are in the table

  template <typename Scalar>
  static void compare(const Row& row, Grader<Scalar>& grader, const splinertia::Motion<Sophus::SO3<Scalar>, 3>& m,
                      int) {
    const auto q = row.outputs("q");
    grader.check("q", rotation_numbers(m.value, q), q, {1, cell(row, "cond", 0)});  // of unit size
    grader.check("omega", flat(m.velocity), row.outputs("omega"), {cell(row, "scale", 0), cell(row, "cond", 1)});
    grader.check("alpha", flat(m.acceleration), row.outputs("alpha"), {cell(row, "scale", 1), cell(row, "cond", 2)});
    grader.check("jerk", flat(m.jerk), row.outputs("jerk"), {cell(row, "scale", 2), cell(row, "cond", 3)});
  }
};

}  // namespace

void check_so3_spline(const Table& table, Report& report) { check_splines<Rotations>(table, report); }
void check_so3_spline_inc(const Table& table, Report& report) { check_increments<Rotations>(table, report); }

}  // namespace golden
