// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <ranges>
#include <type_traits>
#include <vector>

namespace splinertia {

/// The elements of a range in a vector; those of simulate(), for example:
///
///   const auto readings = to_vector(simulate(curve, imu));                 // std::vector<ImuReading>
///   const auto samples = to_vector<ImuSample<>>(simulate(curve, imu));     // without the biases
///
/// With `Element`, each element is converted to it.
template <typename Element = void, std::ranges::input_range Range>
[[nodiscard]] auto to_vector(Range&& range) {
  using T = std::conditional_t<std::is_void_v<Element>, std::ranges::range_value_t<Range>, Element>;
  std::vector<T> elements;
  if constexpr (requires { std::ranges::size(range); }) {
    elements.reserve(static_cast<std::size_t>(std::ranges::size(range)));
  }
  for (auto&& element : range) elements.push_back(static_cast<T>(element));
  return elements;
}

}  // namespace splinertia
