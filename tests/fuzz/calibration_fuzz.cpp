// SPDX-License-Identifier: MIT
// Any bytes as a calibration file.
#include <string>

#include "fuzz/files.hpp"
#include "support/calibration_file.hpp"

namespace splinertia::fuzz::calibration_target {

const Target target{"calibration", [](Input input) {
                      static InputBytes file("calibration.yaml"), copy("copy.yaml");
                      CalibratedImu<double> imu;
                      const std::string& path = file.with(input.rest());
                      if (!accepted(path, [&] { imu = read_calibration(path); })) return;
                      // The text has all numbers to the bit.
                      const std::string text = calibration_text(imu);
                      expect(calibration_text(read_calibration(copy.with(text))) == text, "it has changed");
                    }};

}  // namespace splinertia::fuzz::calibration_target
