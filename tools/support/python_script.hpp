// SPDX-License-Identifier: MIT
// Runs the Python scripts beside the programs, which read ROS bags and draw plots.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/exit_code.hpp"

/// The Python interpreter: the environment variable SPLINERTIA_PYTHON, or python3.
[[nodiscard]] std::string default_python();

/// Whether a path is a ROS bag: it ends in .bag, .mcap or .db3, or is a folder.
[[nodiscard]] bool is_ros_bag(const std::filesystem::path& path);

/// A script has failed and has printed the reason on standard error, in one line.
struct ScriptFailed : AlreadyReported {
  using AlreadyReported::AlreadyReported;
};

/// A script that runs beside this program. It is started without a shell, so no character of an argument is special.
class PythonScript {
 public:
  /// Starts tools/support/NAME.py, which the build puts beside the executable. Throws std::runtime_error if Python
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

/// Draws FOLDER/NAME.png and .svg from the files in the folder, by the script plot_NAME.py. The plot is optional: if it
/// fails, the reason is printed on standard error.
void draw_plot(const std::string& python, const std::string& name, const std::filesystem::path& folder);
