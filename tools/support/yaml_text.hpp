// SPDX-License-Identifier: MIT
// The text of values and comments in YAML files. All readers must read it alike: YAML 1.1 (PyYAML, which Kalibr uses),
// YAML 1.2 and OpenCV's FileStorage.
#pragma once

#include <string>
#include <string_view>

/// Text on one line: each byte of control characters, line and paragraph separators and invalid UTF-8 becomes \n, \t,
/// \r or \xNN. A comment with any file name in it therefore stays on its line.
[[nodiscard]] std::string escaped_line(std::string_view text);

/// Text as a value: without quotation marks if it looks like the name of a ROS topic (/imu0), else with them.
[[nodiscard]] std::string yaml_string(std::string_view text);

/// A finite number with the fewest digits that read back to the same bits, and always with a decimal point, because
/// YAML 1.1 reads 5e-05 as text, and FileStorage reads 1 as an integer.
[[nodiscard]] std::string yaml_number(double value);
