// SPDX-License-Identifier: MIT
// Any bytes as a log for Allan analysis: options, a line of columns, a line of a stretch to leave out, and the file.
#include "support/imu_log.hpp"

#include <array>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <string_view>
#include <vector>

#include "fuzz/files.hpp"

namespace splinertia::fuzz::imu_log_target {

using namespace splinertia::detail;

void choose(Input& input, std::optional<std::string>& value, const auto& names) {
  const int index = input.integer(0, static_cast<int>(names.size()));
  if (index > 0) value = names[static_cast<std::size_t>(index - 1)];
}

const Target target{
    "imu_log", [](Input input) {
      static InputBytes file("imu.csv");
      ImuLogOptions options;
      if (input.flag()) options.rate = input.real();
      choose(input, options.time_unit, std::array{"s", "ms", "us", "ns"});
      choose(input, options.gyro_unit, std::array{"rad/s", "deg/s"});
      choose(input, options.accel_unit, std::array{"m/s2", "g", "mg"});
      if (input.flag()) options.skip = input.real();
      if (input.flag()) options.until = input.real();
      options.drop_duplicates = input.flag();
      options.limits = {
          .missing = input.flag() ? 1e-3 : 1, .jitter = input.flag() ? 0.2 : 100, .arrival_times = input.flag()};
      std::vector<std::string_view> names;
      split_fields(input.line(), names);
      options.columns.assign(names.begin(), names.end());
      if (const std::string_view stretch = input.line(); !stretch.empty()) options.leave_out.emplace_back(stretch);

      ImuLog read;
      const std::string& path = file.with(input.rest());
      if (!accepted("", [&] { read = read_imu_log(path, options); })) return;
      expect(!read.sensors.empty() && read.samples > 0, "no samples");
      for (const SensorLog& sensor : read.sensors) {
        expect(sensor.rate > 0 && has_finite_bits(sensor.rate), "rate ", sensor.rate);
        for (const AxisLog& axis : sensor.axes) {
          expect(axis.values.size() == sensor.samples, axis.values.size(), " values of ", sensor.samples);
          for (const double value : axis.values) expect(has_finite_bits(value), "read ", value);
        }
        for (std::size_t i = 0; i < sensor.samples; ++i) {
          expect(has_finite_bits(sensor.time_of(i)), "sample ", i, " is at ", sensor.time_of(i));
        }
      }
      for (const std::string& line : read.report) expect(!line.empty(), "an empty line of the report");
    }};

}  // namespace splinertia::fuzz::imu_log_target
