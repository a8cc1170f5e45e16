// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cstdint>

namespace splinertia::allan {

/// The samples begin, begin + 1, …, end − 1 of a signal.
struct SampleSpan {
  std::int64_t begin;
  std::int64_t end;

  [[nodiscard]] std::int64_t size() const { return end - begin; }
  [[nodiscard]] bool operator==(const SampleSpan&) const = default;
};

}  // namespace splinertia::allan
