// SPDX-License-Identifier: MIT
/// What one error term without random numbers does to samples made by hand.
#pragma once

#include <cstddef>
#include <limits>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/imu/imu_sensor_sample.hpp>
#include <vector>

#include "support/catch.hpp"

namespace splinertia::testing {

template <typename Scalar>
constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
template <typename Scalar>
constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();

/// The sample at `elapsed` of a run at 100 Hz, with that much in value and bias before the term.
template <typename Scalar = double>
ImuSensorSample<Scalar> sample_with(const Eigen::Vector3<Scalar>& value,
                                    const Eigen::Vector3<Scalar>& bias = Eigen::Vector3<Scalar>::Zero(),
                                    Scalar elapsed = Scalar(0)) {
  return {{value, bias, Scalar(1) / Scalar(100), elapsed == Scalar(0), elapsed}, {value, value}};
}

/// What a term makes of the first sample of its run.
template <typename Term, typename Scalar>
ImuSensorSample<Scalar> applied(const Term& term, ImuSensorSample<Scalar> sample) {
  StateOf<Term> state{};
  term.apply(sample, state);
  return sample;
}

/// What a linear term makes of input(t) at the given times, with twice the input as the bias: the bias that comes out
/// must be twice the reading.
template <typename Term, typename Scalar>
std::vector<Eigen::Vector3<Scalar>> responses(const Term& term, const std::vector<Scalar>& times, const auto& input) {
  StateOf<Term> state{};
  std::vector<Eigen::Vector3<Scalar>> outputs;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Eigen::Vector3<Scalar> value = input(times[i]), bias = Scalar(2) * value;
    const Scalar interval = i == 0 ? times[1] - times[0] : times[i] - times[i - 1];
    SensorSample<Scalar> sample{value, bias, interval, i == 0, times[i] - times[0]};
    term.apply(sample, state);
    REQUIRE(sample.bias == Scalar(2) * sample.value);
    outputs.push_back(sample.value);
  }
  return outputs;
}

/// `count` + 1 times from 0 on.
template <typename Scalar>
std::vector<Scalar> regular_times(Scalar interval, int count) {
  std::vector<Scalar> times;
  for (int i = 0; i <= count; ++i) times.push_back(interval * static_cast<Scalar>(i));
  return times;
}

}  // namespace splinertia::testing
