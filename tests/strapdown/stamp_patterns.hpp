// SPDX-License-Identifier: MIT
/// Stamps of every kind, and whether a scheme of order 4 is at most as far off on them as twice Midpoint.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "strapdown/schemes/convergence.hpp"

namespace splinertia::testing {

/// Stamps from 0 to about 10 s at a mean rate of 200 Hz, increasing.
inline std::vector<std::pair<std::string, std::vector<double>>> stamp_patterns() {
  constexpr double h = 0.005;
  std::mt19937 bits(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<std::pair<std::string, std::vector<double>>> patterns;
  for (const double jitter : {0.1, 0.2, 0.5, 1.0, 3.0}) {
    auto stamps = regular_stamps(200);
    for (std::size_t i = 1; i < stamps.size(); ++i) stamps[i] = std::max(1e-9, stamps[i] + jitter * h * normal(bits));
    std::sort(stamps.begin(), stamps.end());
    for (std::size_t i = 1; i < stamps.size(); ++i) stamps[i] = std::max(stamps[i], stamps[i - 1] + 1e-9);
    patterns.emplace_back("jitter of " + std::to_string(jitter) + " intervals", stamps);
  }
  for (const auto& [size, apart] : {std::pair{2, 1e-3}, {2, 1e-4}, {2, 1e-5}, {2, 1e-9}, {3, 1e-4}, {8, 1e-4}}) {
    std::vector<double> stamps;
    for (int i = 0; i < 2000 / size; ++i) {
      for (int j = 0; j < size; ++j) stamps.push_back(i * h * size + j * apart);
    }
    patterns.emplace_back("bursts of " + std::to_string(size) + ", s apart: " + std::to_string(apart), stamps);
  }
  std::vector<double> dropouts, twins;
  for (const double t : regular_stamps(200)) {
    if (t == 0 || uniform(bits) < 0.6) dropouts.push_back(t);
    twins.push_back(t);
    if (uniform(bits) < 0.1) twins.push_back(t + 1e-9);
  }
  patterns.emplace_back("40 % dropped", dropouts);
  patterns.emplace_back("a tenth repeated after 1 ns", twins);
  return patterns;
}

/// RMS position error, m, over the run: in the aggressive motion, or at rest, with white noise on the readings, and of
/// readings that are late or early by as much as `lateness` s.
template <typename Scheme, typename Scalar>
double error_on(const std::vector<double>& stamps, double speed, double noise, double lateness, unsigned seed) {
  const AggressiveMotion<> motion{.speed = speed};
  std::mt19937 bits(seed);
  std::normal_distribution<double> normal;
  const auto random = [&] { return Eigen::Vector3d(normal(bits), normal(bits), normal(bits)); };
  const auto start = nav_state(motion.evaluate<1>(0), 0.0);
  const NavState<Scalar> initial{start.R_WB.template cast<Scalar>(), start.v_WB.template cast<Scalar>(),
                                 start.p_WB.template cast<Scalar>(), 0.0};
  Integrator<Scheme, Scalar> integrator(initial, standard_gravity<Scalar>(), {.longest = Scalar(10)});
  double squares = 0;
  const auto visit = [&](const NavState<Scalar>& state) {
    const Eigen::Vector3d truth = position(motion.evaluate<0>(state.time).value);
    squares += (state.p_WB.template cast<double>() - truth).squaredNorm();
  };
  const auto ideal = increments(motion, stamps);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if constexpr (Scheme::takes_increments) {
      if (i == 0) continue;
      const auto& sum = ideal[i - 1];
      // Like a unit that sums at its own pace: the noise of an increment does not know the stamps.
      integrator.push(
          ImuIncrement<Scalar, double>{stamps[i], (sum.delta_angle + 0.005 * noise * random()).template cast<Scalar>(),
                                       (sum.delta_velocity + 0.05 * noise * random()).template cast<Scalar>()},
          visit);
    } else {
      const double late = i == 0 ? 0 : lateness * normal(bits);
      const auto imu = ideal_imu(motion.evaluate<2>(stamps[i] + late));
      integrator.push(ImuSample<Scalar, double>{stamps[i], (imu.gyro + noise * random()).template cast<Scalar>(),
                                                (imu.accel + 10 * noise * random()).template cast<Scalar>()},
                      visit);
    }
  }
  integrator.finish(visit);
  return std::sqrt(squares / static_cast<double>(stamps.size()));
}

/// Whether `Scheme` is off by at most twice as much as `Plain`, the scheme of order 2 on the same readings, for all
/// patterns: with and without noise and wrong stamps, each the mean of five runs where there is chance in it.
template <typename Scheme, typename Plain, typename Scalar = double>
void check_never_amplifies() {
  for (const auto& [name, stamps] : stamp_patterns()) {
    for (const auto& [speed, noise, lateness] :
         {std::array{1.0, 0.0, 0.0}, {0.0, 0.01, 0.0}, {0.3, 0.01, 0.0}, {0.3, 0.0, 1e-3}}) {
      double error = 0, plain = 0;
      for (unsigned seed = 1; seed <= (noise + lateness > 0 ? 5U : 1U); ++seed) {
        error += error_on<Scheme, Scalar>(stamps, speed, noise, lateness, seed);
        plain += error_on<Plain, Scalar>(stamps, speed, noise, lateness, seed);
      }
      CAPTURE(name, speed, noise, lateness, plain);
      CHECK(error <= 2 * plain);
    }
  }
}

}  // namespace splinertia::testing
