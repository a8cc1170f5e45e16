// SPDX-License-Identifier: MIT
// Any bytes as a file of error terms. What is read can be described and simulated.
#include "support/error_yaml.hpp"

#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/circle.hpp>
#include <string>

#include "fuzz/files.hpp"

namespace splinertia::fuzz::error_yaml_target {

const Target target{
    "error_yaml", [](Input input) {
      static InputBytes file("errors.yaml");
      AnyImu imu;
      const std::string& path = file.with(input.rest());
      if (!accepted(path, [&] { imu = read_error_yaml(path); })) return;
      expect(!describe(imu.gyro, SensorKind::gyro).empty() && !describe(imu.accel, SensorKind::accel).empty(),
             "no description");
      // Numbers of any size may overflow: only what is refused is looked at.
      (void)accepted("", [&] {
        for (const auto& reading : simulate(Circle<>{}, imu, {.rate = 100, .start = 0, .end = 0.05})) {
          (void)reading;
        }
      });
    }};

}  // namespace splinertia::fuzz::error_yaml_target
