// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <array>
#include <cstddef>

namespace splinertia::detail {

/// std::array whose length is an int, like orders and dimensions. It avoids warnings of -Wsign-conversion.
template <typename T, int N>
using FixedArray = std::array<T, static_cast<std::size_t>(N)>;

}  // namespace splinertia::detail
