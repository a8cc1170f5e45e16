// SPDX-License-Identifier: MIT
// Any bytes as a EuRoC IMU file. What is read survives .npy, too.
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>

#include "fuzz/samples.hpp"

namespace {

using namespace splinertia;

const fuzz::Target target{"euroc_imu", [](fuzz::Input input) {
                            static fuzz::InputBytes file("imu.csv");
                            const auto read = [](const auto& path) { return read_euroc_imu(path); };
                            fuzz::expect_round_trip(file.with(input.rest()), read,
                                                    [](const auto& path, const auto& samples) {
                                                      write_npy_imu(path, samples);
                                                      fuzz::expect_same(samples, read_npy_imu(path));
                                                      write_euroc_imu(path, samples);
                                                    });
                          }};

}  // namespace
