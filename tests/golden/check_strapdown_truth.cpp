// SPDX-License-Identifier: MIT
/// The table of states that a body has reached by a given rate and force, sinusoids on each axis, integrated from point
/// samples by the schemes of order 4.
///
/// No number of samples is written down here: it is doubled until the error of the method, of which 15/16 goes with
/// each doubling, is seen to be below 1e-12 of the size of a quantity (or below its rounding), so that what is allowed
/// is
///
///   4 eps · size · (samples + ∫|ω|dt)  +  4e-12 · size
///
/// with the sizes that attitude (1), velocity (|v₀| + ∫|f|dt + |g|t) and position have if nothing cancels: in double,
/// with the thousands of samples that it takes, up to some 1e-11. float stops at its rounding.
#include <splinertia/strapdown/integrator.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>

#include "check_spline.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

using Eigen::Vector3;

/// bias + amplitude sin(frequency t + phase) of each axis.
struct Sinusoids {
  Numbers bias, amplitude, frequency, phase;

  Sinusoids(const Row& row, const std::string& sensor) {
    bias = row.inputs<long double>(sensor + "_bias");
    amplitude = row.inputs<long double>(sensor + "_amp");
    frequency = row.inputs<long double>(sensor + "_freq");
    phase = row.inputs<long double>(sensor + "_phase");
  }
  /// Rounded once, as a log has it.
  template <typename Scalar>
  [[nodiscard]] Eigen::Vector3<Scalar> at(long double t) const {
    Eigen::Vector3<Scalar> v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[static_cast<Eigen::Index>(i)] =
          static_cast<Scalar>(bias.at(i) + amplitude.at(i) * std::sin(frequency.at(i) * t + phase.at(i)));
    }
    return v;
  }
};

[[nodiscard]] long double norm(const Numbers& v) {
  return std::sqrt(v.at(0) * v.at(0) + v.at(1) * v.at(1) + v.at(2) * v.at(2));
}

struct Quantity {
  const char* column;
  Numbers value;
  long double size;
};

/// The state at the end from `samples` + 1 point samples.
template <typename Scheme, typename Scalar>
struct Run {
  std::vector<Quantity> quantities;
  long double roundings;

  Run(const Row& row, const Sinusoids& omega, const Sinusoids& force, int samples) {
    // Stamps are doubles at least, so that float, too, has them.
    using Time = std::conditional_t<std::is_same_v<Scalar, long double>, long double, double>;
    using State = splinertia::NavState<Scalar, Time>;
    const auto end = row.input<Time>("t");
    const Eigen::Vector3<Scalar> v0 = input_vector<Scalar, 3>(row, "v0"), p0 = input_vector<Scalar, 3>(row, "p0"),
                                 gravity = input_vector<Scalar, 3>(row, "g");
    splinertia::Integrator<Scheme, Scalar, Time> integrator(
        State{read_unit_rotation<Scalar>(row.inputs<Scalar>("q0"), 0), v0, p0, Time(0)}, gravity);
    long double turn = 0, push = 0;
    const long double h = static_cast<long double>(end) / samples;
    for (int i = 0; i <= samples; ++i) {
      const Time t = end * static_cast<Time>(i) / static_cast<Time>(samples);
      const splinertia::ImuSample<Scalar, Time> sample{t, omega.at<Scalar>(t), force.at<Scalar>(t)};
      turn += static_cast<long double>(sample.gyro.norm()) * h;
      push += static_cast<long double>(sample.accel.norm()) * h;
      integrator.push(sample);
    }
    integrator.finish();
    const State& state = integrator.state();
    const auto t = static_cast<long double>(end);
    const long double v = norm(flat(v0)) + push + norm(flat(gravity)) * t;
    quantities = {{"q", rotation_numbers(state.R_WB, row.outputs("q")), 1},
                  {"v", flat(state.v_WB), v},
                  {"p", flat(state.p_WB), norm(flat(p0)) + v * t}};
    roundings = samples + turn;
  }
};

template <typename Scheme, typename Scalar>
void check_scheme(const Row& row, Grader<Scalar>& grader, const char* scheme) {
  constexpr long double tolerance = 1e-12L;
  constexpr auto eps = static_cast<long double>(std::numeric_limits<Scalar>::epsilon());
  const Sinusoids omega(row, "w"), force(row, "f");
  // The fastest turn of a phase or of the body is at most half a radian a sample, or the first two could agree by
  // chance.
  long double fastest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    fastest = std::max({fastest, std::abs(omega.frequency.at(i)), std::abs(force.frequency.at(i)),
                        std::abs(omega.bias.at(i)) + std::abs(omega.amplitude.at(i))});
  }
  int samples = 16;
  while (fastest * row.input<long double>("t") > samples / 2.0L) samples *= 2;
  Run<Scheme, Scalar> run(row, omega, force, samples);
  for (bool exact = false; !exact;) {
    if (samples > 1 << 21) return grader.fail("no agreement of resolutions");
    const auto coarser = std::exchange(run, {row, omega, force, samples *= 2});
    exact = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Quantity &a = run.quantities[i], &b = coarser.quantities[i];
      for (std::size_t k = 0; k < a.value.size(); ++k) {
        const long double allowed = std::max(tolerance, run.roundings * eps) * a.size;
        if (!(std::abs(a.value[k] - b.value[k]) / 15 <= allowed)) exact = false;
      }
    }
  }
  for (const auto& [column, value, size] : run.quantities) {
    const long double scale = size * (run.roundings + tolerance / eps);
    grader.check(std::string(column) + ", " + scheme, value, row.outputs(column), {scale, scale});
  }
}

template <typename Scalar>
void check_row(const Row& row, Report& report) {
  Grader<Scalar> grader(report, row);
  check_scheme<splinertia::Magnus4>(row, grader, "Magnus4");
  check_scheme<splinertia::RungeKutta4DoubleStep>(row, grader, "RungeKutta4DoubleStep");
}

}  // namespace

void check_strapdown_truth(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_row<Scalar>(row, report); });
}

}  // namespace golden
