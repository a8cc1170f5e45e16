// SPDX-License-Identifier: MIT
// The errors of integration: samples are integrated as they arrive and compared with the truth.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <splinertia/strapdown/integrator.hpp>
#include <splinertia/strapdown/nav_state.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/units.hpp>

#include "support/csv_table.hpp"

using TrueState = splinertia::NavState<double, std::chrono::nanoseconds>;

struct RunningError {
  double squares = 0, largest = 0, last = 0;
  std::size_t count = 0;

  void add(double error) {
    squares += error * error;
    largest = std::max(largest, error);
    last = error;
    ++count;
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
};

template <typename Scheme>
class SchemeErrors {
 public:
  SchemeErrors(const char* imu, const char* scheme, const Eigen::Vector3d& gravity)
      : imu_(imu), scheme_(scheme), gravity_(gravity) {}

  void add(const auto& sample, const TrueState& truth) {
    if (!integrator_) {
      auto initial = truth;
      initial.time = sample.time;  // the integrator knows only the IMU's clock
      // Bridging samples that the error model drops is part of the comparison. Holes of the trajectory restart it.
      integrator_.emplace(initial, gravity_, splinertia::GapOptions<double>{.policy = splinertia::GapPolicy::bridge});
    }
    integrator_->push(sample);
    const TrueState& state = integrator_->state();
    position_.add((state.p_WB - truth.p_WB).norm());
    attitude_.add(splinertia::increment(truth.R_WB, state.R_WB).norm() / splinertia::units::degree);
  }
  /// The next sample starts from the truth.
  void restart() { integrator_.reset(); }

  void print() const {
    std::printf("%-6s %-9s %10.3g %10.3g %10.3g %10.3g %10.3g %10.3g\n", imu_, scheme_, position_.rms(),
                position_.largest, position_.last, attitude_.rms(), attitude_.largest, attitude_.last);
  }
  void write(CsvTable& table) const {
    table.row(imu_, scheme_, position_.rms(), position_.largest, position_.last, attitude_.rms(), attitude_.largest,
              attitude_.last);
  }

 private:
  const char* imu_;
  const char* scheme_;
  Eigen::Vector3d gravity_;
  RunningError position_, attitude_;  // m, deg
  std::optional<splinertia::Integrator<Scheme, double, std::chrono::nanoseconds>> integrator_;
};

/// The errors of one IMU with two schemes.
class DeadReckoning {
 public:
  DeadReckoning(const char* imu, const Eigen::Vector3d& gravity)
      : euler_(imu, "Euler", gravity), midpoint_(imu, "Midpoint", gravity) {}

  void add(const auto& sample, const TrueState& truth) {
    euler_.add(sample, truth);
    midpoint_.add(sample, truth);
  }
  void restart() {
    euler_.restart();
    midpoint_.restart();
  }
  void print() const {
    euler_.print();
    midpoint_.print();
  }
  void write(CsvTable& table) const {
    euler_.write(table);
    midpoint_.write(table);
  }

 private:
  SchemeErrors<splinertia::Euler> euler_;
  SchemeErrors<splinertia::Midpoint> midpoint_;
};
