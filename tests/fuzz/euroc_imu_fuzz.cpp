// SPDX-License-Identifier: MIT
// Any bytes as a EuRoC IMU file. What is read survives .npy, too.
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>

#include "fuzz/samples.hpp"

namespace splinertia::fuzz::euroc_imu_target {

const Target target{"euroc_imu", [](Input input) {
                      static InputBytes file("imu.csv");
                      const auto read = [](const auto& path) { return read_euroc_imu(path); };
                      expect_round_trip(file.with(input.rest()), read, [](const auto& path, const auto& samples) {
                        write_npy_imu(path, samples);
                        expect_same(samples, read_npy_imu(path));
                        write_euroc_imu(path, samples);
                      });
                    }};

}  // namespace splinertia::fuzz::euroc_imu_target
