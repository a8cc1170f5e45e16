// SPDX-License-Identifier: MIT
#include "../../tools/support/imu_log.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using test::error_of;

namespace {

constexpr std::int64_t epoch = 1'600'000'000;  // s

/// What a table has in a column of readings: z of the accelerometer shows gravity.
enum class Sensors { both, gyro, accel };

struct Writer {
  test::TemporaryDirectory folder;

  /// Rows whose first field is stamp(i); "" for none. The readings are noise and tell nothing.
  std::filesystem::path operator()(int rows, const std::function<std::string(int)>& stamp,
                                   Sensors sensors = Sensors::both) const {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::string text = "#stamp,readings\n";
    for (int i = 0; i < rows; ++i) {
      text += stamp(i);
      const int first = sensors == Sensors::accel ? 3 : 0, last = sensors == Sensors::gyro ? 3 : 6;
      for (int k = first; k < last; ++k) {
        text += (text.back() == '\n' ? "" : ",") + std::to_string(0.01 * normal(random) + (k == 5 ? 9.81 : 0));
      }
      text += '\n';
    }
    return folder.write("log.csv", text);
  }

  [[nodiscard]] std::filesystem::path named(const char* name, int rows, const std::function<std::string(int)>& stamp,
                                            Sensors sensors) const {
    const std::filesystem::path path = folder / name;
    std::filesystem::rename((*this)(rows, stamp, sensors), path);
    return path;
  }
};

std::string whole(std::int64_t stamp) { return std::to_string(stamp); }
std::string every_5_ms(int i) { return whole(epoch * 1'000'000'000 + i * std::int64_t{5'000'000}); }

std::string refusal(const std::filesystem::path& path, const ImuLogOptions& options = {}) {
  return error_of<std::exception>([&] { (void)read_imu_log(path, options); });
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The line of the report that begins with this.
std::string line(const ImuLog& log, const std::string& begin) {
  for (const std::string& text : log.report) {
    if (text.starts_with(begin)) return text;
  }
  return "";
}

ImuLogOptions with_columns(std::vector<std::string> columns) {
  ImuLogOptions options;
  options.columns = std::move(columns);
  return options;
}

const std::vector<std::string> timed{"t", "gx", "gy", "gz", "ax", "ay", "az"};

}  // namespace

TEST_CASE("a regular log") {
  const Writer write;
  const ImuLog log = read_imu_log(write(2000, every_5_ms), {});
  CHECK(log.samples == 2000);
  CHECK_THAT(log.rate, WithinRel(200.0, 1e-12));
  CHECK(line(log, "sampling") == "sampling: 200 Hz, jitter 0 ms (rms), at most 0 ms; no samples missing");
  CHECK(log.units.starts_with("gyroscope in rad/s as assumed"));
  CHECK_FALSE(log.topic);
  REQUIRE(log.sensors.size() == 2);
  CHECK_THAT(log.sensors[1].rate, WithinRel(200.0, 1e-12));
  CHECK(log.sensors[1].samples == 2000);
  CHECK(log.sensors[1].axes[2].values.size() == 2000);
}

TEST_CASE("stamps of another unit in a EuRoC file are refused with the unit that would do") {
  const Writer write;
  const auto ms = write(2000, [](int i) { return whole(epoch * 1000 + 5 * i); });
  CHECK(refusal(ms) == ms.string() +
                           ": sampling: 2e+08 Hz if the times are in ns, expected at most 50000 Hz for an IMU; give "
                           "--time-unit ms (200 Hz)");
  ImuLogOptions options;
  options.time_unit = "ms";
  CHECK_THAT(read_imu_log(ms, options).rate, WithinRel(200.0, 1e-12));
  options.time_unit = "ns";
  CHECK(has(refusal(ms, options), "2e+08 Hz if the times are in ns"));

  const auto us = write(2000, [](int i) { return whole(epoch * 1'000'000 + 5000 * i); });
  CHECK(has(refusal(us),
            ": sampling: 2e+05 Hz if the times are in ns, expected at most 50000 Hz for an IMU; give "
            "--time-unit us (200 Hz)"));
  options.time_unit = "us";
  CHECK_THAT(read_imu_log(us, options).rate, WithinRel(200.0, 1e-12));
}

TEST_CASE("decimal stamps are seconds, and said to be") {
  const Writer write;
  const auto decimal = [](int i) {
    return whole(epoch + i / 200) + "." + std::to_string(1000 + i % 200 * 5).substr(1);
  };
  const ImuLog euroc = read_imu_log(write(2000, decimal), {});
  CHECK_THAT(euroc.rate, WithinRel(200.0, 1e-12));
  CHECK(euroc.units.starts_with("times in s since 1970, as their digits and decimals show (--time-unit), gyroscope"));
  CHECK(read_imu_log(write(2000, decimal), with_columns(timed)).units.starts_with("gyroscope"));
  const auto from_zero = [](int i) { return std::to_string(i * 0.005); };
  CHECK(read_imu_log(write(2000, from_zero), {}).units.starts_with("times in s, as they have decimals (--time-unit)"));
  // Whole numbers in another notation are no decimals: numpy.savetxt writes ns like this.
  const auto scientific = [](int i) { return whole(5 * i) + ".000000e+06"; };
  CHECK_THAT(read_imu_log(write(2000, scientific), {}).rate, WithinRel(200.0, 1e-12));
}

TEST_CASE("where no format says the unit, digits from 1970 do") {
  const Writer write;
  const ImuLog ns = read_imu_log(write(2000, every_5_ms), with_columns(timed));
  CHECK_THAT(ns.rate, WithinRel(200.0, 1e-12));
  CHECK(ns.units.starts_with("times in ns since 1970, as their digits show (--time-unit), gyroscope"));
  const auto from_zero = write(2000, [](int i) { return whole(5 * i); });
  CHECK(refusal(from_zero, with_columns(timed)) ==
        from_zero.string() +
            ": the unit of the times is unknown: the samples would have 0.2 Hz in s, 200 Hz in ms, 2e+05 Hz in us, "
            "2e+08 Hz in ns; give --time-unit ms (200 Hz)");
}

TEST_CASE("a log of less than a second is none") {
  const Writer write;
  const auto fast = write(400, [](int i) { return whole(25'000 * i); });
  CHECK(has(refusal(fast),
            ": sampling: the log lasts 0.01 s if the times are in ns, expected at least 1 s; give "
            "--time-unit us (40 Hz)"));
}

TEST_CASE("bursts are arrival times") {
  const Writer write;
  const auto burst = write(2000, [](int i) { return whole(20'000'000 * std::int64_t{i / 4} + 60'000 * (i % 4)); });
  CHECK(has(refusal(burst),
            "the stamps come in bursts of 4 samples 6e-05 s apart, one every 0.02 s: they are arrival "
            "times of packets and no sample is missing, expected the times of the samples; "
            "--arrival-times uses this rate, and so does reading the log without times: "
            "--columns=-,gx,gy,gz,ax,ay,az --rate 200"));
  ImuLogOptions options;
  options.limits.arrival_times = true;
  const ImuLog log = read_imu_log(burst, options);
  CHECK_THAT(log.rate, WithinRel(200.0, 1e-9));
  CHECK(line(log, "sampling") ==
        "sampling: 200 Hz, number of samples over time, since the stamps are arrival times: bursts of 4 "
        "every 20 ms; no samples missing");
  ImuLogOptions untimed = with_columns({"-", "gx", "gy", "gz", "ax", "ay", "az"});
  untimed.rate = 200;
  CHECK(line(read_imu_log(burst, untimed), "sampling") == "sampling: 200 Hz, as given");

  const auto pairs = write(2000, [](int i) { return whole(10'000'000 * std::int64_t{i / 2} + 100'000 * (i % 2)); });
  CHECK(has(refusal(pairs), "bursts of 2 samples 0.0001 s apart, one every 0.01 s"));
}

TEST_CASE("jitter lacks no samples") {
  const Writer write;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const double jitter : {0.1, 0.2}) {
    const auto path = write(4000, [&](int i) {
      return whole(std::int64_t{5'000'000} * (i + 10) + static_cast<std::int64_t>(5e6 * jitter * normal(random)));
    });
    ImuLogOptions options;
    if (jitter > 0.1) {
      CHECK(has(refusal(path), "the intervals vary by "));
      CHECK(has(refusal(path),
                "expected at most 20 % of it; --most-jitter accepts more, --arrival-times uses the times only for "
                "the rate"));
      options.limits.jitter = 0.5;
    }
    const ImuLog log = read_imu_log(path, options);
    CHECK_THAT(log.rate, WithinRel(200.0, 1e-3));
    CHECK(has(line(log, "sampling"), "; no samples missing"));
  }
}

TEST_CASE("duplicates are dropped on request, times that go back are not") {
  const Writer write;
  const auto twice = write(2000, [](int i) { return every_5_ms(i > 700 ? i - 1 : i); });
  CHECK(refusal(twice) == twice.string() +
                              ":703: time 1600000003500000000 ns follows 1600000003500000000 ns, expected increasing "
                              "times: --drop-duplicates leaves out such rows; or ignore the times: "
                              "--columns=-,gx,gy,gz,ax,ay,az --rate HZ");
  ImuLogOptions options;
  options.drop_duplicates = true;
  const ImuLog log = read_imu_log(twice, options);
  CHECK(log.samples == 1999);
  CHECK(log.sensors[0].axes[0].values.size() == 1999);
  CHECK(line(log, "duplicates") == "duplicates: 1 row with the stamp of the previous row left out");
  // Packets of eight with one stamp are no duplicates to drop.
  const auto packets = write(2000, [](int i) { return every_5_ms(8 * (i / 8)); });
  CHECK(has(refusal(packets, options),
            "1750 of 2000 rows have the stamp of the previous row, expected at most 1 % to drop"));
  CHECK(has(refusal(packets, options), "and give --rate"));
  const auto back = write(2000, [](int i) { return every_5_ms(i == 700 ? 5 : i); });
  CHECK(has(refusal(back, options), ":702: time 1600000000025000000 ns follows 1600000003495000000 ns, expected"));
}

TEST_CASE("stretches are left out, with times and without") {
  const Writer write;
  const auto path = write(2000, every_5_ms);
  ImuLogOptions options = GENERATE(ImuLogOptions{}, with_columns({"-", "gx", "gy", "gz", "ax", "ay", "az"}));
  if (!options.columns.empty()) options.rate = 200;
  const ImuLog all = read_imu_log(path, options);
  options.skip = 1;
  options.until = 9;
  options.leave_out = {"7.5-8", "3-4", "3.5-5", "0-1.5", "8.5-20"};
  const ImuLog log = read_imu_log(path, options);
  const auto& values = log.sensors[0].axes[0].values;
  const auto& before = all.sensors[0].axes[0].values;
  REQUIRE(log.samples == 900);
  REQUIRE(values.size() == 900);
  CHECK(values[0] == before[300]);
  CHECK(values[299] == before[599]);
  CHECK(values[300] == before[1000]);  // 5 s
  CHECK(values[899] == before[1699]);
  CHECK_THAT(log.rate, WithinRel(200.0, 1e-12));
  const auto time_of = [&](std::size_t sample) { return log.sensors[1].time_of(sample); };
  CHECK_THAT(time_of(0), WithinAbs(1.5, 1e-9));
  CHECK_THAT(time_of(299), WithinAbs(2.995, 1e-9));
  CHECK_THAT(time_of(300), WithinAbs(5, 1e-9));
  CHECK_THAT(time_of(899), WithinAbs(8.495, 1e-9));
  CHECK_THAT(all.sensors[0].time_of(1999), WithinAbs(9.995, 1e-9));
  REQUIRE(log.left_out.size() == 2);
  CHECK(log.left_out[0].begin == 3);
  CHECK(log.left_out[0].end == 5);
  CHECK(log.left_out[1].begin == 7.5);
  CHECK(line(log, "left out") ==
        "left out: 3 s to 5 s and 7.5 s to 8 s, 500 samples; the parts before and after are joined");
}

TEST_CASE("the time of a sample counts what is missing") {
  const Writer write;
  ImuLogOptions options;
  options.limits.missing = 1;
  const ImuLog log = read_imu_log(write(4000, [](int i) { return every_5_ms(i < 1500 ? i : i + 400); }), options);
  CHECK_THAT(log.sensors[0].time_of(1499), WithinAbs(7.495, 1e-9));
  CHECK_THAT(log.sensors[0].time_of(3999), WithinAbs(21.995, 1e-9));
}

TEST_CASE("bad ranges") {
  const Writer write;
  const auto path = write(2000, every_5_ms);
  const auto refused = [&](double skip, std::optional<double> until, std::vector<std::string> leave_out) {
    ImuLogOptions options;
    options.skip = skip;
    options.until = until;
    options.leave_out = std::move(leave_out);
    return refusal(path, options);
  };
  CHECK(refused(10, {}, {}) == "--skip: 10 s is the whole log");
  CHECK(refused(-1, {}, {}) == "--skip: time is -1, expected a finite number >= 0");
  CHECK(refused(3, 3, {}) == "--until: 3 s, expected more than the 3 s of --skip, with a sample in between");
  CHECK(refused(0, 0, {}) == "--until: time is 0, expected a finite number > 0");
  CHECK(refused(0, 1e300, {}) == "");
  CHECK(refused(0, {}, {"0-1e3"}) == "--leave-out: this is the whole log");
  CHECK(refused(0, {}, {"20-30"}) == "--leave-out: \"20-30\" contains no sample, the log is 9.995 s long");
  CHECK(refused(0, {}, {"1e-3-2e-3"}) == "--leave-out: \"1e-3-2e-3\" contains no sample, the log is 9.995 s long");
  for (const char* text : {"", "-", "5", "5-", "-5", "3-2", "3-3", "-1-2", "a-b", "1-2-3", "1-nan", "1 -2"}) {
    CAPTURE(text);
    CHECK(refused(0, {}, {text}) == "--leave-out: \"" + std::string(text) +
                                        "\", expected A-B with 0 <= A < B, in seconds from the beginning of the log");
  }
}

TEST_CASE("a gyroscope and an accelerometer of two logs keep their rates") {
  const Writer write;
  const auto gyro = write.named("gyro.csv", 2000, every_5_ms, Sensors::gyro);
  ImuLogOptions options;
  options.accel_log =
      write.named("accel.csv", 625, [](int i) { return whole(std::int64_t{16'000'000} * i); }, Sensors::accel);
  const ImuLog log = read_imu_log(gyro, options);
  REQUIRE(log.sensors.size() == 2);
  CHECK(log.sensors[0].kind == SensorKind::gyro);
  CHECK_THAT(log.sensors[0].rate, WithinRel(200.0, 1e-12));
  CHECK(log.sensors[0].samples == 2000);
  CHECK(log.sensors[1].kind == SensorKind::accel);
  CHECK_THAT(log.sensors[1].rate, WithinRel(62.5, 1e-12));
  CHECK(log.sensors[1].samples == 625);
  CHECK(log.sensors[1].path == options.accel_log->string());
  CHECK(log.sensors[1].axes[2].values.size() == 625);
  CHECK(line(log, "gyroscope sampling: 200 Hz") != "");
  CHECK(line(log, "accelerometer log: ") ==
        "accelerometer log: " + options.accel_log->string() + ", 625 samples, 10 s");
  CHECK(line(log, "accelerometer sampling: 62.5 Hz") != "");

  options.columns = {"-", "gx", "gy", "gz"};
  options.rate = 100;
  options.accel_columns = {"-", "-", "-", "az"};
  options.accel_rate = 50;
  const ImuLog untimed = read_imu_log(gyro, options);
  CHECK_THAT(untimed.sensors[0].rate, WithinRel(100.0, 1e-12));
  CHECK_THAT(untimed.sensors[1].rate, WithinRel(50.0, 1e-12));
  CHECK(untimed.sensors[1].axes.size() == 1);
}

TEST_CASE("options of two logs that do not go together") {
  const Writer write;
  const auto gyro = write.named("gyro.csv", 2000, every_5_ms, Sensors::gyro);
  ImuLogOptions options;
  options.accel_columns = {"t", "ax"};
  CHECK(refusal(gyro, options) == "--accel-columns, --accel-rate, --accel-topic: expected --accel-log, too");
  options.accel_log = gyro;
  options.columns = {"t", "gx", "ay", "gz"};
  CHECK(refusal(gyro, options) ==
        "--columns: ay, expected the columns of one sensor, since --accel-log has the accelerometer");
  options.columns.clear();
  options.accel_columns = {"t", "gx"};
  CHECK(has(refusal(gyro, options), "--accel-columns: gx, expected the columns of one sensor"));
  options.accel_columns = {"ax"};
  CHECK(refusal(gyro, options) == "--accel-columns: ax, expected t among them, or --accel-rate");
  options.accel_columns.clear();
  options.accel_log = write.folder / "none.csv";
  CHECK(has(refusal(gyro, options), "none.csv: cannot open"));
}
