// SPDX-License-Identifier: MIT
/// The table of preintegrated motions with their bias Jacobians. It has neither scale nor condition: the natural size
/// of each quantity is what its integral would be if nothing cancelled, with |ω| and |a| in the place of both vectors,
/// and the measurement and the bias of each interval added, not subtracted. Its error is that of
///
///   steps + ∫|ω|dt
///
/// roundings of such a size: one a step, which may all go the same way, and that of the angle that the attitude is made
/// of. A rounding of every input, which float has, adds no more than the second.
#include <chrono>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>

#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

using Eigen::Vector3;
using std::chrono::nanoseconds;

/// The intervals of a row: in them rate and force are linear in time, start + slope τ.
template <typename Scalar>
struct Interval {
  nanoseconds length;
  Eigen::Vector3<Scalar> gyro, gyro_slope, accel, accel_slope;
  [[nodiscard]] Scalar seconds() const { return splinertia::to_seconds<Scalar>(length); }
};

template <typename Scalar>
[[nodiscard]] std::vector<Interval<Scalar>> read_intervals(const Row& row) {
  const auto lengths = split(row.text("h_ns"), ' ');
  const auto w0 = row.inputs<Scalar>("w0"), w1 = row.inputs<Scalar>("w1");
  const auto a0 = row.inputs<Scalar>("a0"), a1 = row.inputs<Scalar>("a1");
  const auto slope = [](const std::vector<Scalar>& values, std::size_t i) -> Eigen::Vector3<Scalar> {
    if (values.empty()) return Eigen::Vector3<Scalar>::Zero();
    return read_vector(values, i);
  };
  std::vector<Interval<Scalar>> intervals;
  for (std::size_t i = 0; i < static_cast<std::size_t>(row.integer("N")); ++i) {
    intervals.push_back({nanoseconds(std::stoll(lengths.at(i))), read_vector(w0, 3 * i), slope(w1, 3 * i),
                         read_vector(a0, 3 * i), slope(a1, 3 * i)});
  }
  return intervals;
}

template <typename Scalar>
[[nodiscard]] splinertia::ImuBias<Scalar> read_bias(const Row& row) {
  return {input_vector<Scalar, 3>(row, "bg"), input_vector<Scalar, 3>(row, "ba")};
}

/// Something of the result: its column, its value, its natural size.
struct Quantity {
  std::string name, column;
  Numbers value;
  long double size;
};

struct Sizes {
  long double time = 0, turn = 0;                          // s, rad
  long double velocity = 0, position = 0;                  // m/s, m
  long double velocity_by_gyro = 0, position_by_gyro = 0;  // m/s², m, by rad/s
  void add(long double rate, long double force, long double h) {
    position_by_gyro += velocity_by_gyro * h + force * time * h * h / 2 + force * h * h * h / 6;
    velocity_by_gyro += force * time * h + force * h * h / 2;
    position += velocity * h + force * h * h / 2;
    velocity += force * h;
    turn += rate * h;
    time += h;
  }
};

template <typename Scalar>
[[nodiscard]] Sizes natural_sizes(const std::vector<Interval<Scalar>>& intervals,
                                  const splinertia::ImuBias<Scalar>& bias) {
  const auto norm = [](const Eigen::Vector3<Scalar>& v) { return static_cast<long double>(v.stableNorm()); };
  Sizes sizes;
  for (const auto& i : intervals) {
    const auto h = static_cast<long double>(i.seconds());
    sizes.add(norm(i.gyro) + norm(i.gyro_slope) * h + norm(bias.gyro),
              norm(i.accel) + norm(i.accel_slope) * h + norm(bias.accel), h);
  }
  return sizes;
}

/// The attitude twice: as it is, and its vector part alone, which is as small as the turn.
template <typename Scalar>
[[nodiscard]] std::vector<Quantity> quantities(const Row& row, const splinertia::PreintegratedImu<Scalar>& imu,
                                               const Sizes& sizes) {
  const auto& delta = imu.delta();
  const auto& J = imu.jacobians();
  const Numbers q = signed_like(row.outputs("dq"), flat(delta.rotation.coeffs()));
  const long double t = sizes.time;
  return {{"dq", "dq", q, 1},
          {"dq vector", "dq", part(q, 0, 3), sizes.turn},
          {"dv", "dv", flat(delta.velocity), sizes.velocity},
          {"dp", "dp", flat(delta.position), sizes.position},
          {"J_R_bg", "J_R_bg", flat(J.R_gyro), t},
          {"J_v_bg", "J_v_bg", flat(J.v_gyro), sizes.velocity_by_gyro},
          {"J_p_bg", "J_p_bg", flat(J.p_gyro), sizes.position_by_gyro},
          {"J_v_ba", "J_v_ba", flat(J.v_accel), t},
          {"J_p_ba", "J_p_ba", flat(J.p_accel), t * t / 2}};
}

/// Rate and force are held over each interval: ZeroOrderHold is exact.
template <typename Scalar>
[[nodiscard]] splinertia::PreintegratedImu<Scalar> preintegrate_held(const std::vector<Interval<Scalar>>& intervals,
                                                                     const splinertia::ImuBias<Scalar>& bias) {
  using Sample = splinertia::ImuSample<Scalar, nanoseconds>;
  nanoseconds time(1'700'000'000'123'456'789);  // any start, such as that of a log
  splinertia::Preintegrator<splinertia::ZeroOrderHold, Scalar, nanoseconds> preintegrator(time, bias);
  for (const auto& i : intervals) {
    preintegrator.push(Sample{time, i.gyro, i.accel});
    time += i.length;
  }
  preintegrator.push(
      Sample{time, Eigen::Vector3<Scalar>::Constant(9), Eigen::Vector3<Scalar>::Constant(9)});  // is not looked at
  preintegrator.finish();
  return preintegrator.result();
}

/// Rate and force are linear in each interval, each of which is taken in `pieces` with their exact moments: a method of
/// order 4.
template <typename Scalar>
[[nodiscard]] splinertia::PreintegratedImu<Scalar> preintegrate_linear(const std::vector<Interval<Scalar>>& intervals,
                                                                       const splinertia::ImuBias<Scalar>& bias,
                                                                       int pieces) {
  splinertia::PreintegratedImu<Scalar> result(bias);
  for (const auto& i : intervals) {
    const Scalar h = i.seconds() / static_cast<Scalar>(pieces), twelfth = h * h / Scalar(12);
    for (int piece = 0; piece < pieces; ++piece) {
      const Scalar middle = i.seconds() * (static_cast<Scalar>(2 * piece + 1) / static_cast<Scalar>(2 * pieces));
      splinertia::detail::StepMoments<Scalar> moments;
      moments.phi = (i.gyro - bias.gyro + i.gyro_slope * middle) * h;
      moments.nu = (i.accel - bias.accel + i.accel_slope * middle) * h;
      moments.phi_moment = i.gyro_slope * twelfth;
      moments.nu_moment = i.accel_slope * twelfth;
      moments.interval = h;
      result.append(splinertia::detail::linearize_increment(moments));
    }
  }
  return result;
}

[[nodiscard]] long double distance(const Numbers& a, const Numbers& b) {
  long double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

template <typename Scalar>
void check_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  const auto intervals = read_intervals<Scalar>(row);
  const auto bias = read_bias<Scalar>(row);
  const Sizes sizes = natural_sizes(intervals, bias);
  const auto roundings = [&](int pieces) { return static_cast<long double>(intervals.size()) * pieces + sizes.turn; };
  int pieces = 1;
  std::vector<Quantity> results;
  if (row.text("w1").empty()) {
    results = quantities(row, preintegrate_held(intervals, bias), sizes);
  } else {
    // Twice as many pieces, until the error of the method, of which 15/16 goes with each doubling, is below one unit of
    // the error of rounding, four of which are allowed: so the row has no say in how many there are.
    const auto at = [&](int n) { return quantities(row, preintegrate_linear(intervals, bias, n), sizes); };
    results = at(pieces);
    const auto exact_to_rounding = [&](const std::vector<Quantity>& coarser) {
      const long double unit = roundings(pieces) * static_cast<long double>(std::numeric_limits<Scalar>::epsilon());
      for (std::size_t i = 0; i < results.size(); ++i) {
        const long double step = distance(results[i].value, coarser[i].value);
        if (!(step / 15 <= unit * results[i].size)) return false;
      }
      return true;
    };
    for (std::vector<Quantity> coarser;;) {
      if (pieces > 1 << 14) return grader.fail("no agreement of resolutions");
      coarser = std::exchange(results, at(pieces *= 2));
      if (exact_to_rounding(coarser)) break;
    }
  }
  for (const auto& [name, column, value, size] : results) {
    const long double scale = size * roundings(pieces);
    grader.check(name, value, part(row.outputs(column), 0, value.size()), {scale, scale});
  }
}

}  // namespace

void check_preint(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_row<Scalar>(row, report); });
}

}  // namespace golden
