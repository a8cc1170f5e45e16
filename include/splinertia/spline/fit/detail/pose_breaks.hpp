// SPDX-License-Identifier: MIT
/// Finds steps between poses that no motion explains: jumps of an estimator, and single wrong poses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/fit/detail/usual_beside.hpp>
#include <splinertia/spline/fit/pose_statistics.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia::detail {

/// Component-wise difference of the step from pose i to i + 1 from what the step from pose `beside` to the next
/// predicts at constant velocity. A constant acceleration makes this difference proportional to own·(own + other)/2,
/// where own and other are the lengths of both steps in seconds. So the difference is divided by that over `usual`²,
/// `usual` being the usual length, if this exceeds 1: in key frames, a short step may be next to a long pause.
template <LieGroup G, TimePoint Time>
[[nodiscard]] Tangent<G> unexpected_step(const std::vector<Stamped<G, Time>>& poses, std::size_t i, std::size_t beside,
                                         double usual) {
  using Scalar = ScalarOf<G>;
  const auto step = [&](std::size_t k) { return increment<G>(poses[k].value, poses[k + 1].value); };
  const auto length = [&](std::size_t k) { return to_seconds<Scalar>(poses[k + 1].time - poses[k].time); };
  const Scalar own = length(i), other = length(beside), square = static_cast<Scalar>(usual * usual);
  const Scalar allowance = own * (own + other) / (2 * square);
  return (step(i) - own / other * step(beside)).cwiseAbs() / (std::max)(Scalar(1), allowance);
}

/// The i, ascending, for which the step from pose i to the next is a break: in some component it differs from the
/// predictions of both neighbouring steps by more than ten times what is usual there, and by more than rounding. A
/// motion that lasts for nine poses or more is not a break. Fewer than eight poses have no breaks.
template <LieGroup G, TimePoint Time>
[[nodiscard]] std::vector<std::size_t> breaks_between(const std::vector<Stamped<G, Time>>& poses) {
  using Scalar = ScalarOf<G>;
  std::vector<std::size_t> breaks;
  if (poses.size() < 8) return breaks;
  const std::size_t steps = poses.size() - 1;
  const double interval = median_interval(poses);
  std::vector<Tangent<G>> unexpected(steps - 1);
  for (std::size_t i = 0; i + 1 < steps; ++i) unexpected[i] = unexpected_step(poses, i, i + 1, interval);
  const std::vector<Tangent<G>> usual = usual_beside(unexpected);
  const auto size = [](const G& pose) { return GroupTraits<G>::log(pose).cwiseAbs().maxCoeff(); };
  const Scalar rounding =
      64 * std::numeric_limits<Scalar>::epsilon() * (1 + size(poses.front().value) + size(poses.back().value));
  for (std::size_t i = 0; i < steps; ++i) {
    const std::size_t before = i > 0 ? i - 1 : i + 1, behind = i + 1 < steps ? i + 1 : i - 1;
    const Tangent<G> least =
        unexpected_step(poses, i, before, interval).cwiseMin(unexpected_step(poses, i, behind, interval));
    const Tangent<G> limit = (10 * usual[(std::min)(i, steps - 2)]).cwiseMax(rounding);
    if ((least.array() > limit.array()).any()) breaks.push_back(i);
  }
  return breaks;
}

}  // namespace splinertia::detail
