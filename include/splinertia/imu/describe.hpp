// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/errors/describe.hpp>
#include <splinertia/imu/imu.hpp>
#include <string>

namespace splinertia {

/// All errors of an IMU, one line per term.
template <typename Gyro, typename Accel, typename Stamps>
[[nodiscard]] std::string describe(const Imu<Gyro, Accel, Stamps>& imu) {
  const auto indented = [](const char* title, std::string lines) {
    std::string text = title;
    text += ":\n";
    while (!lines.empty()) {
      const std::size_t end = lines.find('\n') + 1;
      text += "  " + lines.substr(0, end);
      lines.erase(0, end);
    }
    return text;
  };
  return indented("gyro", describe(imu.gyro, SensorKind::gyro)) +
         indented("accel", describe(imu.accel, SensorKind::accel)) +
         indented("stamps", describe(imu.stamps, SensorKind::clock));
}

}  // namespace splinertia
