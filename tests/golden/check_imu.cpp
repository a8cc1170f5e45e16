// SPDX-License-Identifier: MIT
/// Tables of inertial measurements: imu_truth (analytic motions), imu_spline (splines on both groups).
///
/// The tables have no scale: the size of a reading is the sum of its terms' sizes, before they cancel. Nor have they a
/// condition for float: inputs rounded by eps move rotations by eps and positions by eps |p|, which the basis passes
/// on.
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/motion/coning.hpp>
#include <splinertia/motion/ellipse.hpp>

#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

using namespace splinertia::detail;

namespace {

using Eigen::Vector3;
using splinertia::Motion;
using splinertia::SO3xR3;

/// Sizes of what an IMU adds up.
struct Sizes {
  long double velocity = 0, acceleration = 0;  // of the origin, m/s, m/s²
  long double omega = 0, alpha = 0;            // rad/s, rad/s²
  long double gravity = 0, lever = 0;          // m/s², m

  [[nodiscard]] long double force() const {
    return acceleration + omega * velocity + gravity + lever * (alpha + omega * omega);
  }
};

template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> vector(const Row& row, const char* column) {
  return input_vector<Scalar, 3>(row, column);
}

// ---- imu_truth

/// R = exp(ωt), p = p₀ + v₀t + at²/2, from the library's pieces.
template <typename Scalar>
struct ConstantRateAndAcceleration {
  Eigen::Vector3<Scalar> omega, a, v0, p0;

  template <int D>
  [[nodiscard]] Motion<SO3xR3<Scalar>, D> evaluate(Scalar t) const {
    splinertia::RigidBodyState<Scalar> s;
    s.q_WB = splinertia::detail::rotation_exp<Scalar>(omega * t);
    s.p_WB = p0 + t * v0 + t * t / 2 * a;
    s.omega = omega;
    s.v_WB = v0 + t * a;
    s.alpha.setZero();
    s.a_WB = a;
    return splinertia::split_motion<D>(s);
  }
};

/// `phase_rate`: angles are this rate times t and carry its rounding, so derivatives grow with its product with t.
template <typename Scalar>
void compare_truth(const Row& row, Grader<Scalar>& grader, const auto& motion, long double phase_rate) {
  const Scalar t = row.input<Scalar>("t");
  const auto m = motion.template evaluate<2>(t);
  const long double phase = 1 + phase_rate * std::abs(static_cast<long double>(t));
  const auto size = [](const Numbers& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); };
  const auto check = [&](const char* column, const Numbers& got, long double scale) {
    grader.check(column, got, row.outputs(column), {scale * phase, scale * phase});
  };
  const auto q = row.outputs("q"), p = row.outputs("p"), v = row.outputs("v"), a = row.outputs("a");
  const auto omega = row.outputs("omega"), alpha = row.outputs("alpha");
  const Eigen::Vector3<Scalar> gravity = vector<Scalar>(row, "g");
  const splinertia::Mounting<Scalar> arm{{}, vector<Scalar>(row, "lever")};
  Sizes sizes;
  // Harmonic motion: each derivative is as large as the rate times the one below, wherever the phase stands.
  sizes.velocity = size(v) + phase_rate * size(p);
  sizes.acceleration = size(a) + phase_rate * sizes.velocity;
  sizes.omega = size(omega) + phase_rate;
  sizes.alpha = size(alpha) + phase_rate * sizes.omega;
  sizes.gravity = static_cast<long double>(gravity.norm());
  sizes.lever = static_cast<long double>(arm.p_BI.norm());

  check("q", rotation_numbers(splinertia::rotation(m.value), q), 1);
  check("p", flat(splinertia::position(m.value)), 1 + size(p));
  check("v", flat(splinertia::world_velocity(m)), sizes.velocity);
  check("a", flat(m.acceleration.template tail<3>()), sizes.acceleration);
  check("omega", flat(splinertia::angular_velocity(m)), sizes.omega);
  check("alpha", flat(splinertia::angular_acceleration(m)), sizes.alpha);
  const auto imu = splinertia::ideal_imu(m, gravity, arm);
  check("gyro", flat(imu.gyro), sizes.omega);
  check("accel", flat(imu.accel), sizes.force());
}

template <typename Scalar>
void check_truth_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  const auto parameters = row.inputs<Scalar>("params");
  const auto rate = [&](std::size_t i) { return std::abs(static_cast<long double>(parameters.at(i))); };
  const std::string& model = row.text("model");
  if (model == "const") {
    const auto v = [&](std::size_t i) { return read_vector<Scalar>(parameters, i); };
    const ConstantRateAndAcceleration<Scalar> motion{v(0), v(3), v(6), v(9)};
    compare_truth(row, grader, motion, static_cast<long double>(motion.omega.norm()));
  } else if (model == "coning") {
    compare_truth(row, grader, splinertia::Coning<Scalar>{parameters.at(0), parameters.at(1)}, rate(1));
  } else if (model == "circle") {
    compare_truth(row, grader, splinertia::Circle<Scalar>{parameters.at(0), parameters.at(1), parameters.at(2)},
                  rate(1));
  } else if (model == "ellipse") {
    // The table took the amplitudes 0.1 and 0.2 as doubles; the library's are exact to the scalar.
    if (std::is_same_v<Scalar, long double>) return grader.skip();
    compare_truth(row, grader, splinertia::Ellipse<Scalar>{parameters.at(0)}, 10 * rate(0));
  } else {
    report.note(row.table().name(), "row " + row.text("id") + ": model " + model + " is not known, not checked");
  }
}

// ---- imu_spline

template <typename Scalar, int Order, typename G>
void compare_reading(const Row& row, Grader<Scalar>& grader,
                     const splinertia::Spline<G, Order, splinertia::UniformKnots<std::chrono::nanoseconds>>& spline) {
  using std::chrono::nanoseconds;
  const nanoseconds t(row.integer64("t"));
  const auto m = spline.template at<2>(t);
  const Eigen::Vector3<Scalar> gravity = vector<Scalar>(row, "g");
  const splinertia::Mounting<Scalar> arm{read_unit_rotation<Scalar>(row.inputs<Scalar>("q_bi"), 0),
                                         vector<Scalar>(row, "lever")};

  constexpr int rotation_begin = splinertia::SplitPose<G> ? 0 : 3;
  const auto place = spline.knots().template basis<Scalar, Order, 3>(t, spline.control_points().size());
  const auto d = [&](std::size_t j) { return spline.increments()[place.first + j]; };
  const auto turn = natural_sizes(place.basis, d, rotation_begin),
             shift = natural_sizes(place.basis, d, 3 - rotation_begin);
  // What a rounding of every control point by eps does: as if the increments were as large as the points.
  std::array<long double, 3> sum{};
  for (std::size_t n = 0; n < 3; ++n) {
    for (const Scalar lambda : place.basis.lambda[n]) sum[n] += 2 * std::abs(static_cast<long double>(lambda));
  }
  long double far = 1;
  for (std::size_t j = 0; j < static_cast<std::size_t>(Order); ++j) {
    far =
        std::max(far, static_cast<long double>(splinertia::position(spline.control_points()[place.first + j]).norm()));
  }
  Sizes sizes, cond;
  sizes.omega = turn[1] + 1e-60L;  // a body at rest: the table's 1e-111 are its own working precision
  sizes.alpha = turn[2] + turn[1] * turn[1] + 1e-60L;
  sizes.velocity = shift[1];
  sizes.acceleration = shift[2] + 2 * turn[1] * shift[1];
  cond.omega = sizes.omega + sum[1];
  cond.alpha = sizes.alpha + sum[2] + 2 * turn[1] * sum[1];
  cond.velocity = sizes.velocity + far * sum[1];
  cond.acceleration = sizes.acceleration + far * (sum[2] + 2 * turn[1] * sum[1]) + 2 * shift[1] * sum[1];
  sizes.gravity = cond.gravity = static_cast<long double>(gravity.norm());
  sizes.lever = cond.lever = static_cast<long double>(arm.p_BI.norm());

  const auto bg = vector<Scalar>(row, "bg"), ba = vector<Scalar>(row, "ba");
  const auto omega = splinertia::angular_velocity(m);
  grader.check("omega_b", flat(omega), row.outputs("omega_b"), {sizes.omega, cond.omega});
  grader.check("alpha_b", flat(splinertia::angular_acceleration(m)), row.outputs("alpha_b"), {sizes.alpha, cond.alpha});
  const auto imu = splinertia::ideal_imu(m, gravity, arm);
  grader.check("gyro", flat(Eigen::Vector3<Scalar>(imu.gyro + bg)), row.outputs("gyro"), {sizes.omega, cond.omega});
  grader.check("accel", flat(Eigen::Vector3<Scalar>(imu.accel + ba)), row.outputs("accel"),
               {sizes.force(), cond.force()});
}

template <typename Scalar, typename G>
void check_reading(const Row& row, Report& report) {
  using std::chrono::nanoseconds;
  for_order(row, report, [&]<int Order>() {
    Grader<Scalar> grader(report, row);
    if (row.text("mode") != "ns") return grader.skip();
    const auto values = row.inputs<Scalar>("ctrl");
    std::vector<G> points;
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.integer("n")); ++i) {
      points.push_back(
          splinertia::make_pose<G>(read_unit_rotation<Scalar>(values, 7 * i + 3), read_vector<Scalar>(values, 7 * i)));
    }
    compare_reading<Scalar, Order, G>(
        row, grader, {{nanoseconds(row.integer64("t0")), nanoseconds(row.integer64("dt"))}, std::move(points)});
  });
}

template <typename Scalar>
void check_reading_row(const Row& row, Report& report) {
  if (row.text("group") == "SE3") {
    check_reading<Scalar, Sophus::SE3<Scalar>>(row, report);
  } else {
    check_reading<Scalar, SO3xR3<Scalar>>(row, report);
  }
}

}  // namespace

void check_imu_truth(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_truth_row<Scalar>(row, report); });
}

void check_imu_spline(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_reading_row<Scalar>(row, report); });
}

}  // namespace golden
