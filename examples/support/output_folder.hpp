// SPDX-License-Identifier: MIT
// Where the programs put the files of a run.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <splinertia/io/file_set.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "support/inputs.hpp"

/// A folder that a program writes a set of files to; what else is in it stays. The hidden file .PROGRAM.files lists
/// what the program has written there, so that a run removes what an earlier one has left and it does not write itself.
/// What the run reads it neither replaces nor removes.
class OutputFolder {
 public:
  /// The folder is made when the first path is asked for.
  OutputFolder(std::filesystem::path folder, std::string_view program, const Inputs& inputs);

  /// For what is going to be written, before the long work: throws std::invalid_argument if the run reads such a file.
  void expect_no_inputs(std::initializer_list<std::string_view> names) const;

  /// Where this run writes the file of this name. Its writer commits it to files(). Throws std::invalid_argument if the
  /// run reads that file, std::runtime_error if the folder cannot be made.
  [[nodiscard]] std::filesystem::path path(std::string_view name);

  /// NAME.png and NAME.svg, which a script draws after commit(). Those of an earlier run are removed. Throws as path().
  void expect_pictures(const std::string& name) {
    expect_no_inputs({name + ".png", name + ".svg"});
    for (const char* form : {".png", ".svg"}) expected_.push_back(name + form);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] splinertia::FileSet& files() { return files_; }

  /// Puts the files in place and returns their names: "imu.csv, groundtruth.csv and poses.tum". Other runs of the
  /// program wait for each other. Says on standard error which files of earlier runs stay because they have been
  /// changed or are read.
  [[nodiscard]] std::string commit();

 private:
  [[nodiscard]] std::string list_and_remove_left_over();

  std::filesystem::path folder_, list_;
  std::string program_;
  std::vector<std::string> names_, expected_;
  splinertia::FileSet files_;
};
