// SPDX-License-Identifier: MIT
// Any bytes as IMU samples in a NumPy file.
#include <splinertia/io/npy_imu.hpp>

#include "fuzz/samples.hpp"

namespace splinertia::fuzz::npy_imu_target {

const Target target{"npy_imu", [](Input input) {
                      static InputBytes file("imu.npy");
                      expect_round_trip(
                          file.with(input.rest()), [](const auto& path) { return read_npy_imu(path); },
                          [](const auto& path, const auto& samples) { write_npy_imu(path, samples); });
                    }};

}  // namespace splinertia::fuzz::npy_imu_target
