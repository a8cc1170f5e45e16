// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace splinertia::detail {

/// The median of the 17 elements around each element (at the ends, of the nearest 17), and at least the median of all.
template <typename Vector>
[[nodiscard]] std::vector<Vector> usual_beside(const std::vector<Vector>& all) {
  using Scalar = typename Vector::Scalar;
  const std::size_t window = std::min<std::size_t>(17, all.size());
  std::vector<Vector> usual(all.size());
  std::vector<Scalar> values;
  const auto median = [&](std::size_t from, std::size_t count, Eigen::Index row) {
    values.clear();
    for (std::size_t i = from; i < from + count; ++i) values.push_back(all[i][row]);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  for (Eigen::Index row = 0; row < Vector::SizeAtCompileTime; ++row) {
    const Scalar of_all = median(0, all.size(), row);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t from = (std::min)(i > window / 2 ? i - window / 2 : 0, all.size() - window);
      usual[i][row] = (std::max)(of_all, median(from, window, row));
    }
  }
  return usual;
}

}  // namespace splinertia::detail
