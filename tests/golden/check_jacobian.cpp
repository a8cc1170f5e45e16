// SPDX-License-Identifier: MIT
/// Tables of Jacobians with respect to control points: jac_so3, jac_se3. An error is judged relative to the largest
/// entry of the Jacobian, in all scalars: the tables have neither scale nor condition.
///
/// Those for perturbations on the left follow from those on the right: exp(δ) X_i = X_i exp(Ad_{X_i⁻¹} δ), and the
/// value's own perturbation is seen from the left through Ad_X.
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/linearize.hpp>

#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

using namespace splinertia::detail;

namespace {

using splinertia::GroupTraits;
using splinertia::Jacobian;
using splinertia::Tangent;

template <typename G>
[[nodiscard]] Jacobian<G> adjoint_matrix(const G& x) {
  Jacobian<G> m;
  for (int i = 0; i < splinertia::DofOf<G>; ++i) m.col(i) = GroupTraits<G>::adjoint(x, Tangent<G>::Unit(i));
  return m;
}

template <typename Pose>
struct Jacobians : Pose {
  template <typename Scalar, typename Spline, typename Time>
  static void compare_curve(const Row& row, Grader<Scalar>& grader, const Spline& spline, Time t) {
    using G = typename Spline::Group;
    constexpr std::size_t order = Spline::order;
    const auto place = spline.knots().template basis<Scalar, Spline::order, 2>(t, spline.control_points().size());
    const std::span<const G, order> points(spline.control_points().data() + place.first, order);
    const auto linear = splinertia::linearize<2>(points, place.basis);
    const bool left = row.text("side") == "left";
    const auto check = [&](const char* column,
                           const splinertia::detail::ControlPointJacobians<G, Spline::order>& jacobians,
                           const Jacobian<G>& seen) {
      Numbers got;
      long double converted = 0;  // sizes that conversion to the left adds up before they cancel
      for (std::size_t i = 0; i < order; ++i) {
        Jacobian<G> J = jacobians[i];
        if (left) {
          const Jacobian<G> back = adjoint_matrix(GroupTraits<G>::inverse(points[i]));
          converted = std::max(converted, magnitude(flat(seen.cwiseAbs() * J.cwiseAbs() * back.cwiseAbs())));
          J = seen * J * back;
        }
        const Numbers entries = flat(J);
        got.insert(got.end(), entries.begin(), entries.end());
      }
      const Numbers gold = row.outputs(column);
      grader.check(column, got, gold, {converted, converted, jacobian_limit});
    };
    const Jacobian<G> identity = Jacobian<G>::Identity();
    check("Jval", linear.value_jacobian, left ? adjoint_matrix(linear.value) : identity);
    check("Jvel", linear.velocity_jacobian, identity);
    check("Jacc", linear.acceleration_jacobian, identity);
  }
};

struct Rotation {
  template <typename Scalar>
  using Group = Sophus::SO3<Scalar>;
  static constexpr std::size_t numbers = 4;

  template <typename Scalar>
  [[nodiscard]] static Group<Scalar> read(const std::vector<Scalar>& values, std::size_t begin) {
    return read_unit_rotation<Scalar>(values, begin);
  }
};

struct RigidMotion {
  template <typename Scalar>
  using Group = Sophus::SE3<Scalar>;
  static constexpr std::size_t numbers = 7;

  template <typename Scalar>
  [[nodiscard]] static Group<Scalar> read(const std::vector<Scalar>& values, std::size_t begin) {
    return splinertia::make_pose<Group<Scalar>>(read_unit_rotation<Scalar>(values, begin + 3),
                                                read_vector<Scalar>(values, begin));
  }
};

}  // namespace

void check_jac_so3(const Table& table, Report& report) {
  check_splines<Jacobians<Rotation>>(table, report);
  report.note(table.name(), "column Jjerk not checked: the library does not offer it");
}

void check_jac_se3(const Table& table, Report& report) {
  check_splines<Jacobians<RigidMotion>>(table, report);
  report.note(table.name(), "column Jjerk not checked: the library does not offer it");
}

}  // namespace golden
