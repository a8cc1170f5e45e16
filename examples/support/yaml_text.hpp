// SPDX-License-Identifier: MIT
// Parts of YAML files as they are written. Every reader must take them for what they are: YAML 1.1 (PyYAML, and with it
// Kalibr), 1.2 and OpenCV's FileStorage.
#pragma once

#include <string>
#include <string_view>

/// One line of text: control characters, line and paragraph separators and bytes that are not UTF-8 become \n, \t, \r
/// or \xNN, a byte each. Whatever a file name contains, a comment with it ends where its line ends.
[[nodiscard]] std::string escaped_line(std::string_view text);

/// A text as a value: as it is if it looks like the name of a ROS topic (/imu0), else quoted.
[[nodiscard]] std::string yaml_string(std::string_view text);

/// A finite number with as few digits as read back to the same bits, and always with a decimal point: YAML 1.1 takes
/// 5e-05 for a text, FileStorage takes 1 for an integer.
[[nodiscard]] std::string yaml_number(double value);
