// SPDX-License-Identifier: MIT
#include "support/imu_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/stamp_unit.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/units.hpp>
#include <stdexcept>
#include <utility>

#include "support/concat.hpp"
#include "support/formatted.hpp"
#include "support/imu_log_checks.hpp"
#include "support/imu_log_columns.hpp"
#include "support/imu_log_stamps.hpp"
#include "support/imu_log_stretches.hpp"
#include "support/python_script.hpp"

using namespace splinertia;

namespace {

/// The samples of one log and their times.
struct Stream {
  ImuTable table;
  ImuColumns columns;
  LeftOut left_out;
  double rate = 0;  // Hz
  std::optional<LogSampling> sampling;
};

constexpr auto gyro_columns = std::span(imu_column_names).subspan(1, 3);
constexpr auto accel_columns = std::span(imu_column_names).subspan(4, 3);

bool is_among(std::span<const std::string_view> names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// How to read the log of both sensors, or one of two logs.
ImuTable table_of(const std::filesystem::path& path, const ImuLogOptions& options) {
  ImuTable table{.path = path,
                 .columns = options.columns,
                 .rate = options.rate,
                 .time_unit = std::nullopt,
                 .usual_time_unit = std::nullopt,
                 .drop_duplicates = options.drop_duplicates,
                 .topic = options.topic,
                 .python = options.python};
  if (options.time_unit) {
    const auto named = [&](TimeUnit unit) { return time_unit_name(unit) == *options.time_unit; };
    table.time_unit = *std::find_if(all_time_units.begin(), all_time_units.end(), named);
  }
  return table;
}

/// Fills in the columns if none are given: those of EuRoC without the sensor that is in the other log.
void complete(ImuTable& table, std::span<const std::string_view> of_other_log) {
  const bool bag = is_ros_bag(table.path);
  if (bag && (table.rate || !table.columns.empty() || table.time_unit)) {
    throw std::invalid_argument(concat(table.path.string(), ": a ROS bag, expected no ", table.rate_option, ", ",
                                       table.columns_option, " or --time-unit"));
  }
  if (table.rate && !(std::isfinite(*table.rate) && *table.rate > 0)) {
    throw std::invalid_argument(concat(table.rate_option, ": rate is ", *table.rate, ", expected a finite number > 0"));
  }
  for (const std::string& name : table.columns) {
    if (!is_among(of_other_log, name)) continue;
    throw std::invalid_argument(concat(table.columns_option, ": ", name, ", expected the columns of one sensor, ",
                                       "since --accel-log has the accelerometer"));
  }
  if (!table.columns.empty()) return;
  table.usual_time_unit = TimeUnit::nanoseconds;
  for (const std::string_view name : imu_column_names) {
    const bool other = is_among(of_other_log, std::string(name));
    if ((other && !bag) || (name == "t" && table.rate)) continue;
    table.columns.emplace_back(other ? "-" : name);
  }
}

/// The log of both sensors, or the logs of the gyroscope and of the accelerometer.
std::vector<ImuTable> tables_of(const std::filesystem::path& path, const ImuLogOptions& options) {
  std::vector<ImuTable> tables{table_of(path, options)};
  if (!options.accel_log) {
    if (!options.accel_columns.empty() || options.accel_rate || options.accel_topic) {
      throw std::invalid_argument("--accel-columns, --accel-rate, --accel-topic: expected --accel-log, too");
    }
    complete(tables[0], {});
    return tables;
  }
  tables.push_back(table_of(*options.accel_log, options));
  tables[1].columns = options.accel_columns;
  tables[1].rate = options.accel_rate;
  tables[1].topic = options.accel_topic;
  tables[1].columns_option = "--accel-columns";
  tables[1].rate_option = "--accel-rate";
  complete(tables[0], accel_columns);
  complete(tables[1], gyro_columns);
  return tables;
}

/// The options that help if the stamps are rejected, for the message.
std::string ways_out(const Stream& stream, const allan::SamplingLimits& limits) {
  const LogSampling& sampling = *stream.sampling;
  if (sampling.bursts) {
    std::string text = "; --arrival-times uses this rate";
    if (is_ros_bag(stream.table.path)) return text;
    text += concat(", and so does reading the log without times: ", stream.table.columns_option, '=');
    for (std::size_t i = 0; i < stream.table.columns.size(); ++i) {
      const std::string& name = stream.table.columns[i];
      text += (i == 0 ? "" : ",") + (name == "t" ? "-" : name);
    }
    return text + concat(' ', stream.table.rate_option, ' ', formatted("%.7g", sampling.rate));
  }
  if (sampling.jitter > limits.jitter * sampling.nominal_interval) {
    return "; --most-jitter accepts more, --arrival-times uses the times only for the rate";
  }
  return "; --most-missing accepts more, --leave-out A-B leaves out a time span and joins the parts before and after";
}

Stream read_stream(const ImuTable& table, const ImuLogOptions& options) {
  Stream stream{table, read_imu_columns(table), {}, table.rate.value_or(0), std::nullopt};
  const std::size_t kept = stream.columns.rows, dropped = stream.columns.duplicates;
  if (dropped * 100 > kept + dropped) {
    throw std::runtime_error(concat(table.path.string(), ": sampling: ", dropped, " of ", kept + dropped,
                                    " rows have the stamp of the previous row, expected at most 1 % to drop: they "
                                    "are samples of packets with one stamp each; ignore the times with - for t in "
                                    "--columns, and give ",
                                    table.rate_option));
  }
  if (table.rate && !std::isfinite(static_cast<double>(kept) / *table.rate)) {
    throw std::invalid_argument(concat(table.rate_option, ": rate is ", *table.rate, " Hz, at which ", kept,
                                       " samples exceed the largest time that a number can represent"));
  }
  stream.left_out = leave_out(stream.columns, options, table.rate);
  if (stream.columns.times.empty()) return stream;
  try {
    stream.sampling = allan::measure_sampling(stream.columns.times, stream.left_out.breaks);
    stream.rate = stream.sampling->rate;
    require_plausible_times(*stream.sampling,
                            is_ros_bag(table.path) ? std::nullopt : std::optional(stream.columns.time_unit));
    allan::require_regular(*stream.sampling, options.limits);
  } catch (const std::invalid_argument& error) {
    const std::string way_out = stream.sampling ? ways_out(stream, options.limits) : "";
    throw std::runtime_error(concat(table.path.string(), ": ", error.what(), way_out));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(concat(table.path.string(), ": ", error.what()));
  }
  return stream;
}

/// Rate, jitter and missing samples.
std::string sampling_text(const Stream& stream, const allan::SamplingLimits& limits) {
  if (!stream.sampling) return formatted("%.7g Hz, as given", stream.rate);
  const LogSampling& sampling = *stream.sampling;
  std::string text = formatted("%.7g Hz, ", sampling.rate);
  if (sampling.bursts) {
    text += formatted("number of samples over time, since the stamps are arrival times: bursts of %.3g every %.4g ms; ",
                      sampling.bursts->samples, sampling.bursts->period * 1e3);
  } else {
    if (limits.arrival_times) text += "number of samples over time, since the stamps are arrival times; ";
    text += formatted("jitter %.3g ms (rms), at most %.3g ms; ", sampling.jitter * 1e3, sampling.largest_jitter * 1e3);
  }
  if (sampling.gaps == 0) return text + "no samples missing";
  return text + formatted(
                    "%lld sample%s missing in %lld gap%s, the longest of %.4g s after sample %lld, analysed "
                    "as if there were none",
                    static_cast<long long>(sampling.missing), sampling.missing == 1 ? "" : "s",
                    static_cast<long long>(sampling.gaps), sampling.gaps == 1 ? "" : "s", sampling.longest.duration,
                    static_cast<long long>(sampling.longest.index));
}

/// Adds lines on how a stream was read. With two streams, each line begins with the name of its sensor.
void report(const Stream& stream, const std::string& name, const ImuLogOptions& options, ImuLog& log) {
  if (!name.empty() && !log.report.empty()) {  // the report begins with the first log
    log.report.push_back(concat(name, "log: ", stream.table.path.string(),
                                stream.columns.topic ? " (" + *stream.columns.topic + ')' : "", ", ",
                                stream.columns.rows, " samples, ",
                                formatted("%.6g", static_cast<double>(stream.columns.rows) / stream.rate), " s"));
  }
  log.report.push_back(name + "sampling: " + sampling_text(stream, options.limits));
  if (stream.columns.duplicates > 0) {
    log.report.push_back(concat(name, "duplicates: ", stream.columns.duplicates,
                                stream.columns.duplicates == 1 ? " row" : " rows",
                                " with the stamp of the previous row left out"));
  }
  if (!stream.left_out.inside.empty()) {
    std::vector<std::string> spans;
    for (const LogSpan& span : stream.left_out.inside) {
      spans.push_back(formatted("%.6g s to %.6g s", span.begin, span.end));
    }
    log.report.push_back(concat(name, "left out: ", list_of(spans), ", ", stream.left_out.rows_inside,
                                " samples; the parts before and after are joined"));
  }
  if (!stream.columns.unit_note.empty()) {
    log.units += concat(log.units.empty() ? "" : ", ", name, stream.columns.unit_note, " (--time-unit)");
  }
}

/// The sensors of a stream, in SI units.
void add_sensors(Stream& stream, const ImuLogOptions& options, ImuLog& log) {
  const std::map<std::string, double> units{
      {"rad/s", 1}, {"deg/s", units::degree}, {"m/s2", 1}, {"g", units::standard_g}, {"mg", units::milli_g}};
  for (const SensorKind kind : {SensorKind::gyro, SensorKind::accel}) {
    const auto& unit = kind == SensorKind::gyro ? options.gyro_unit : options.accel_unit;
    const double factor = unit ? units.at(*unit) : 1;
    SensorLog sensor{
        kind, {}, stream.table.path.string(), stream.columns.rows, stream.rate, stream.sampling, stream.left_out.times};
    for (std::size_t i = 0; i < 3; ++i) {
      auto& values = stream.columns.values[i + (kind == SensorKind::gyro ? 1 : 4)];
      if (values.empty()) continue;
      if (factor != 1) std::for_each(values.begin(), values.end(), [factor](double& value) { value *= factor; });
      sensor.axes.push_back({"xyz"[i], std::move(values)});
    }
    if (sensor.axes.empty()) continue;
    try {
      check_unit(sensor, unit.has_value(), log);
    } catch (const std::exception& error) {
      throw std::runtime_error(concat(sensor.path, ": ", error.what()));
    }
    log.sensors.push_back(std::move(sensor));
  }
}

}  // namespace

std::string_view sensor_name(SensorKind kind) { return kind == SensorKind::gyro ? "gyroscope" : "accelerometer"; }

double SensorLog::time_of(std::size_t sample) const {
  const auto behind = std::upper_bound(times.begin(), times.end(), sample,
                                       [](std::size_t value, const SampleTime& known) { return value < known.sample; });
  const SampleTime& before = *(behind - 1);
  return before.time + static_cast<double>(sample - before.sample) / rate;
}

ImuLog read_imu_log(const std::filesystem::path& path, const ImuLogOptions& options) {
  std::vector<Stream> streams;
  for (const ImuTable& table : tables_of(path, options)) streams.push_back(read_stream(table, options));
  ImuLog log;
  log.path = path.string();
  log.topic = streams[0].columns.topic;
  log.samples = streams[0].columns.rows;
  log.rate = streams[0].rate;
  log.sampling = streams[0].sampling;
  log.left_out = streams[0].left_out.inside;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const std::string name = streams.size() == 1 ? "" : i == 0 ? "gyroscope " : "accelerometer ";
    report(streams[i], name, options, log);
  }
  for (Stream& stream : streams) add_sensors(stream, options, log);
  return log;
}

std::vector<double> read_numbers(const std::filesystem::path& path) {
  TextFile file(path == "-" ? "/dev/stdin" : path);
  std::vector<double> numbers;
  for (double usual = 0;;) {
    if (file.next_number(usual)) {
      numbers.push_back(usual);
    } else if (file.next()) {
      const Parsed<double> number = parse_real(file.line());
      if (number.problem) file.fail(excerpt(file.line()), ' ', number.problem, ", expected one number a line");
      numbers.push_back(number.value);
    } else {
      return numbers;
    }
    if (numbers.size() == 10'000 && file.progress() > 0) {  // enough to estimate the total count
      numbers.reserve(static_cast<std::size_t>(1.02 * static_cast<double>(numbers.size()) / file.progress()));
    }
  }
}
