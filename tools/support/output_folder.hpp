// SPDX-License-Identifier: MIT
// The folder for the output files of a run.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <splinertia/io/file_set.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "support/inputs.hpp"

/// A folder that a program writes a set of files to. Other files in it stay. The hidden file .PROGRAM.files lists what
/// the program has written there. A run removes the files of earlier runs that it does not write itself. It neither
/// replaces nor removes its inputs.
class OutputFolder {
 public:
  /// The folder is created by the first call of path(name).
  OutputFolder(std::filesystem::path folder, std::string_view program, const Inputs& inputs);

  /// Checks names of output files before the long work: throws std::invalid_argument if the run reads one of them.
  void expect_no_inputs(std::initializer_list<std::string_view> names) const;

  /// The path for an output file. Its writer commits the file to files(). Throws std::invalid_argument if the run reads
  /// that file, std::runtime_error if the folder cannot be created.
  [[nodiscard]] std::filesystem::path path(std::string_view name);

  /// Announces NAME.png and NAME.svg, which a script draws after commit(). Those of an earlier run are removed. Throws
  /// std::invalid_argument if the run reads one of them.
  void expect_pictures(const std::string& name) {
    expect_no_inputs({name + ".png", name + ".svg"});
    for (const char* form : {".png", ".svg"}) expected_.push_back(name + form);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] splinertia::FileSet& files() { return files_; }

  /// Puts the files in place and returns their names: "imu.csv, groundtruth.csv and poses.tum". Other runs of the
  /// program wait for each other. Prints on standard error which files of earlier runs stay because they have been
  /// changed or are inputs.
  [[nodiscard]] std::string commit();

 private:
  [[nodiscard]] std::string list_and_remove_left_over();

  std::filesystem::path folder_, list_;
  std::string program_;
  std::vector<std::string> names_, expected_;
  splinertia::FileSet files_;
};
