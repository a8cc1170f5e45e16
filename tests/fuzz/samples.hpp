// SPDX-License-Identifier: MIT
/// Oracles on what readers give: finite, increasing, and the same when it is written and read again.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <splinertia/group/pose.hpp>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/number_text.hpp>
#include <vector>

#include "fuzz/files.hpp"
#include "fuzz/fuzz.hpp"

namespace splinertia::fuzz {

using namespace splinertia::detail;

inline void expect_finite(const auto& vector, const char* what) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) expect(has_finite_bits(vector[i]), what, " has ", vector[i]);
}

inline void expect_same(const auto& a, const auto& b, const char* what) {
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    expect(std::bit_cast<std::uint64_t>(a[i]) == std::bit_cast<std::uint64_t>(b[i]), what, " is ", b[i], ", was ",
           a[i]);
  }
}

inline void expect_rotation(const Sophus::SO3d& R) {
  const Eigen::Vector4d q = R.unit_quaternion().coeffs();
  expect_finite(q, "rotation");
  expect(std::abs(q.norm() - 1) <= 1e-12, "a rotation of norm ", q.norm());
}

/// Calls visit(name, vector) for each vector of a sample.
void for_each_vector(const Stamped<SO3xR3<double>>& sample, const auto& visit) {
  visit("rotation", rotation(sample.value).unit_quaternion().coeffs());
  visit("position", position(sample.value));
}
void for_each_vector(const ImuSample<double, std::chrono::nanoseconds>& sample, const auto& visit) {
  visit("gyro", sample.gyro);
  visit("accel", sample.accel);
}
void for_each_vector(const EurocState& sample, const auto& visit) {
  visit("rotation", rotation(sample.value).unit_quaternion().coeffs());
  visit("position", position(sample.value));
  visit("velocity", sample.velocity);
  visit("gyro_bias", sample.gyro_bias);
  visit("accel_bias", sample.accel_bias);
}

/// At least one sample, all numbers finite, times increasing.
template <typename Sample>
void expect_sane(const std::vector<Sample>& samples) {
  expect(!samples.empty(), "nothing was read, and nothing refused");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    expect(i == 0 || samples[i].time > samples[i - 1].time, "times do not increase at ", i);
    for_each_vector(samples[i], [](const char* name, const auto& vector) {
      expect_finite(vector, name);
      if (std::string_view(name) == "rotation") {
        expect(std::abs(vector.norm() - 1) <= 1e-12, "a rotation of norm ", vector.norm());
      }
    });
  }
}

/// The same to the bit.
template <typename Sample>
void expect_same(const std::vector<Sample>& before, const std::vector<Sample>& after) {
  expect(before.size() == after.size(), before.size(), " samples became ", after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    expect(before[i].time == after[i].time, "a time has changed");
    std::vector<double> numbers;
    for_each_vector(before[i], [&](const char*, const auto& v) { numbers.insert(numbers.end(), v.begin(), v.end()); });
    auto number = numbers.begin();
    for_each_vector(after[i], [&](const char* name, const auto& v) {
      for (const double x : v) {
        expect(std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(*number), name, " of ", i, " is ", x,
               ", was ", *number);
        ++number;
      }
    });
  }
}

/// What a reader makes of a file is sane and survives being written and read again.
void expect_round_trip(const std::string& path, const auto& read, const auto& write) {
  decltype(read(path)) samples;
  if (!accepted(path, [&] { samples = read(path); })) return;
  expect_sane(samples);
  const std::string copy = output_path();
  write(copy, samples);
  expect_same(samples, read(copy));
}

}  // namespace splinertia::fuzz
