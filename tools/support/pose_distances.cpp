// SPDX-License-Identifier: MIT
#include "support/pose_distances.hpp"

#include <algorithm>
#include <cmath>
#include <splinertia/time.hpp>

#include "support/formatted.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

nanoseconds longest_interval(const Poses& poses) {
  nanoseconds longest{0};
  for (std::size_t i = 1; i < poses.size(); ++i) longest = std::max(longest, poses[i].time - poses[i - 1].time);
  return longest;
}

double median_interval(const Poses& poses) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    intervals.push_back(to_seconds<double>(poses[i].time - poses[i - 1].time));
  }
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

PoseDistances distances(const Poses& curve, const Poses& poses) {
  PoseDistances result;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto &pose = poses[i].value, &value = curve[i].value;
    result.rotation.push_back(increment(rotation(pose), rotation(value)));
    result.position.push_back(position(value) - position(pose));
  }
  return result;
}

Lengths lengths(const std::vector<Eigen::Vector3d>& vectors, const std::vector<std::size_t>& but) {
  Lengths result;
  std::size_t count = 0;
  auto next = but.begin();
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (next != but.end() && *next == i) {
      ++next;
      continue;
    }
    ++count;
    result.rms += vectors[i].squaredNorm();
    result.max = std::max(result.max, vectors[i].norm());
  }
  if (count > 0) result.rms = std::sqrt(result.rms / static_cast<double>(count));
  return result;
}

std::vector<std::string> outlier_lines(const Poses& poses, const PoseDistances& distances,
                                       const std::vector<std::size_t>& outliers, std::size_t most) {
  constexpr std::size_t between = 5;
  struct Run {
    std::size_t first, last, count;
    double position, rotation;
  };
  std::vector<Run> runs;
  for (const std::size_t i : outliers) {
    if (runs.empty() || i > runs.back().last + 1 + between) runs.push_back({i, i, 0, 0, 0});
    Run& run = runs.back();
    run.last = i;
    ++run.count;
    run.position = std::max(run.position, distances.position[i].norm());
    run.rotation = std::max(run.rotation, distances.rotation[i].norm());
  }
  const std::size_t all = runs.size();
  if (all > most) {
    const double position_rms = lengths(distances.position).rms, rotation_rms = lengths(distances.rotation).rms;
    const auto badness = [&](const Run& run) {
      return std::max(run.position / position_rms, run.rotation / rotation_rms);
    };
    std::stable_sort(runs.begin(), runs.end(), [&](const Run& a, const Run& b) { return badness(a) > badness(b); });
    runs.resize(most);
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.first < b.first; });
  }
  std::vector<std::string> lines;
  const auto since_first = [&](std::size_t i) { return to_seconds<double>(poses[i].time - poses.front().time); };
  for (const Run& run : runs) {
    lines.push_back(run.first == run.last ? formatted("%.3f s", since_first(run.first))
                                          : formatted("%.3f - %.3f s", since_first(run.first), since_first(run.last)));
    lines.back() += formatted(" (%zu pose%s, up to %.2g m, %.2g rad)", run.count, run.count == 1 ? "" : "s",
                              run.position, run.rotation);
  }
  if (all > most) lines.push_back(formatted("and in %zu more runs with smaller deviations", all - most));
  return lines;
}
