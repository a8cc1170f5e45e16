// SPDX-License-Identifier: MIT
#include <limits>
#include <span>
#include <splinertia/allan/detail/grouped_spectrum.hpp>
#include <vector>

#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

constexpr double all_counts = std::numeric_limits<double>::max();

PooledSpectrum<double> spectrum_of(std::size_t n) {
  const DifferenceSpectrum<double> spectrum(
      IntegratedSignal<double>(simulated({.n = n, .rate = 50, .white = 1, .seed = 1}), 50));
  return PooledSpectrum<double>(std::span(&spectrum, 1));
}

}  // namespace

TEST_CASE("Groups cover all bins that are used, once") {
  const auto spectrum = spectrum_of(20'000);
  const auto& bins = spectrum.bins();
  std::vector<bool> included(bins.size(), true);
  for (std::size_t i = 200; i < 230; ++i) included[i] = false;
  const GroupedSpectrum<double> grouped(spectrum, included, all_counts);
  std::size_t next = 0;
  double count = 0, power = 0;
  for (const auto& group : grouped.groups) {
    while (next < bins.size() && !included[next]) ++next;
    CHECK(group.begin == next);
    CHECK(group.end > group.begin);
    CHECK(bins[group.end - 1].frequency <= 1.1 * bins[group.begin].frequency);
    if (group.begin < 64) CHECK(group.end == group.begin + 1);
    for (std::size_t i = group.begin; i < group.end; ++i) {
      CHECK(included[i]);
      count += bins[i].count;
      power += bins[i].power;
    }
    next = group.end;
  }
  CHECK(next == bins.size());
  CHECK_THAT(grouped.count.sum(), WithinRel(count, 1e-12));
  CHECK_THAT(grouped.power.sum(), WithinRel(power, 1e-12));
  CHECK(grouped.groups.size() < bins.size() / 2);
}

TEST_CASE("The basis of a group is the mean over its coefficients") {
  const auto spectrum = spectrum_of(5000);
  const GroupedSpectrum<double> grouped(spectrum, std::vector<bool>(spectrum.bins().size(), true), all_counts);
  for (Eigen::Index g = 0; g < grouped.count.size(); ++g) {
    double sum = 0, count = 0;
    for (std::size_t i = grouped.group(g).begin; i < grouped.group(g).end; ++i) {
      sum += spectrum.bins()[i].count * spectrum.bins()[i].basis[2];
      count += spectrum.bins()[i].count;
    }
    CHECK_THAT(grouped.basis(g, 2), WithinRel(sum / count, 1e-12));
    CHECK_THAT(grouped.count[g], WithinRel(count, 1e-12));
    CHECK(grouped.share[g] == 1);
  }
}

TEST_CASE("A bin counts as no more than it may") {
  const auto spectrum = spectrum_of(20'000);
  const std::vector<bool> all(spectrum.bins().size(), true);
  const GroupedSpectrum<double> whole(spectrum, all, all_counts), bounded(spectrum, all, 4);
  for (Eigen::Index g = 0; g < whole.count.size(); ++g) {
    const auto bins = static_cast<double>(whole.group(g).end - whole.group(g).begin);
    CHECK(bounded.count[g] <= 4 * bins * (1 + 1e-12));
    CHECK_THAT(bounded.power[g] / bounded.count[g], WithinRel(whole.power[g] / whole.count[g], 1e-12));
  }
}
