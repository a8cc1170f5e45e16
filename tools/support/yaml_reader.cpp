// SPDX-License-Identifier: MIT
#include "support/yaml_reader.hpp"

#include <yaml-cpp/yaml.h>
#include <cmath>

#include <algorithm>
#include <fstream>
#include <map>
#include <splinertia/units.hpp>
#include <stdexcept>
#include <utility>

#include "support/concat.hpp"
#include "support/yaml_text.hpp"

namespace {

const std::map<std::string, double>& known_units() {
  namespace units = splinertia::units;
  static const std::map<std::string, double> table{{"%", units::percent},
                                                   {"ppm", units::ppm},
                                                   {"deg", units::degree},
                                                   {"mrad", units::milliradian},
                                                   {"deg/s", units::degree_per_second},
                                                   {"deg/h", units::degree_per_hour},
                                                   {"deg/sqrt(h)", units::degree_per_root_hour},
                                                   {"deg/s/sqrt(Hz)", units::degree_per_second_per_root_hertz},
                                                   {"mdeg/s/sqrt(Hz)", units::milli_degree_per_second_per_root_hertz},
                                                   {"deg/h/sqrt(Hz)", units::degree_per_hour_per_root_hertz},
                                                   {"deg/h/sqrt(h)", units::degree_per_hour_per_root_hour},
                                                   {"deg/s/g", units::degree_per_second_per_g},
                                                   {"deg/h/g", units::degree_per_hour_per_g},
                                                   {"g", units::standard_g},
                                                   {"mg", units::milli_g},
                                                   {"ug", units::micro_g},
                                                   {"m/s/sqrt(h)", units::meter_per_second_per_root_hour},
                                                   {"mg/sqrt(Hz)", units::milli_g_per_root_hertz},
                                                   {"ug/sqrt(Hz)", units::micro_g_per_root_hertz},
                                                   {"ug/sqrt(h)", units::micro_g_per_root_hour},
                                                   {"ms", 1e-3},
                                                   {"us", 1e-6},
                                                   {"h", units::hour},
                                                   {"kHz", 1e3}};
  return table;
}

template <typename Table>
std::string names(const Table& table) {
  std::string text;
  for (const auto& [name, value] : table) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

YamlReader YamlReader::open(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(concat(path.string(), ": cannot read this file"));
  }
  try {
    return YamlReader(path, YAML::Load(file));
  } catch (const YAML::ParserException& error) {
    throw std::runtime_error(concat(path.string(), ':', error.mark.line + 1, ": not YAML: ", escaped_line(error.msg)));
  }
}

YamlReader::YamlReader(std::filesystem::path path, const YAML::Node& node)
    : path_(std::move(path)), node_(std::make_shared<YAML::Node>(node)) {}

void YamlReader::fail(const std::string& what) const {
  const YAML::Mark mark = node_->Mark();
  const std::string line = escaped_line(what);  // text from the file may contain control characters
  throw std::runtime_error(mark.is_null() ? concat(path_.string(), ": ", line)
                                          : concat(path_.string(), ':', mark.line + 1, ": ", line));
}

bool YamlReader::is_map() const { return node_->IsMap(); }
bool YamlReader::is_list() const { return node_->IsSequence(); }
bool YamlReader::has(const std::string& key) const {
  if (!is_map()) return false;
  int count = 0;
  for (const auto& entry : *node_) {
    const bool found = entry.first.IsScalar() && entry.first.Scalar() == key;
    if (found && ++count > 1) YamlReader(path_, entry.first).fail(concat(key, " is given twice, expected it once"));
  }
  return count == 1;
}

YamlReader YamlReader::operator[](const std::string& key) const {
  if (!has(key)) fail(concat("no ", key, ", expected one"));
  return {path_, (*node_)[key]};
}

std::vector<std::string> YamlReader::keys() const {
  if (!is_map()) fail("expected a map, `key: value`");
  std::vector<std::string> result;
  for (const auto& entry : *node_) {
    const std::string key = YamlReader(path_, entry.first).text();
    if (std::find(result.begin(), result.end(), key) != result.end()) {
      YamlReader(path_, entry.first).fail(concat(key, " is given twice"));
    }
    result.push_back(key);
  }
  return result;
}

std::vector<YamlReader> YamlReader::elements() const {
  if (!is_list()) fail("expected a list");
  std::vector<YamlReader> result;
  for (const auto& element : *node_) result.emplace_back(path_, element);
  return result;
}

std::string YamlReader::text() const {
  if (!node_->IsScalar()) fail("expected a single value");
  return node_->Scalar();
}

double YamlReader::number() const {
  const std::string all = text();
  const auto space = all.find(' ');
  const auto unit_at = space == std::string::npos ? all.size() : all.find_first_not_of(' ', space);
  double value = 0;
  if (!YAML::convert<double>::decode(YAML::Node(all.substr(0, space)), value)) {
    fail(concat(all, " is not a number"));
  }
  if (!std::isfinite(value)) fail(concat(all, ", expected a finite number"));
  if (unit_at >= all.size()) return value;
  const auto unit = known_units().find(all.substr(unit_at));
  if (unit == known_units().end()) {
    fail(concat(all, ": unknown unit ", all.substr(unit_at), ", expected none (SI) or one of ", names(known_units())));
  }
  return value * unit->second;
}

splinertia::PerAxis<double> YamlReader::per_axis() const {
  if (!is_list()) return number();
  const auto axes = elements();
  if (axes.size() != 3) fail(concat(axes.size(), " numbers, expected one, or one for each of 3 axes"));
  return {axes[0].number(), axes[1].number(), axes[2].number()};
}

Eigen::Matrix3d YamlReader::matrix() const {
  if (!is_list()) return Eigen::Matrix3d(number() * Eigen::Matrix3d::Identity());
  const auto rows = elements();
  if (rows.size() != 3) fail(concat(rows.size(), " rows, expected 3 of 3 numbers"));
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    const auto columns = row.elements();
    if (columns.size() != 3) row.fail(concat(columns.size(), " numbers in a row, expected 3"));
    for (int j = 0; j < 3; ++j) m(i, j) = columns[static_cast<std::size_t>(j)].number();
  }
  return m;
}

void YamlReader::expect_only(const std::set<std::string>& known) const {
  for (const std::string& key : keys()) {
    if (known.count(key) != 0) continue;
    std::string expected;
    for (const std::string& name : known) expected += (expected.empty() ? "" : ", ") + name;
    fail(concat("unknown ", key, ", expected ", expected));
  }
}
