// SPDX-License-Identifier: MIT
// Any numbers to the writers: refused, or read back to the same bits.
#include <cmath>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>
#include <splinertia/io/tum.hpp>

#include "fuzz/samples.hpp"

namespace splinertia::fuzz::writers_target {

Eigen::Vector3d vector(Input& input) {
  Eigen::Vector3d result;
  for (double& x : result) x = input.real();
  return result;
}

/// What is written is there; what is refused is not.
template <typename Sample>
void expect_written(const std::vector<Sample>& samples, const auto& write, const auto& read) {
  const std::string path = output_path();
  std::filesystem::remove(path);
  if (accepted(path, [&] { write(path, samples); })) {
    expect_same(samples, read(path));
  } else {
    expect(!std::filesystem::exists(path), "a file that was refused is there");
  }
}

const Target target{
    "writers", [](Input input) {
      std::vector<EurocState> states;
      std::vector<ImuSample<double, std::chrono::nanoseconds>> samples;
      std::vector<Stamped<SO3xR3<double>>> poses;
      std::chrono::nanoseconds time{input.bits<std::int64_t>()};
      Eigen::Vector4d before = Eigen::Vector4d::Zero();
      while (!input.empty() && states.size() < 20) {
        // A rotation whose sign is nearer to the one before, which is how readers give it.
        const Eigen::Vector3d axis(input.moderate(1), input.moderate(1), input.moderate(1));
        Eigen::Vector4d q;
        q << axis, 1;
        q.normalize();
        if (q.dot(before) < 0) q = -q;
        before = q;
        const SO3xR3<double> pose{rotation_from_unit_quaternion<double>(Eigen::Quaterniond{q}), vector(input)};
        states.push_back({{time, pose}, vector(input), vector(input), vector(input)});
        samples.push_back({time, states.back().velocity, states.back().gyro_bias});
        poses.push_back({time, pose});
        time = std::chrono::nanoseconds{static_cast<std::int64_t>(
            static_cast<std::uint64_t>(time.count()) + input.bits<std::uint32_t>() + (input.flag() ? 1U : 0U))};
      }
      expect_written(
          states, [](const auto& path, const auto& all) { write_euroc_groundtruth(path, all); },
          [](const auto& path) { return read_euroc_groundtruth(path); });
      expect_written(
          samples, [](const auto& path, const auto& all) { write_euroc_imu(path, all); },
          [](const auto& path) { return read_euroc_imu(path); });
      expect_written(
          samples, [](const auto& path, const auto& all) { write_npy_imu(path, all); },
          [](const auto& path) { return read_npy_imu(path); });
      expect_written(
          poses, [](const auto& path, const auto& all) { write_tum(path, all); },
          [](const auto& path) { return read_tum(path); });
    }};

}  // namespace splinertia::fuzz::writers_target
