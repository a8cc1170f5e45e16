// SPDX-License-Identifier: MIT
/// Table of splines on SO(3) × R³: so3r3_spline.
#include <splinertia/group/pose.hpp>

#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

struct SplitPoses {
  template <typename Scalar>
  using Group = splinertia::SO3xR3<Scalar>;
  static constexpr std::size_t numbers = 7;

  template <typename Scalar>
  [[nodiscard]] static Group<Scalar> read(const std::vector<Scalar>& values, std::size_t begin) {
    return {read_rotation<Scalar>(values, begin + 3), read_vector<Scalar>(values, begin)};
  }
  /// The table has scales of the rotation only. The position's natural size is that of the first control point and the
  /// increments.
  [[nodiscard]] static std::array<long double, 4> sizes(const auto& first, const auto& basis, const auto& d) {
    auto sizes = natural_sizes(basis, d, 3);
    sizes[0] += static_cast<long double>(splinertia::position(first).stableNorm());
    return sizes;
  }

  template <typename Scalar>
  static void compare(const Row& row, Grader<Scalar>& grader, const splinertia::Motion<Group<Scalar>, 3>& m,
                      const std::array<long double, 4>& sizes) {
    const auto position = [&](const char* column, const auto& got, std::size_t derivative) {
      grader.check(column, flat(got), row.outputs(column), {sizes[derivative], cell(row, "cond", derivative)});
    };
    position("p", splinertia::position(m.value), 0);
    position("v_world", m.velocity.template tail<3>(), 1);
    position("a_world", m.acceleration.template tail<3>(), 2);
    position("j_world", m.jerk.template tail<3>(), 3);

    const auto q = row.outputs("q");
    grader.check("q", rotation_numbers(splinertia::rotation(m.value), q), q, {1, cell(row, "cond", 4)});
    const auto rotation = [&](const char* column, const auto& got, std::size_t derivative) {
      grader.check(column, flat(got), row.outputs(column),
                   {cell(row, "scale", derivative - 1), cell(row, "cond", 4 + derivative)});
    };
    rotation("omega", m.velocity.template head<3>(), 1);
    rotation("alpha", m.acceleration.template head<3>(), 2);
    rotation("jerk", m.jerk.template head<3>(), 3);
  }
};

}  // namespace

void check_so3r3_spline(const Table& table, Report& report) { check_splines<SplitPoses>(table, report); }

}  // namespace golden
