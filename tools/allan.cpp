// SPDX-License-Identifier: MIT
// Identifies the noise of an IMU from a log at rest. Writes N, K, B, Q and R with confidence intervals, the Allan
// curves, the spectrum and files for estimators. `allan deviation` computes one deviation of one column of numbers.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "allan/deviation.hpp"
#include "support/allan_analysis.hpp"
#include "support/allan_files.hpp"
#include "support/allan_report.hpp"
#include "support/common_options.hpp"
#include "support/concat.hpp"
#include "support/imu_log.hpp"
#include "support/imu_noise.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"
#include "support/python_script.hpp"

using namespace splinertia;

namespace {

struct Options {
  std::filesystem::path log;
  ImuLogOptions reading;
  std::vector<std::string> terms{"N", "K", "B", "Q", "R", "G", "W"};
  std::vector<std::string> exclude;
  allan::IdentifyOptions<double> identify;
  std::filesystem::path output = ".";
  std::vector<std::string> for_estimators;
  bool no_plot = false;
  unsigned threads = 1;
};

allan::NoiseTerms terms_of(const std::vector<std::string>& symbols) {
  allan::NoiseTerms terms;
  for (const allan::NoiseTerm term : allan::noise_terms) {
    if (std::find(symbols.begin(), symbols.end(), symbol(term)) != symbols.end()) terms = terms.with(term);
  }
  return terms;
}

/// Parses a frequency band LO-HI in Hz.
allan::Interval<double> band_of(const std::string& text) {
  const std::size_t dash = text.find('-', 1);
  const auto refuse = [&] {
    return std::invalid_argument(concat("--exclude: ", excerpt(text), ", expected a band LO-HI in Hz, such as 49-51"));
  };
  if (dash == std::string::npos) throw refuse();
  const auto lower = parse_real(std::string_view(text).substr(0, dash)),
             upper = parse_real(std::string_view(text).substr(dash + 1));
  if (lower.problem || upper.problem || lower.value < 0 || !(lower.value < upper.value)) throw refuse();
  return {lower.value, upper.value};
}

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const Estimator estimator : estimators) names.emplace_back(option_name(estimator));
  return names;
}

std::vector<Estimator> estimators_of(const std::vector<std::string>& names) {
  std::vector<Estimator> chosen;
  for (const Estimator estimator : estimators) {
    if (std::find(names.begin(), names.end(), option_name(estimator)) != names.end()) chosen.push_back(estimator);
  }
  return chosen;
}

void analyse_log(Options o) {
  o.identify.candidates = terms_of(o.terms);
  for (const std::string& band : o.exclude) o.identify.excluded.push_back(band_of(band));
  OutputFolder folder(o.output, "allan", {o.log, o.reading.accel_log.value_or("")});
  folder.expect_no_inputs({"curves.csv", "noise.csv", "spectrum.csv", "findings.csv"});
  if (!o.no_plot) folder.expect_pictures("allan");
  const ImuLog log = read_imu_log(o.log, o.reading);
  const LogNoise noise = analyse(log, o.identify, o.threads);
  for (const std::string& warning : log.warnings) std::fprintf(stderr, "allan: warning: %s\n", warning.c_str());
  print_report(log, noise);
  write_files(noise, folder, estimators_of(o.for_estimators));
  if (!o.no_plot) draw_plot(o.reading.python, "allan", o.output);
}

void add_table_options(CLI::App& app, ImuLogOptions& reading) {
  app.add_option("--columns", reading.columns,
                 "columns of a table, such as t,gx,gy,gz,-,ax,ay,az: time, gyroscope, accelerometer, - for a column to "
                 "ignore; default: those of EuRoC")
      ->delimiter(',');
  add_rate_option(app, reading.rate, "sampling rate [Hz], for a table without times");
  app.add_option("--time-unit", reading.time_unit,
                 "unit of column t; default: ns for a EuRoC file; with --columns s, or what the digits show")
      ->check(CLI::IsMember({"s", "ms", "us", "ns"}));
  app.add_option("--gyro-unit", reading.gyro_unit, "unit of the gyroscope; default: rad/s")
      ->check(CLI::IsMember({"rad/s", "deg/s"}));
  app.add_option("--accel-unit", reading.accel_unit, "unit of the accelerometer; default: m/s2")
      ->check(CLI::IsMember({"m/s2", "g", "mg"}));
}

void add_span_options(CLI::App& app, ImuLogOptions& reading) {
  app.add_option("--skip", reading.skip, "leave out the beginning, while the sensor warms up [s]")
      ->capture_default_str();
  app.add_option("--until", reading.until, "leave out everything after this time [s from the beginning]");
  app.add_option("--leave-out", reading.leave_out,
                 "leave out a time span A-B, such as a knock [s from the beginning of the log], and join the parts "
                 "before and after; may be repeated")
      ->allow_extra_args(false);
}

void add_sampling_options(CLI::App& app, ImuLogOptions& reading) {
  app.add_option("--most-missing", reading.limits.missing, "largest accepted fraction of missing samples")
      ->capture_default_str();
  app.add_option("--most-jitter", reading.limits.jitter,
                 "largest accepted jitter of the sample intervals, rms, as a fraction of an interval")
      ->capture_default_str();
  app.add_flag(
      "--arrival-times", reading.limits.arrival_times,
      "the times are arrival times, with bursts or jitter: compute the rate from the number of samples and the span");
  app.add_flag("--drop-duplicates", reading.drop_duplicates, "leave out rows with the same time as the previous row");
  app.add_option("--topic", reading.topic, "topic of a ROS bag, if it has several with IMU messages");
}

void add_accel_log_options(CLI::App& app, ImuLogOptions& reading) {
  app.add_option("--accel-log", reading.accel_log,
                 "log of the accelerometer, if the first log has only the gyroscope; each keeps its own rate");
  app.add_option("--accel-columns", reading.accel_columns, "columns of --accel-log; default: t,ax,ay,az")
      ->delimiter(',');
  app.add_option("--accel-rate", reading.accel_rate, "sampling rate of --accel-log [Hz], for a table without times");
  app.add_option("--accel-topic", reading.accel_topic, "topic of --accel-log");
}

void add_identify_options(CLI::App& app, Options& o) {
  app.add_option(
         "--terms", o.terms,
         "noise terms to look for: N white noise, K random walk, B bias instability, Q quantization noise, R rate "
         "ramp, G Gauss-Markov bias, W warm-up")
      ->delimiter(',')
      ->check(CLI::IsMember({"N", "K", "B", "Q", "R", "G", "W"}))
      ->capture_default_str();
  app.add_option("--confidence", o.identify.confidence, "confidence level of the intervals and limits")
      ->capture_default_str();
  app.add_option("--highest-frequency", o.identify.highest_frequency,
                 "ignore higher frequencies than this one [Hz]; default: half the rate");
  app.add_option("--exclude", o.exclude, "ignore a frequency band LO-HI [Hz]; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("!--keep-misfits", o.identify.exclude_misfits,
               "keep frequency bands whose power is not that of noise (lines, resonances, filters)");
}

void add_file_options(CLI::App& app, Options& o) {
  add_output_option(
      app, o.output,
      "folder for curves.csv (exists only if all files are complete), noise.csv, spectrum.csv, findings.csv, the "
      "files for estimators, allan.png and .svg");
  o.for_estimators = estimator_names();
  app.add_option("--estimators", o.for_estimators,
                 "estimators to write a file with N and K for: imu.yaml for Kalibr, else NAME_imu.yaml")
      ->delimiter(',')
      ->check(CLI::IsMember(estimator_names()))
      ->capture_default_str();
  add_no_plot_option(app, o.no_plot, "allan");
  app.add_option("--threads", o.threads,
                 "number of axes of a sensor to analyse at once; 0: as many as the machine runs at once")
      ->capture_default_str();
  add_python_option(app, o.reading.python, "for plots and ROS bags");
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("log", o.log,
                 "log of an IMU at rest: EuRoC csv, another table (--columns), or a ROS bag (.bag, .mcap, a ROS 2 "
                 "folder)");
  add_table_options(app, o.reading);
  add_span_options(app, o.reading);
  add_sampling_options(app, o.reading);
  add_accel_log_options(app, o.reading);
  add_identify_options(app, o);
  add_file_options(app, o);
}

}  // namespace

const Program this_program{
    "allan",
    "Identifies the noise of an IMU at rest: white noise N, random walk K, bias instability B, quantization noise Q "
    "and\nrate ramp R of each axis, with confidence intervals, or upper limits for terms that are not detected. Also "
    "writes\nthe Allan deviations, and files of N and K for estimators.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      add_options(app, options);
      static DeviationOptions deviation_options;
      static CLI::App* const deviation =
          app.add_subcommand("deviation", "Prints one kind of deviation of a column of numbers.");
      add_deviation_options(*deviation, deviation_options);
      return [] {
        if (deviation->parsed() != options.log.empty()) {
          throw std::invalid_argument("expected one log, or the subcommand deviation (--help)");
        }
        deviation->parsed() ? print_deviation(deviation_options) : analyse_log(options);
      };
    }};
