// SPDX-License-Identifier: MIT
#include "support/imu_log_columns.hpp"

#include <algorithm>
#include <cstdint>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "support/concat.hpp"
#include "support/imu_log_stamps.hpp"
#include "support/progress.hpp"
#include "support/python_script.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

constexpr std::size_t unused = imu_column_names.size();
constexpr std::string_view topic_comment = "#topic ";  // imu_bag.py --name-topic

/// Reads the rows of a table.
class ColumnReader {
 public:
  explicit ColumnReader(const ImuTable& table) : table_(table) {
    for (const std::string& name : table.columns) {
      const auto found = std::find(imu_column_names.begin(), imu_column_names.end(), name);
      const auto place = static_cast<std::size_t>(found - imu_column_names.begin());
      if (place == unused && name != "-") {
        throw std::invalid_argument(concat(table.columns_option, ": ", excerpt(name),
                                           ", expected t, gx, gy, gz, ax, ay, az, or - for a column to ignore"));
      }
      if (place != unused && std::find(places_.begin(), places_.end(), place) != places_.end()) {
        throw std::invalid_argument(concat(table.columns_option, ": ", name, " is given twice, expected each once"));
      }
      if (place == 0) time_column_ = places_.size();
      places_.push_back(place);
      names_ += (names_.empty() ? "" : ",") + name;
      names_without_time_ += (names_without_time_.empty() ? "" : ",") + (name == "t" ? "-" : name);
    }
    if (std::all_of(places_.begin(), places_.end(), [](std::size_t place) { return place == 0 || place == unused; })) {
      throw std::invalid_argument(
          concat(table.columns_option, ": ", names_, ", expected at least one of gx, gy, gz, ax, ay, az"));
    }
    if (time_column_ && table.rate) {
      throw std::invalid_argument(
          concat(table.rate_option, ": the log has times (column t), expected only one of the two"));
    }
    if (!time_column_ && !table.rate) {
      throw std::invalid_argument(
          concat(table.columns_option, ": ", names_, ", expected t among them, or ", table.rate_option));
    }
  }

  /// Infers the unit of the stamps from the first ones, unless it is given.
  void choose_unit(ImuColumns& columns) const {
    columns.time_unit = table_.time_unit.value_or(table_.usual_time_unit.value_or(TimeUnit::seconds));
    std::error_code error;
    if (!time_column_ || table_.time_unit || !std::filesystem::is_regular_file(table_.path, error)) return;
    constexpr std::size_t enough = 1000;
    TextFile file(table_.path);
    std::vector<std::string> stamps;
    std::vector<std::string_view> fields;
    while (stamps.size() < enough && file.next()) {
      split_fields(file.line(), fields);
      if (fields.size() == places_.size()) stamps.emplace_back(fields[*time_column_]);
    }
    const StampUnit chosen = choose_stamp_unit(stamps, table_.usual_time_unit, table_.path.string());
    columns.time_unit = chosen.unit;
    columns.unit_note = chosen.note;
  }

  void read(TextFile& file, ImuColumns& columns, std::optional<Progress>& progress) const {
    std::vector<std::string_view> fields;
    bool may_be_names = true;
    while (file.next_or_comment()) {
      if (progress) progress->advance(file.line().size() + 1);
      if (file.line().starts_with('#')) {
        if (file.line().starts_with(topic_comment)) columns.topic = file.line().substr(topic_comment.size());
        continue;
      }
      split_fields(file.line(), fields);
      if (fields.size() != places_.size()) {
        file.fail(fields.size(), fields.size() == 1 ? " column" : " columns", ", expected ", places_.size(), ": ",
                  names_, columns.rows == 0 ? " (" + table_.columns_option + ")" : "");
      }
      if (std::exchange(may_be_names, false) && std::all_of(fields.begin(), fields.end(), is_name)) continue;
      if (time_column_ && !add_time(file, fields[*time_column_], columns)) continue;
      for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::size_t place = places_[i];
        if (place == 0 || place == unused) continue;
        const Parsed<double> number = parse_real(fields[i]);
        if (number.problem) {
          file.fail(excerpt(fields[i]), ' ', number.problem, ", expected ", imu_column_names[place], " in column ",
                    i + 1);
        }
        columns.values[place].push_back(number.value);
      }
      ++columns.rows;
    }
  }

  [[noreturn]] void refuse_empty(const TextFile& file) const { file.fail("no samples, expected lines of ", names_); }

 private:
  /// Whether a field is a column name: not a number, and not nan or inf, which mark a lost reading.
  static bool is_name(std::string_view text) {
    std::string lower(text.substr(0, 4));
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
    const std::string_view unsigned_text = std::string_view(lower).substr(lower.starts_with('-') ? 1 : 0);
    return parse_real(text).problem != nullptr && !unsigned_text.empty() && unsigned_text != "nan" &&
           unsigned_text != "inf";
  }

  /// Returns false if the row is a duplicate, which is dropped.
  bool add_time(const TextFile& file, std::string_view field, ImuColumns& columns) const {
    const std::string_view unit = time_unit_name(columns.time_unit);
    const Parsed<nanoseconds> time = parse_time(field, static_cast<int>(columns.time_unit));
    if (time.problem) {
      file.fail(excerpt(field), ' ', time.problem, ", expected t [", unit, "] (--time-unit) in column ",
                *time_column_ + 1);
    }
    std::vector<nanoseconds>& times = columns.times;
    if (!times.empty() && time.value == times.back()) {
      if (table_.drop_duplicates) {
        ++columns.duplicates;
        return false;
      }
      file.fail("time ", field, ' ', unit, " follows ", times.back().count(),
                " ns, expected increasing times: --drop-duplicates leaves out such rows; or ignore the times: ",
                table_.columns_option, "=", names_without_time_, ' ', table_.rate_option, " HZ");
    }
    if (!times.empty() && time.value < times.back()) {
      file.fail("time ", field, ' ', unit, " follows ", times.back().count(), " ns, expected increasing times");
    }
    times.push_back(time.value);
    return true;
  }

  const ImuTable& table_;
  std::vector<std::size_t> places_;  // of each column in imu_column_names
  std::optional<std::size_t> time_column_;
  std::string names_, names_without_time_;
};

}  // namespace

void ImuColumns::erase(std::size_t first, std::size_t last) {
  const auto erase_from = [&](auto& list) {
    if (list.empty()) return;
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(first), list.begin() + static_cast<std::ptrdiff_t>(last));
  };
  erase_from(times);
  for (auto& list : values) erase_from(list);
  rows -= last - first;
}

ImuColumns read_imu_columns(const ImuTable& table) {
  ImuColumns columns;
  std::optional<Progress> progress;
  const ColumnReader reader(table);
  if (is_ros_bag(table.path)) {
    std::vector<std::string> arguments{"to-csv", table.path.string(), "-", "--name-topic"};
    if (table.drop_duplicates) arguments.emplace_back("--keep-duplicates");
    if (table.topic) arguments.insert(arguments.end(), {"--topic", *table.topic});
    PythonScript script(table.python, "imu_bag.py", arguments, PythonScript::Output::piped);
    TextFile file(script.output());
    reader.read(file, columns, progress);
    script.finish();
  } else {
    TextFile file(table.path);
    std::error_code no_size;
    const auto size = std::filesystem::file_size(table.path, no_size);
    if (!no_size && size > 0) progress.emplace(size);
    reader.choose_unit(columns);
    reader.read(file, columns, progress);
    if (columns.rows == 0) reader.refuse_empty(file);
  }
  return columns;
}
