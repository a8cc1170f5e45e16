// SPDX-License-Identifier: MIT
// A strict reader of YAML: every error has the file, the line, what was found and what was expected. Unknown entries
// are errors, too.
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
  /// Throws std::runtime_error if the file cannot be read or is not YAML.
  static YamlReader open(const std::filesystem::path& path);

  YamlReader(std::filesystem::path path, const YAML::Node& node);

  [[nodiscard]] bool is_map() const;
  [[nodiscard]] bool is_list() const;
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] YamlReader operator[](const std::string& key) const;  ///< throws std::runtime_error if there is none
  [[nodiscard]] std::vector<std::string> keys() const;                ///< of a map
  [[nodiscard]] std::vector<YamlReader> elements() const;             ///< of a list

  [[nodiscard]] std::string text() const;
  /// A number in SI units, converted if one of the units of IMU data sheets follows: "0.66 deg/sqrt(h)".
  [[nodiscard]] double number() const;
  /// A number, or a list of three.
  [[nodiscard]] splinertia::PerAxis<double> per_axis() const;
  /// Three lists of three numbers, or a number, which multiplies the identity.
  [[nodiscard]] Eigen::Matrix3d matrix() const;

  /// Throws std::runtime_error if the map has other keys.
  void expect_only(const std::set<std::string>& known) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::filesystem::path path_;
  std::shared_ptr<YAML::Node> node_;
};
