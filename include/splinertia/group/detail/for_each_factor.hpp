// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cstddef>
#include <utility>

namespace splinertia::detail {

/// Calls f<Index, Factor>() for each factor of the Product P, in its order.
template <typename P>
constexpr void for_each_factor(const auto& f) {
  [&]<std::size_t... Index>(std::index_sequence<Index...>) {
    (f.template operator()<Index, typename P::template Factor<Index>>(), ...);
  }(std::make_index_sequence<P::size>{});
}

}  // namespace splinertia::detail
