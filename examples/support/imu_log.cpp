// SPDX-License-Identifier: MIT
#include "support/imu_log.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <splinertia/allan/stillness.hpp>
#include <splinertia/allan/unit_check.hpp>
#include <splinertia/imu/error_term.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/message.hpp>
#include <splinertia/require.hpp>
#include <splinertia/units.hpp>
#include <stdexcept>
#include <utility>

#include "support/progress.hpp"
#include "support/python_script.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

constexpr std::array<std::string_view, 7> column_names{"t", "gx", "gy", "gz", "ax", "ay", "az"};
constexpr std::size_t unused = column_names.size();

/// What is in a file: by column_names, those that it lacks stay empty.
struct Columns {
  std::vector<nanoseconds> times;
  std::array<std::vector<double>, column_names.size()> values;  // the first is unused
  std::size_t rows = 0;
};

/// The powers of ten that are a second.
const std::map<std::string, int> time_units{{"s", 0}, {"ms", 3}, {"us", 6}, {"ns", 9}};

/// Reads the rows of a table.
class ColumnReader {
 public:
  explicit ColumnReader(const ImuLogOptions& options) {
    std::vector<std::string> names = options.columns;
    if (names.empty()) names.assign(column_names.begin() + (options.rate ? 1 : 0), column_names.end());
    for (const std::string& name : names) {
      const auto found = std::find(column_names.begin(), column_names.end(), name);
      const auto place = static_cast<std::size_t>(found - column_names.begin());
      if (place == unused && name != "-") {
        throw std::invalid_argument(
            message("--columns: ", excerpt(name), ", expected t, gx, gy, gz, ax, ay, az, or - for what is not wanted"));
      }
      if (place != unused && std::find(places_.begin(), places_.end(), place) != places_.end()) {
        throw std::invalid_argument(message("--columns: ", name, " is there twice, expected each once"));
      }
      places_.push_back(place);
      names_ += (names_.empty() ? "" : ",") + name;
    }
    const bool has_time = std::find(places_.begin(), places_.end(), 0) != places_.end();
    if (std::all_of(places_.begin(), places_.end(), [](std::size_t place) { return place == 0 || place == unused; })) {
      throw std::invalid_argument(message("--columns: ", names_, ", expected at least one of gx, gy, gz, ax, ay, az"));
    }
    if (has_time && options.rate) {
      throw std::invalid_argument(message("--rate: the log has times (column t), expected one of them"));
    }
    if (!has_time && !options.rate) {
      throw std::invalid_argument(message("--columns: ", names_, ", expected t among them, or --rate"));
    }
    time_unit_ = options.time_unit.value_or(options.columns.empty() ? "ns" : "s");
    time_digits_ = time_units.at(time_unit_);
  }

  void read(TextFile& file, Columns& columns, std::optional<Progress>& progress) const {
    std::vector<std::string_view> fields;
    bool may_be_names = true;
    while (file.next()) {
      if (progress) progress->advance(file.line().size() + 1);
      split_fields(file.line(), fields);
      if (fields.size() != places_.size()) {
        file.fail(fields.size(), fields.size() == 1 ? " column" : " columns", ", expected ", places_.size(), ": ",
                  names_, columns.rows == 0 ? " (--columns)" : "");
      }
      if (std::exchange(may_be_names, false) && std::all_of(fields.begin(), fields.end(), is_name)) continue;
      for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::size_t place = places_[i];
        if (place == 0) {
          add_time(file, fields[i], columns.times);
        } else if (place != unused) {
          const Parsed<double> number = parse_real(fields[i]);
          if (number.problem) refuse(file, fields[i], number.problem, i);
          columns.values[place].push_back(number.value);
        }
      }
      ++columns.rows;
    }
  }

  [[noreturn]] void refuse_empty(const TextFile& file) const { file.fail("no samples, expected lines of ", names_); }

 private:
  /// Neither a number nor one that is lost.
  static bool is_name(std::string_view text) {
    std::string lower(text.substr(0, 4));
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
    const std::string_view unsigned_text = std::string_view(lower).substr(lower.starts_with('-') ? 1 : 0);
    return parse_real(text).problem != nullptr && !unsigned_text.empty() && unsigned_text != "nan" &&
           unsigned_text != "inf";
  }

  [[noreturn]] void refuse(const TextFile& file, std::string_view field, const char* problem, std::size_t i) const {
    file.fail(excerpt(field), ' ', problem, ", expected ", column_names[places_[i]],
              places_[i] == 0 ? " [" + time_unit_ + "] (--time-unit)" : "", " in column ", i + 1);
  }

  void add_time(const TextFile& file, std::string_view field, std::vector<nanoseconds>& times) const {
    const Parsed<nanoseconds> time = parse_time(field, time_digits_);
    if (time.problem) {
      const auto i = static_cast<std::size_t>(std::find(places_.begin(), places_.end(), 0) - places_.begin());
      refuse(file, field, time.problem, i);
    }
    if (!times.empty() && time.value <= times.back()) {
      file.fail("time ", field, ' ', time_unit_, " follows ", times.back().count(), " ns, expected increasing times");
    }
    times.push_back(time.value);
  }

  std::vector<std::size_t> places_;  // of each column in column_names
  std::string names_;
  std::string time_unit_;
  int time_digits_ = 0;
};

Columns read_columns(const std::filesystem::path& path, const ImuLogOptions& options) {
  Columns columns;
  std::optional<Progress> progress;
  if (is_ros_bag(path)) {
    if (options.rate || !options.columns.empty() || options.time_unit) {
      throw std::invalid_argument(message(path.string(), ": a ROS bag, expected no --rate, --columns and --time-unit"));
    }
    std::vector<std::string> arguments{"to-csv", path.string(), "-"};
    if (options.topic) arguments.insert(arguments.end(), {"--topic", *options.topic});
    PythonScript script(options.python, "imu_bag.py", arguments, PythonScript::Output::piped);
    TextFile file(script.output());
    ColumnReader(options).read(file, columns, progress);
    script.finish();
  } else {
    const ColumnReader reader(options);
    TextFile file(path);
    std::error_code no_size;
    const auto size = std::filesystem::file_size(path, no_size);
    if (!no_size && size > 0) progress.emplace(size);
    reader.read(file, columns, progress);
    if (columns.rows == 0) reader.refuse_empty(file);
  }
  return columns;
}

/// Leaves out the first seconds.
void skip(Columns& columns, const ImuLogOptions& options) {
  require_non_negative("--skip", "time", options.skip);
  if (options.skip == 0) return;
  std::size_t count = columns.rows;
  if (options.rate) {
    count =
        static_cast<std::size_t>(std::min(std::ceil(options.skip * *options.rate), static_cast<double>(columns.rows)));
  } else if (options.skip < seconds<double>(columns.times.back() - columns.times.front())) {
    const nanoseconds begin = after(columns.times.front(), options.skip);
    count = static_cast<std::size_t>(std::lower_bound(columns.times.begin(), columns.times.end(), begin) -
                                     columns.times.begin());
  }
  if (count >= columns.rows) throw std::invalid_argument(message("--skip: ", options.skip, " s is all of the log"));
  const auto erase = [count](auto& values) {
    if (!values.empty()) values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  };
  erase(columns.times);
  for (auto& values : columns.values) erase(values);
  columns.rows -= count;
}

/// The mean of each axis, if all three are there.
std::optional<Eigen::Vector3d> mean_of(const SensorLog& sensor) {
  if (sensor.axes.size() != 3) return std::nullopt;
  Eigen::Vector3d mean;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (const double value : sensor.axes[i].values) sum += value;
    mean[static_cast<Eigen::Index>(i)] = sum / static_cast<double>(sensor.axes[i].values.size());
  }
  return mean;
}

/// As many digits as a person needs.
std::string short_text(double value) {
  std::array<char, number_text_size> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

/// How regularly the samples of a sensor come, as a line.
std::string sampling_line(const SensorLog& sensor) {
  std::array<char, 300> text{};
  if (!sensor.sampling) {
    std::snprintf(text.data(), text.size(), "sampling: %.7g Hz, as given", sensor.rate);
    return text.data();
  }
  const LogSampling& sampling = *sensor.sampling;
  std::snprintf(text.data(), text.size(), "sampling: %.7g Hz, jitter %.3g ms (rms), at most %.3g ms; ", sampling.rate,
                sampling.jitter * 1e3, sampling.largest_jitter * 1e3);
  std::string line = text.data();
  if (sampling.gaps == 0) return line + "no samples missing";
  std::snprintf(
      text.data(), text.size(),
      "%lld samples missing in %lld gaps, the longest of %.4g s after sample %lld, taken as if there were none",
      static_cast<long long>(sampling.missing), static_cast<long long>(sampling.gaps), sampling.longest.duration,
      static_cast<long long>(sampling.longest.index));
  return line + text.data();
}

/// Refuses a log whose unit can be seen to be another one and has not been given.
void check_unit(const SensorLog& sensor, bool given, ImuLog& log) {
  log.units += message(log.units.empty() ? "" : ", ", sensor_name(sensor.kind), " in ",
                       unit_text(SensorUnit{}, sensor.kind), given ? " as converted" : " as assumed");
  const auto mean = mean_of(sensor);
  if (!mean) return;
  log.units += message(" (mean ", short_text(mean->norm()), ")");
  const auto say = [&](bool refuse, const std::string& text) {
    if (refuse && !given) throw std::runtime_error(text);
    log.warnings.push_back(text);
  };
  if (sensor.kind == SensorKind::gyro) {
    if (allan::plausible_gyroscope_mean(*mean)) return;
    say(true,
        message("gyroscope: its mean is ", short_text(mean->norm()),
                " rad/s, expected less than 1 at rest: it turns, or give --gyro-unit deg/s (or rad/s, if so it is)"));
    return;
  }
  using allan::AccelerometerMean;
  const std::string found =
      message("accelerometer: its mean is ", short_text(mean->norm()), " m/s^2, expected 9.8 at rest: ");
  const char* or_si = " (or m/s2, if so it is)";
  switch (allan::recognize_accelerometer_mean(*mean)) {
    case AccelerometerMean::gravity:
      break;
    case AccelerometerMean::gravity_in_g:
      say(true, message(found, "it looks like g, give --accel-unit g", or_si));
      break;
    case AccelerometerMean::gravity_in_milli_g:
      say(true, message(found, "it looks like mg, give --accel-unit mg", or_si));
      break;
    case AccelerometerMean::no_gravity:
      say(false, message(found, "gravity has been taken out, perhaps by a filter, which shapes the noise, too"));
      break;
    case AccelerometerMean::unclear:
      say(false, message(found, "it moves, is not calibrated, or is in another unit"));
      break;
  }
}

void check_stillness(const SensorLog& sensor, ImuLog& log) {
  const std::int64_t block = std::max<std::int64_t>(20, std::llround(std::min(sensor.rate, 1e9)));
  for (const AxisLog& axis : sensor.axes) {
    const allan::Stillness still = allan::measure_stillness(axis.values, block);
    if (still.disturbed == 0) continue;
    log.warnings.push_back(message(sensor_name(sensor.kind), ' ', axis.name, ": not at rest? In ", still.disturbed,
                                   " of ", still.blocks, " blocks of ", static_cast<double>(block) / sensor.rate,
                                   " s it varies more than four times as much as in most, the worst ",
                                   static_cast<double>(still.worst) / sensor.rate, " s after the beginning (",
                                   short_text(still.worst_ratio), " times)"));
    return;  // the other axes will say the same
  }
}

}  // namespace

std::string_view sensor_name(SensorKind kind) { return kind == SensorKind::gyro ? "gyroscope" : "accelerometer"; }

ImuLog read_imu_log(const std::filesystem::path& path, const ImuLogOptions& options) {
  if (options.rate) require_positive("--rate", "rate", *options.rate);
  Columns columns = read_columns(path, options);
  skip(columns, options);
  ImuLog log;
  log.path = path.string();
  log.samples = columns.rows;
  log.rate = options.rate.value_or(0);
  try {
    if (!columns.times.empty()) {
      log.sampling = allan::measure_sampling(columns.times);
      allan::require_regular(*log.sampling, options.limits);
      log.rate = log.sampling->rate;
    }
    const std::map<std::string, double> units{
        {"rad/s", 1}, {"deg/s", units::degree}, {"m/s2", 1}, {"g", units::standard_g}, {"mg", units::milli_g}};
    for (const SensorKind kind : {SensorKind::gyro, SensorKind::accel}) {
      const auto& unit = kind == SensorKind::gyro ? options.gyro_unit : options.accel_unit;
      const double factor = unit ? units.at(*unit) : 1;
      SensorLog sensor{kind, {}, log.path, log.samples, log.rate, log.sampling};
      for (std::size_t i = 0; i < 3; ++i) {
        auto& values = columns.values[i + (kind == SensorKind::gyro ? 1 : 4)];
        if (values.empty()) continue;
        if (factor != 1) std::for_each(values.begin(), values.end(), [factor](double& value) { value *= factor; });
        sensor.axes.push_back({"xyz"[i], std::move(values)});
      }
      if (sensor.axes.empty()) continue;
      check_unit(sensor, unit.has_value(), log);
      check_stillness(sensor, log);
      if (log.sensors.empty()) log.report.push_back(sampling_line(sensor));
      log.sensors.push_back(std::move(sensor));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(message(log.path, ": ", error.what()));
  }
  return log;
}

std::vector<double> read_numbers(const std::filesystem::path& path) {
  TextFile file(path == "-" ? "/dev/stdin" : path);
  std::vector<double> numbers;
  while (file.next()) {
    const Parsed<double> number = parse_real(file.line());
    if (number.problem) file.fail(excerpt(file.line()), ' ', number.problem, ", expected one number a line");
    numbers.push_back(number.value);
    if (numbers.size() == 10'000 && file.progress() > 0) {  // enough to tell the length of the rest
      numbers.reserve(static_cast<std::size_t>(1.02 * static_cast<double>(numbers.size()) / file.progress()));
    }
  }
  return numbers;
}
