// expect: the noise of preintegration is an ImuNoise of the samples. scalar
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/preintegration/preintegrate.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

using namespace splinertia;

auto f(const std::vector<ImuSample<>>& samples) {
  return preintegrate<Midpoint>(samples, {}, GapOptions<double>{.longest = 0.5}).delta();
}
