// SPDX-License-Identifier: MIT
// The Python scripts that lie beside the programs: ROS bags and plots are Python's.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/exit_code.hpp"

/// Which Python: the environment variable SPLINERTIA_PYTHON, or python3.
[[nodiscard]] std::string default_python();

/// Whether a path is that of a ROS bag, by its ending: .bag, .mcap, .db3; or it is a folder.
[[nodiscard]] bool is_ros_bag(const std::filesystem::path& path);

/// A script that has said on standard error, in one line, what is wrong.
struct ScriptFailed : AlreadyReported {
  using AlreadyReported::AlreadyReported;
};

/// A script that runs beside this program. No shell is between, so that no argument means anything but itself.
class PythonScript {
 public:
  /// Starts examples/support/NAME.py, which the build puts beside the executable. Throws std::runtime_error if Python
  /// cannot be run. Standard error is shared; standard output is read from output(), or goes where ours goes.
  enum class Output { piped, shared };
  PythonScript(const std::string& python, const std::string& name, const std::vector<std::string>& arguments,
               Output output);
  PythonScript(const PythonScript&) = delete;
  PythonScript& operator=(const PythonScript&) = delete;
  ~PythonScript();

  /// Where the standard output of the script can be read, once.
  [[nodiscard]] std::filesystem::path output() const;

  /// Waits until it has ended. Throws ScriptFailed if it has refused its input (exit code 2), std::runtime_error if it
  /// has failed otherwise.
  void finish();

 private:
  std::string name_;
  pid_t process_ = -1;
  int pipe_ = -1;
};
