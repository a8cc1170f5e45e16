// SPDX-License-Identifier: MIT
// Any bytes as a calibration file.
#include <string>

#include "fuzz/files.hpp"
#include "support/calibration_file.hpp"

namespace {

using namespace splinertia;

const fuzz::Target target{"calibration", [](fuzz::Input input) {
                            static fuzz::InputBytes file("calibration.yaml"), copy("copy.yaml");
                            CalibratedImu<double> imu;
                            const std::string& path = file.with(input.rest());
                            if (!fuzz::accepted(path, [&] { imu = read_calibration(path); })) return;
                            // The text has all numbers to the bit.
                            const std::string text = calibration_text(imu);
                            fuzz::expect(calibration_text(read_calibration(copy.with(text))) == text, "it has changed");
                          }};

}  // namespace
