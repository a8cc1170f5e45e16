// SPDX-License-Identifier: MIT
/// Table of landmarks seen with a rolling shutter: rolling_shutter. T_WB(t) = T0 exp(twist (t − t0)).
///
/// `scale` is what a rounding of every input by eps changes, and bounds a pixel alone; a time has the rounding of its
/// stamp beside it. The slope 1 − line_delay dv/dt divides the derivatives, and its rounding is theirs.
#include <cmath>
#include <splinertia/camera/linearize_observation.hpp>
#include <splinertia/camera/observe.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/motion/constant_twist.hpp>

#include "golden_checks.hpp"

namespace golden {

namespace {

using namespace splinertia;

/// A constant twist whose initial pose is that of the time t0.
template <typename Scalar>
struct TwistFrom {
  using Group = Sophus::SE3<Scalar>;
  using Time = Scalar;

  ConstantTwist<Group> motion;
  Scalar t0;

  [[nodiscard]] Time start() const { return motion.start(); }
  [[nodiscard]] Time end() const { return motion.end(); }
  template <int D>
  [[nodiscard]] Motion<Group, D> evaluate(Time t) const {
    return motion.template evaluate<D>(t - t0);
  }
};

template <typename Scalar>
[[nodiscard]] Sophus::SE3<Scalar> input_pose(const Row& row, std::string_view column) {
  const auto p = input_vector<Scalar, 3>(row, column);
  const auto q = input_vector<Scalar, 4>(row, column, 3);
  return {Sophus::SO3<Scalar>(Eigen::Quaternion<Scalar>(q[3], q[0], q[1], q[2])), p};
}

/// A measure of C eps scale exactly: the grader adds |gold|.
[[nodiscard]] Measure exactly(long double scale, const Numbers& gold) {
  return {scale - magnitude(gold), scale - magnitude(gold)};
}

template <typename Scalar>
void check_derivatives(const Row& row, Grader<Scalar>& grader, const auto& at, const Scalar& delay) {
  const long double slope = std::abs(1 - static_cast<long double>(delay) * static_cast<long double>(at.rate.y()));
  const auto check = [&](const char* column, const Numbers& got) {
    const auto gold = row.outputs(column);
    const long double cond = magnitude(gold) * 10 / slope;
    grader.check(column, got, gold, {cond, cond, jacobian_limit});
  };
  check("d_pixel_d_line_delay", flat(at.line_delay_jacobian));
  check("d_pixel_d_t0", flat(at.clock_offset_jacobian));
  check("J_landmark", flat(at.landmark_jacobian));
}

template <typename Scalar>
void check_observations(const Row& row, Report& report, const auto& model) {
  Grader<Scalar> grader(report, row);
  // A float cannot tell the times of two rows apart there.
  if (std::is_same_v<Scalar, float> && row.text("class") == "epoch") return grader.skip();
  const auto t0 = row.input<Scalar>("t0"), delay = row.input<Scalar>("line_delay");
  const TwistFrom<Scalar> curve{{input_pose<Scalar>(row, "T0"), input_vector<Scalar, 6>(row, "twist")}, t0};
  const auto size = row.inputs<double>("size");
  const Camera camera{model, ImageSize{static_cast<int>(size.at(0)), static_cast<int>(size.at(1))},
                      input_pose<Scalar>(row, "T_BC"), RollingShutter{delay}};
  const auto landmark = input_vector<Scalar, 3>(row, "landmark");
  const auto found = observe(curve, camera, landmark, t0);
  if (found.size() != static_cast<std::size_t>(row.integer("count"))) return grader.fail("count");
  const auto times = row.outputs("times"), pixels = row.outputs("pixels"), scales = row.outputs("scale");
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto pixel = part(pixels, 2 * i, 2), time = part(times, i, 1);
    const long double scale = part(scales, i, 1)[0];
    grader.check("pixels", flat(found[i].pixel), pixel, exactly(scale, pixel));
    const long double got = static_cast<long double>(t0) + static_cast<long double>(found[i].row_offset);
    grader.check("times", {got}, time, exactly(std::abs(time[0]) + static_cast<long double>(delay) * scale, time));
  }
  if (found.size() != 1 || std::is_same_v<Scalar, float>) return;
  const auto at =
      linearize_observation<Wrt::landmark | Wrt::clock_offset | Wrt::line_delay>(curve, camera, landmark, t0, found[0]);
  if (!at) return grader.fail("domain");
  check_derivatives<Scalar>(row, grader, *at, delay);
}

template <typename Scalar>
void check_row(const Row& row, Report& report) {
  const auto p = row.inputs<Scalar>("params");
  if (p.size() == 4) {
    check_observations<Scalar>(row, report, Pinhole{p[0], p[1], p[2], p[3], NoDistortion<Scalar>{}});
  } else {
    check_observations<Scalar>(
        row, report, Pinhole{p.at(0), p.at(1), p.at(2), p.at(3), RadialTangential{p.at(4), p.at(5), p.at(6), p.at(7)}});
  }
}

}  // namespace

void check_rolling_shutter(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_row<Scalar>(row, report); });
}

}  // namespace golden
