// SPDX-License-Identifier: MIT
/// IMU samples as a NumPy array of records (time_ns, gyro, accel), 56 bytes a sample, for numpy.load:
///
///   imu = numpy.load("imu.npy")    # or mmap_mode="r", which reads only what is used
///   imu["time_ns"], imu["gyro"][:, 2]
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <ranges>
#include <splinertia/detail/finite.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/io/detail/file_stamps.hpp>
#include <splinertia/io/detail/little_endian.hpp>
#include <splinertia/io/detail/npy.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/io/number_text.hpp>
#include <string_view>
#include <vector>

namespace splinertia {

namespace detail {

/// Time [ns], angular velocity [rad/s], specific force [m/s²]; little-endian on every machine.
inline constexpr const char* npy_imu_dtype = "[('time_ns', '<i8'), ('gyro', '<f8', (3,)), ('accel', '<f8', (3,))]";
inline constexpr std::size_t npy_imu_size = 7 * 8;  // bytes

}  // namespace detail

/// Writes IMU samples as a NumPy array one by one, in constant memory. The file appears with commit(). Members throw
/// std::runtime_error if the file cannot be written, and std::invalid_argument for what read_npy_imu would refuse: no
/// samples, NaN, times that do not increase.
class NpyImuWriter {
 public:
  explicit NpyImuWriter(const std::filesystem::path& path) : npy_(path, detail::npy_imu_dtype) {}

  /// One sample: an ImuSample or anything with its members, over any time; seconds are rounded to the nearest ns.
  void append(const ImuSampleLike auto& sample) {
    const std::chrono::nanoseconds time = stamps_.next(npy_.file(), sample.time);
    char* end = detail::store_little_endian(npy_.room(detail::npy_imu_size), std::int64_t{time.count()});
    end = store(end, sample.gyro);
    npy_.advance(store(end, sample.accel));
  }

  /// Completes the file. It appears now, or together with the others of a set.
  void commit(std::same_as<FileSet> auto&... set) { npy_.commit(set...); }

 private:
  [[nodiscard]] char* store(char* to, const auto& vector) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = vector[axis];
      if (!detail::is_finite(value)) npy_.file().refuse(value);
      to = detail::store_little_endian(to, value);
    }
    return to;
  }

  detail::NpyWriter npy_;
  detail::FileStamps stamps_;
};

/// Writes all samples of a range, as NpyImuWriter does.
template <std::ranges::input_range Samples>
  requires ImuSampleLike<std::ranges::range_value_t<Samples>>
void write_npy_imu(const std::filesystem::path& path, Samples&& samples) {
  NpyImuWriter writer(path);
  for (const auto& sample : samples) writer.append(sample);
  writer.commit();
}

/// Reads the samples in a file that NpyImuWriter or numpy.save wrote, with the same bits. Throws std::runtime_error
/// with file and byte or row for the first error: what NpyReader refuses, NaN, infinity, times that do not increase.
[[nodiscard]] inline std::vector<ImuSample<double, std::chrono::nanoseconds>> read_npy_imu(
    const std::filesystem::path& path) {
  detail::NpyReader file(path, detail::npy_imu_dtype, detail::npy_imu_size);
  std::vector<ImuSample<double, std::chrono::nanoseconds>> samples;
  samples.reserve(file.expected_rows());
  const auto vector = [&](const char* name, std::size_t offset) {
    Eigen::Vector3d result;
    for (int axis = 0; axis < 3; ++axis) {
      result[axis] = detail::load_little_endian<double>(file.record() + offset + 8 * static_cast<std::size_t>(axis));
      if (detail::is_finite(result[axis])) continue;
      char text[number_text_size];
      const std::string_view value(text, static_cast<std::size_t>(real_to_chars(text, result[axis]) - text));
      file.fail_row(name, '[', axis, "] is ", value, ", expected a finite number");
    }
    return result;
  };
  while (file.next()) {
    const std::chrono::nanoseconds time{detail::load_little_endian<std::int64_t>(file.record())};
    if (!samples.empty() && time <= samples.back().time) {
      file.fail_row("time_ns ", time.count(), " follows ", samples.back().time.count(), ", expected increasing times");
    }
    const Eigen::Vector3d gyro = vector("gyro", 8), accel = vector("accel", 32);
    samples.push_back({time, gyro, accel});
  }
  return samples;
}

}  // namespace splinertia
