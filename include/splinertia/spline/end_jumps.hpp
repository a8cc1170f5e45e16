// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/time.hpp>
#include <utility>
#include <vector>

namespace splinertia {

/// The first and the last pose behind the jumps at the ends. An estimator that begins with poses of identity, or a
/// tracker that ends with a wrong one, leaves up to 16 poses (an eighth of all) beyond a step which is ten times as
/// large as any but a fiftieth of the others: in a component, of the step less what either neighbouring step lets
/// expect. Such poses are beside nothing that could show them wrong, so a curve meets them whatever the loss. A step
/// across a hole may be as much larger as an acceleration makes it over that time.
template <LieGroup G, TimePoint Time>
[[nodiscard]] std::pair<std::size_t, std::size_t> poses_between_jumps(const std::vector<Stamped<G, Time>>& poses) {
  using Scalar = ScalarOf<G>;
  const std::size_t n = poses.size(), reach = std::min<std::size_t>(16, n / 8);
  std::pair<std::size_t, std::size_t> between{0, n - 1};
  if (reach < 1) return between;
  const auto step = [&](std::size_t i) { return increment<G>(poses[i].value, poses[i + 1].value); };
  const auto length = [&](std::size_t i) { return seconds<Scalar>(poses[i + 1].time - poses[i].time); };
  // Of the step from pose i on, less what the step from `beside` on lets expect.
  const auto unexpected = [&](std::size_t i, std::size_t beside) {
    const Scalar ratio = length(i) / length(beside);
    return Tangent<G>((step(i) - ratio * step(beside)).cwiseAbs() / std::max(Scalar(1), ratio * ratio));
  };
  Tangent<G> usual;
  std::vector<Scalar> values(n - 2);
  std::vector<Tangent<G>> all(n - 2);
  for (std::size_t i = 0; i + 2 < n; ++i) all[i] = unexpected(i, i + 1);
  for (int row = 0; row < usual.size(); ++row) {
    std::transform(all.begin(), all.end(), values.begin(), [row](const auto& v) { return v[row]; });
    // A jump in either direction makes two.
    const auto kept = static_cast<std::ptrdiff_t>(values.size() - std::max<std::size_t>(values.size() / 50, 3));
    std::nth_element(values.begin(), values.begin() + kept - 1, values.end());
    usual[row] = values[static_cast<std::size_t>(kept - 1)];
  }
  // A motion that begins, and goes on, differs from the step on one side only.
  const auto jumps = [&](std::size_t i, std::size_t inside, std::size_t outside) {
    Tangent<G> least = unexpected(i, inside);
    if (outside + 1 < n) least = least.cwiseMin(unexpected(i, outside)).eval();
    return (least.array() > Scalar(10) * usual.array()).any();
  };
  for (std::size_t i = 0; i < reach; ++i) {
    if (jumps(i, i + 1, i > 0 ? i - 1 : n)) between.first = i + 1;
    if (jumps(n - 2 - i, n - 3 - i, n - 1 - i)) between.second = n - 2 - i;
  }
  return between;
}

}  // namespace splinertia
