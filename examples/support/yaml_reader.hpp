// SPDX-License-Identifier: MIT
// Reading YAML strictly: every error says file, line, what was found and what was expected; what is not understood is
// an error, too.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <set>
#include <splinertia/errors/per_axis.hpp>
#include <string>
#include <vector>

namespace YAML {
class Node;
}

/// A place in a YAML file.
class YamlReader {
 public:
  /// Throws std::runtime_error if the file cannot be read or is no YAML.
  static YamlReader open(const std::filesystem::path& path);

  YamlReader(std::filesystem::path path, const YAML::Node& node);

  [[nodiscard]] bool is_map() const;
  [[nodiscard]] bool is_list() const;
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] YamlReader operator[](const std::string& key) const;  ///< throws std::runtime_error if it is not there
  [[nodiscard]] std::vector<std::string> keys() const;                ///< of a map
  [[nodiscard]] std::vector<YamlReader> elements() const;             ///< of a list

  [[nodiscard]] std::string text() const;
  /// A number, or a number and one of the units of IMU data sheets: "0.66 deg/sqrt(h)". SI.
  [[nodiscard]] double number() const;
  /// A number, or a list of three.
  [[nodiscard]] splinertia::PerAxis<double> per_axis() const;
  /// Three lists of three numbers, or a number that stands for as much of the identity.
  [[nodiscard]] Eigen::Matrix3d matrix() const;

  /// Throws std::runtime_error if the map has other keys.
  void expect_only(const std::set<std::string>& known) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::filesystem::path path_;
  std::shared_ptr<YAML::Node> node_;
};
