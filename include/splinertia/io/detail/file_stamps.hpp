// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <concepts>
#include <optional>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia::detail {

/// The stamps of the rows of a file that is written: any time becomes whole nanoseconds here, seconds the nearest.
class FileStamps {
 public:
  /// The stamp of the next row. Abandons the file and throws std::invalid_argument for a time that is not finite or not
  /// later than the one before, and std::out_of_range beyond 292 years.
  template <TimePoint Time>
  [[nodiscard]] std::chrono::nanoseconds next(AtomicFile& file, Time time) {
    if constexpr (std::floating_point<Time>) {
      if (!is_finite(time)) file.refuse(static_cast<double>(time));
    }
    const std::chrono::nanoseconds stamp = to_nanoseconds(time);
    if (last_ && stamp <= *last_) {
      file.abandon();
      throw std::invalid_argument(message(file.path().string(), ": time ", stamp.count(), " ns follows ",
                                          last_->count(), " ns, expected increasing times"));
    }
    last_ = stamp;
    return stamp;
  }

  [[nodiscard]] bool empty() const { return !last_; }

 private:
  std::optional<std::chrono::nanoseconds> last_;
};

}  // namespace splinertia::detail
