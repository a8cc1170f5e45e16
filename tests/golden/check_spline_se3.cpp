// SPDX-License-Identifier: MIT
/// Tables of splines on SE(3): se3_spline, se3_spline_inc.
#include <splinertia/motion/kinematics.hpp>

#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

struct RigidPoses {
  template <typename Scalar>
  using Group = Sophus::SE3<Scalar>;
  static constexpr std::size_t numbers = 7;
  static constexpr const char* first_column = "pose0";

  template <typename Scalar>
  [[nodiscard]] static Sophus::SE3<Scalar> read(const std::vector<Scalar>& values, std::size_t begin) {
    Sophus::SE3<Scalar> T;
    T.so3() = read_unit_rotation<Scalar>(values, begin + 3);
    T.translation() = read_vector<Scalar>(values, begin);
    return T;
  }
  /// The natural size of the position, which has no scale in the table: the first control point and the increments.
  [[nodiscard]] static long double sizes(const auto& first, const auto& basis, const auto& d) {
    return natural_sizes(basis, d, 0)[0] + static_cast<long double>(first.translation().stableNorm());
  }

  template <typename Scalar>
  static void compare(const Row& row, Grader<Scalar>& grader, const splinertia::Motion<Sophus::SE3<Scalar>, 3>& m,
                      long double position_size) {
    const auto pose = row.outputs("pose");
    const auto q = part(pose, 3, 4);
    grader.check("position", flat(m.value.translation()), part(pose, 0, 3), {position_size, cell(row, "cond", 0)});
    grader.check("rotation", rotation_numbers(m.value.so3(), q), q, {1, cell(row, "cond", 1)});
    const auto rate = [&](const char* column, const auto& got, std::size_t derivative) {
      const auto gold = row.outputs(column);
      grader.check(std::string(column) + ", translation", flat(got.template head<3>()), part(gold, 0, 3),
                   {cell(row, "scale", derivative - 1), cell(row, "cond", 2 * derivative)});
      grader.check(std::string(column) + ", rotation", flat(got.template tail<3>()), part(gold, 3, 3),
                   {cell(row, "scale", derivative + 2), cell(row, "cond", 2 * derivative + 1)});
    };
    rate("V", m.velocity, 1);
    rate("A", m.acceleration, 2);
    rate("J", m.jerk, 3);

    // In the world: ṗ = R V, p̈ = R(A + ω × V), of the sizes of their terms. Turning by R, rounded like a control
    // point's rotation, costs their length.
    if (!row.has("pdot")) return;
    const auto V = row.outputs("V");
    const auto length = [](const Numbers& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); };
    const long double omega = length(part(V, 3, 3)), speed = length(part(V, 0, 3));
    const auto term = [&](const char* column, std::size_t i) { return cell(row, column, i); };
    const auto world = [&](const auto& body) {
      return flat(splinertia::detail::rotate<Scalar>(m.value.unit_quaternion(), body));
    };
    grader.check("pdot", world(Eigen::Vector3<Scalar>(m.velocity.template head<3>())), row.outputs("pdot"),
                 {term("scale", 0) + 2 * speed, term("cond", 2) + 2 * speed});
    const long double turning = omega * term("scale", 0) + term("scale", 3) * speed;
    const long double rounding = omega * term("cond", 2) + term("cond", 3) * speed;
    const long double turned = 2 * length(row.outputs("pddot"));
    grader.check("pddot", world(splinertia::specific_force(m, Eigen::Vector3<Scalar>(0, 0, 0))), row.outputs("pddot"),
                 {term("scale", 1) + turning + turned, term("cond", 4) + rounding + turned});
  }
};

}  // namespace

void check_se3_spline(const Table& table, Report& report) { check_splines<RigidPoses>(table, report); }

void check_se3_spline_inc(const Table& table, Report& report) { check_increments<RigidPoses>(table, report); }

}  // namespace golden
