// SPDX-License-Identifier: MIT
// Is the covariance of preintegration that of its errors? 2000 simulated runs: the normalised estimation error squared
// rᵀP⁻¹r of d components has a χ² distribution with d degrees of freedom, their sum one with 2000 d.
//
// The covariance is of first order in the noise. Where that ends: an attitude error φ takes |f|φ²/2 from the velocity
// along the force f, in which direction there is nothing of first order but the accelerometer's own noise. With N the
// density of the gyroscope's and N' of the accelerometer's noise, what this adds to the NEES after a time t is of the
// size of (|f| N² t^1.5/N')²: after 1 s 0.013 for `course`, 2e-8 for `euroc`, but 0.7 for `course_quiet`, whose
// accelerometer is so much better than its gyroscope; after 0.15 s 0.002.
#include <Eigen/Cholesky>
#include <array>
#include <splinertia/imu/imu_noise.hpp>
#include <splinertia/imu/presets.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegration_residual.hpp>
#include <string>

#include "strapdown/preintegration/preintegration_runs.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

constexpr int runs = 2000;

/// The quantile of χ² with n degrees of freedom where a standard normal has z. Wilson and Hilferty, PNAS 17 (1931),
/// 684: for n in the thousands, exact to 1e-6 of n.
double chi_square(double n, double z) {
  const double c = 2 / (9 * n);
  return n * std::pow(1 - c + z * std::sqrt(c), 3);
}
constexpr double z99 = 2.5758293035489;  // 0.5 % on either side

struct Part {
  const char* name;
  int begin, size;
};
constexpr std::array<Part, 6> parts{Part{"attitude", 0, 3}, Part{"velocity", 3, 3}, Part{"position", 6, 3},
                                    Part{"motion", 0, 9},   Part{"biases", 9, 6},   Part{"all", 0, 15}};

struct Statistics {
  std::array<double, parts.size()> sums{};

  void add(const PreintegrationResidual<double>& r, const Eigen::Matrix<double, 15, 15>& P) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto [name, begin, size] = parts[i];
      const Eigen::VectorXd e = r.segment(begin, size);
      sums[i] += e.dot(P.block(begin, begin, size, size).llt().solve(e));
    }
  }
  void check(const std::string& what) const {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double n = runs * parts[i].size;
      INFO(what << ", " << parts[i].name << ": " << sums[i] / runs << " of " << parts[i].size << ", bounds "
                << chi_square(n, -z99) / runs << " and " << chi_square(n, z99) / runs);
      CHECK(sums[i] >= chi_square(n, -z99));
      CHECK(sums[i] <= chi_square(n, z99));
    }
  }
};

/// A run of one scheme.
template <typename Scheme>
struct Run {
  NavState<double> initial, final;
  ImuNoise<double> noise;
  Statistics statistics;

  Run(const auto& motion, const auto& clean, const ImuNoise<double>& densities)
      : initial(nav_state(motion.template evaluate<1>(clean.front().time), clean.front().time)),
        final(integrate<Scheme>(initial, clean).back()),
        noise(densities) {}

  void add(const auto& readings) {
    const auto imu = testing::preintegrate<Scheme, double>(initial.time, readings, {}, noise);
    const auto& last = readings.back();
    statistics.add(
        preintegration_residual(imu, initial, {}, final, {last.gyro_bias, last.accel_bias}, standard_gravity<double>()),
        imu.covariance().matrix());
  }
};

/// The readings of a simulation.
auto all(const auto& simulation) {
  std::vector<std::remove_cvref_t<decltype(*simulation.begin())>> readings;
  readings.reserve(simulation.size());
  for (const auto& reading : simulation) readings.push_back(reading);
  return readings;
}

template <typename... Schemes>
auto monte_carlo(const auto& motion, const auto& sensors, double duration, double rate = 200) {
  const auto clean =
      all(simulate(motion, Imu{ErrorModel{}, ErrorModel{}}, {.rate = rate, .start = 1.0, .end = 1.0 + duration}));
  const ImuNoise<double> noise = imu_noise(sensors);
  std::tuple<Run<Schemes>...> schemes{Run<Schemes>(motion, clean, noise)...};
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    const auto readings =
        all(simulate(motion, sensors, {.rate = rate, .seed = seed, .start = 1.0, .end = 1.0 + duration}));
    std::apply([&](auto&... run) { (run.add(readings), ...); }, schemes);
  }
  return schemes;
}

void check_preset(const auto& sensors, double duration, double rate) {
  const auto [midpoint, euler, magnus4] = monte_carlo<Midpoint, Euler, Magnus4>(Ellipse<>{}, sensors, duration, rate);
  midpoint.statistics.check("Midpoint");
  euler.statistics.check("Euler");
  magnus4.statistics.check("Magnus4");
}

}  // namespace

TEST_CASE("NEES is within its 99 % bounds: the course's IMU, 1 s at 200 Hz") { check_preset(presets::course, 1, 200); }
TEST_CASE("NEES is within its 99 % bounds: its quiet IMU, 0.15 s at 1 kHz") {
  check_preset(presets::course_quiet, 0.15, 1000);
}
TEST_CASE("NEES is within its 99 % bounds: EuRoC's IMU, 1 s at 200 Hz") { check_preset(presets::euroc, 1, 200); }

TEST_CASE("After 1 s the quiet IMU has an error of second order, which falls with the square of the noise") {
  const auto nees = [](double factor) {
    const Imu imu{ErrorModel{RandomWalk{1e-5 * factor}, WhiteNoise{0.005 * factor}},
                  ErrorModel{RandomWalk{1e-4 * factor}, WhiteNoise{3e-4 * factor}}};
    return std::get<0>(monte_carlo<Midpoint>(Ellipse<>{}, imu, 1, 100)).statistics;
  };
  CHECK(nees(1).sums[3] > chi_square(9 * runs, z99));  // of all nine numbers of the motion
  nees(0.125).check("Midpoint, with an eighth of the noise");
}

TEST_CASE("Samples that two steps share: a short run alone is a little better than its covariance says") {
  // Midpoint's four steps have half of the first and last sample's noise, together 3.5 samples' variance where the
  // covariance has four, and a NEES of 7/8. The next run has the other half of the last one's: in a chain of runs,
  // which are taken to be independent, each must have a whole sample's.
  const auto [midpoint, euler] = monte_carlo<Midpoint, Euler>(Ellipse<>{}, presets::course, 0.02);
  const double deviation = std::sqrt(2.0 / (3 * runs));  // of the mean of 3·2000 squares
  CHECK_THAT(euler.statistics.sums[0] / (3 * runs), WithinAbs(1, z99 * deviation));
  CHECK_THAT(midpoint.statistics.sums[0] / (3 * runs), WithinAbs(7.0 / 8, z99 * deviation));
}
