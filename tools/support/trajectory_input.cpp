// SPDX-License-Identifier: MIT
#include "support/trajectory_input.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/concat.hpp"
#include "support/python_script.hpp"
#include "support/yaml_text.hpp"

using namespace splinertia;

namespace {

/// Adds an option that sets a value by its name; --help shows only the names.
template <typename Value, typename Target>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Target& target,
                        const std::map<std::string, Value>& choices, const std::string& text) {
  return app
      .add_option_function<std::string>(
          name, [&target, choices](const std::string& chosen) { target = choices.at(chosen); }, text)
      ->check(CLI::IsMember(choices));
}

TrajectoryFile read_bag(const TrajectoryInput& input) {
  const TrajectoryFormat& f = input.format;
  if (f.kind != TrajectoryFormat::Kind::automatic || !f.columns.empty() || f.quaternion_order || f.time_unit ||
      f.rate || !f.times.empty()) {
    throw std::invalid_argument(
        concat(input.file.string(), ": a ROS bag, expected no options except --topic and ", "--skip-bad-rows"));
  }
  std::vector<std::string> arguments{input.file.string()};
  if (input.topic) arguments.insert(arguments.end(), {"--topic", *input.topic});
  PythonScript script(default_python(), "pose_bag.py", arguments, PythonScript::Output::piped);
  const std::string pipe = script.output().string();
  TrajectoryFormat lines{.columns = "t,x,y,z,qx,qy,qz,qw", .time_unit = TimeUnit::nanoseconds};
  lines.skip_bad_rows = f.skip_bad_rows;
  try {
    TrajectoryFile file = read_trajectory(pipe, lines);
    script.finish();
    return file;
  } catch (const ScriptFailed&) {
    throw;
  } catch (const std::runtime_error& error) {
    std::string text = error.what();
    if (text.find("no rows") != std::string::npos) script.finish();  // throws if it has said why
    if (text.starts_with(pipe + ':')) text.erase(0, pipe.size() + 1);
    if (text.starts_with(' ')) text.erase(0, 1);
    const bool of_a_line = !text.empty() && text.front() >= '0' && text.front() <= '9';
    throw std::runtime_error(concat(input.file.string(), of_a_line ? ": message " : ": ", text));
  }
}

}  // namespace

void add_trajectory_options(CLI::App& app, TrajectoryInput& input, CLI::Option* file, const std::string& name) {
  const std::string begin = name.empty() ? "--" : "--" + name + '-';
  std::map<std::string, TrajectoryFormat::Kind> kinds{{"auto", TrajectoryFormat::Kind::automatic}};
  for (const KnownTrajectoryFormat& known : known_trajectory_formats) kinds[std::string(known.name)] = known.kind;
  const std::map<std::string, QuaternionOrder> orders{{"wxyz", QuaternionOrder::wxyz}, {"xyzw", QuaternionOrder::xyzw}};
  const std::map<std::string, TimeUnit> units{{"s", TimeUnit::seconds},
                                              {"ms", TimeUnit::milliseconds},
                                              {"us", TimeUnit::microseconds},
                                              {"ns", TimeUnit::nanoseconds}};
  TrajectoryFormat& format = input.format;
  auto* kind = add_choice(app, begin + "format", format.kind, kinds,
                          "format; default: auto, by the names of the columns, their number, and the stamps");
  auto* columns = app.add_option(begin + "columns", format.columns,
                                 "columns, instead of a format, such as t,x,y,z,qx,qy,qz,qw; - is ignored");
  auto* order = add_choice(app, begin + "quaternion-order", format.quaternion_order, orders,
                           "order of the quaternions: w first or last");
  auto* unit = add_choice(app, begin + "time-unit", format.time_unit, units, "unit of the stamps");
  auto* rate = app.add_option(begin + "pose-rate", format.rate, "rate of the poses [Hz], if they have no stamps");
  auto* times = app.add_option(begin + "times", format.times,
                               "file with the stamps, one per line, if the poses have none (KITTI's times.txt)");
  auto* skip = app.add_flag(
      begin + "skip-bad-rows", format.skip_bad_rows,
      "leave out and count rows that are malformed, with NaN, or with wrong stamps; without this they are an error");
  auto* topic = app.add_option(begin + "topic", input.topic, "topic of a ROS bag, needed if several have poses");
  columns->excludes(kind);
  times->excludes(rate);
  for (CLI::Option* option : {kind, columns, order, unit, rate, times, skip, topic}) {
    option->group(name.empty() ? "The trajectory file" : "The file of the " + name);
    if (file) option->needs(file);
  }
}

TrajectoryFile read_trajectory_input(const TrajectoryInput& input) {
  if (is_ros_bag(input.file)) return read_bag(input);
  if (input.topic) {
    throw std::invalid_argument(concat("--topic: ", input.file.string(), " is not a ROS bag, expected one"));
  }
  return read_trajectory(input.file, input.format);
}

std::string note_lines(const TrajectoryInput& input, const TrajectoryFile& file) {
  std::string text;
  for (const std::string& note : file.notes) text += escaped_line(input.file.string() + ": " + note) + '\n';
  return text;
}
