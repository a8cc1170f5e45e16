// SPDX-License-Identifier: MIT
// What it costs to write and read IMU samples as EuRoC csv and as NumPy arrays, beside what the numbers alone cost
// (std::to_chars, std::from_chars) and what the same bytes alone cost (write(2), read(2)). A call is a sample.

#include <fcntl.h>
#include <stdlib.h>  // mkdtemp
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <random>
#include <span>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/harness.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

constexpr std::size_t block = std::size_t{1} << 20;
constexpr std::size_t longest_row = 256;      // characters of a row of csv
constexpr std::size_t most_text = 1'000'000;  // rows to parse again and again

/// The first n samples of a log: a slow motion, and noise so that all digits of the numbers are there.
std::span<const ImuSample<double, nanoseconds>> samples(std::size_t n) {
  static std::vector<ImuSample<double, nanoseconds>> all;
  if (all.size() < n) {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal(0, 0.1);
    all.clear();
    all.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double phase = 0.005 * static_cast<double>(i);
      all.push_back({nanoseconds{1403636579758555392 + 5'000'000 * static_cast<std::int64_t>(i)},
                     {std::sin(phase) + normal(bits), normal(bits), std::cos(phase) + normal(bits)},
                     {normal(bits), std::sin(phase) + normal(bits), 9.80665 + normal(bits)}});
    }
  }
  return {all.data(), n};
}

/// A folder for the files, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "splinertia_benchmark_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be created");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] std::filesystem::path file(const char* name, std::size_t n) const {
    return path_ / (name + std::to_string(n));
  }

 private:
  std::filesystem::path path_;
};

const Folder& folder() {
  static const Folder only;
  return only;
}

/// The name of a file that is not there: where one is replaced, ext4 begins to write to the disk at the rename.
std::filesystem::path new_file(const char* name, std::size_t n) {
  auto path = folder().file(name, n);
  std::filesystem::remove(path);
  return path;
}

/// The files of n samples, written by the first who asks.
std::filesystem::path csv_file(std::size_t n) {
  auto path = folder().file("imu.csv", n);
  if (!std::filesystem::exists(path)) write_euroc_imu(path, samples(n));
  return path;
}

std::filesystem::path npy_file(std::size_t n) {
  auto path = folder().file("imu.npy", n);
  if (!std::filesystem::exists(path)) write_npy_imu(path, samples(n));
  return path;
}

void write_csv(std::size_t n) { write_euroc_imu(new_file("written.csv", n), samples(n)); }
void read_csv(std::size_t n) { benchmark::keep(read_euroc_imu(csv_file(n))); }
void write_npy(std::size_t n) { write_npy_imu(new_file("written.npy", n), samples(n)); }
void read_npy(std::size_t n) { benchmark::keep(read_npy_imu(npy_file(n))); }

// The bounds.

/// One row; returns its end. What any writer of shortest numbers has to do.
char* format(char* to, const ImuSample<double, nanoseconds>& sample) {
  to = std::to_chars(to, to + 32, sample.time.count()).ptr;
  for (const double value :
       {sample.gyro.x(), sample.gyro.y(), sample.gyro.z(), sample.accel.x(), sample.accel.y(), sample.accel.z()}) {
    *to++ = ',';
    to = std::to_chars(to, to + 32, value).ptr;
  }
  *to++ = '\n';
  return to;
}

void run_to_chars(std::size_t n) {
  char row[longest_row];
  for (const ImuSample<double, nanoseconds>& sample : samples(n)) {
    format(row, sample);
    benchmark::keep(row);
  }
}

/// The first rows, at most most_text, in memory.
const std::string& text(std::size_t n) {
  static std::string all;
  static std::size_t rows = 0;
  if (rows != std::min(n, most_text)) {
    char row[longest_row];
    all.clear();
    rows = std::min(n, most_text);
    for (const ImuSample<double, nanoseconds>& sample : samples(rows))
      all.append(row, static_cast<std::size_t>(format(row, sample) - row));
  }
  return all;
}

void run_from_chars(std::size_t n) {
  const std::string& rows = text(n);
  const char *const begin = rows.data(), *const end = begin + rows.size();
  const char* at = begin;
  for (std::size_t i = 0; i < n; ++i) {
    std::int64_t time = 0;
    double values[6];
    if (at == end) at = begin;
    at = std::from_chars(at, end, time).ptr;
    for (double& value : values) at = std::from_chars(at + 1, end, value).ptr;
    ++at;
    benchmark::keep(time);
    benchmark::keep(values);
  }
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : file_(::open(path.c_str(), flags, 0600)) {
    if (file_ < 0) throw std::runtime_error(path.string() + ": cannot be opened");
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(file_); }
  operator int() const { return file_; }

 private:
  int file_;
};

/// A new file of as many bytes as `model`.
void write_bytes(const std::filesystem::path& model, const std::filesystem::path& path) {
  static const std::vector<char> bytes(block, '1');
  const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
  for (std::size_t left = std::filesystem::file_size(model); left > 0;) {
    const ssize_t written = ::write(file, bytes.data(), std::min(left, block));
    if (written <= 0) throw std::runtime_error(path.string() + ": cannot be written");
    left -= static_cast<std::size_t>(written);
  }
}

void read_bytes(const std::filesystem::path& path) {
  static std::vector<char> bytes(block);
  const Descriptor file(path, O_RDONLY);
  while (::read(file, bytes.data(), block) > 0) benchmark::keep(bytes);
}

/// As many samples in memory that the process did not have before, as a reader returns them.
void run_memory(std::size_t n) {
  const auto from = samples(n);
  benchmark::keep(std::vector<ImuSample<double, nanoseconds>>(from.begin(), from.end()));
}

void write_csv_bytes(std::size_t n) { write_bytes(csv_file(n), new_file("bytes", n)); }
void read_csv_bytes(std::size_t n) { read_bytes(csv_file(n)); }
void write_npy_bytes(std::size_t n) { write_bytes(npy_file(n), new_file("bytes", n)); }
void read_npy_bytes(std::size_t n) { read_bytes(npy_file(n)); }

/// What is measured; the bounds of a job are others, whose times together are what it cannot be faster than.
struct Job {
  benchmark::Kernel kernel;
  std::vector<std::size_t> bounds = {};
  std::filesystem::path (*file)(std::size_t n) = nullptr;  // that it writes or reads
};

const std::vector<Job>& jobs() {
  static const std::vector<Job> all{
      {{"euroc_imu_write", write_csv}, {1, 2}, csv_file},
      {{"to_chars", run_to_chars}},
      {{"write_bytes", write_csv_bytes}, {}, csv_file},
      {{"euroc_imu_read", read_csv}, {4, 5, 6}, csv_file},
      {{"from_chars", run_from_chars}},
      {{"read_bytes", read_csv_bytes}, {}, csv_file},
      {{"memory", run_memory}},
      {{"binary_write", write_npy}, {8}, npy_file},
      {{"binary_write_bytes", write_npy_bytes}, {}, npy_file},
      {{"binary_read", read_npy}, {10, 6}, npy_file},
      {{"binary_read_bytes", read_npy_bytes}, {}, npy_file},
  };
  return all;
}

/// Times of all jobs in turn, in ns a sample: by job, then by repetition.
std::vector<std::vector<double>> measure(std::size_t n, int repetitions) {
  std::vector<std::vector<double>> times(jobs().size());
  for (int repetition = -1; repetition < repetitions; ++repetition) {  // the first prepares files and memory
    for (std::size_t j = 0; j < jobs().size(); ++j) {
      const auto start = std::chrono::steady_clock::now();
      jobs()[j].kernel.run(n);
      const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
      if (repetition >= 0) times[j].push_back(elapsed.count() / static_cast<double>(n));
    }
  }
  return times;
}

benchmark::Times summary(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

void print(bool csv, std::size_t n, int repetitions) {
  const auto times = measure(n, repetitions);
  if (!csv) {
    std::printf("%zu samples, %d repetitions in turn\n\n%-20s %26s %8s %8s %19s\n", n, repetitions, "",
                "ns a sample min/median/max", "MB/s", "bytes", "times its bounds");
  }
  for (std::size_t j = 0; j < jobs().size(); ++j) {
    const auto& [kernel, bounds, file] = jobs()[j];
    const benchmark::Times time = summary(times[j]);
    benchmark::figure(csv, kernel.name + "_ns", time.min, "ns");
    benchmark::figure(csv, kernel.name + "_median_ns", time.median, "ns");
    benchmark::figure(csv, kernel.name + "_max_ns", time.max, "ns");
    if (!csv) std::printf("%-20s %8.1f %8.1f %8.1f", kernel.name.c_str(), time.min, time.median, time.max);
    if (file) {
      const double bytes = static_cast<double>(std::filesystem::file_size(file(n))) / static_cast<double>(n);
      benchmark::figure(csv, kernel.name + "_speed", 1e3 * bytes / time.median, "MB/s");
      benchmark::figure(csv, kernel.name + "_bytes", bytes, "bytes");
      if (!csv) std::printf(" %8.0f %8.1f", 1e3 * bytes / time.median, bytes);
    }
    if (!bounds.empty()) {
      std::vector<double> ratios;
      for (std::size_t repetition = 0; repetition < times[j].size(); ++repetition) {
        double bound = 0;
        for (const std::size_t b : bounds) bound += times[b][repetition];
        ratios.push_back(times[j][repetition] / bound);
      }
      const benchmark::Times ratio = summary(ratios);
      benchmark::figure(csv, kernel.name + "_over_bounds", ratio.median, "ratio");
      if (!csv) std::printf("   %5.2f %5.2f %5.2f of", ratio.min, ratio.median, ratio.max);
      for (const std::size_t b : bounds) {
        if (!csv) std::printf("%s %s", b == bounds.front() ? "" : " +", jobs()[b].kernel.name.c_str());
      }
    }
    if (!csv) std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<benchmark::Kernel> kernels;  // for --only
  for (const Job& job : jobs()) kernels.push_back(job.kernel);
  std::size_t n = 1'000'000;
  int repetitions = 5;
  const CLI::Option* csv = nullptr;
  benchmark::Extension extension;
  extension.options = [&](CLI::App& app) {
    csv = app.get_option("--csv");
    for (const char* name : {"--instructions", "--filter"}) app.remove_option(app.get_option(name));
    app.get_option("--calls")->description("samples of --only");
    app.add_option("--samples", n, "samples of a file")
        ->capture_default_str()
        ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 32));
    app.add_option("--repetitions", repetitions, "times that each is measured")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
  };
  extension.instead = [&]() -> std::optional<int> {
    try {
      print(csv->count() > 0, n, repetitions);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "files: %s\n", error.what());
      return 2;
    }
    return 0;
  };
  return benchmark::run(argc, argv, "What it costs to write and read IMU samples; a call is a sample.", kernels,
                        extension);
}
