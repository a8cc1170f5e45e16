// expect: increments do not tell when the first of them began
// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/preintegration/preintegrate.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <vector>

using namespace splinertia;

auto f(const std::vector<ImuIncrement<>>& increments) { return preintegrate<TwoSampleIncrements>(increments).delta(); }
