// SPDX-License-Identifier: MIT
// Any bytes as a TUM file.
#include <splinertia/io/tum.hpp>

#include "fuzz/samples.hpp"

namespace {

using namespace splinertia;

const fuzz::Target target{"tum", [](fuzz::Input input) {
                            static fuzz::InputBytes file("poses.txt");
                            fuzz::expect_round_trip(
                                file.with(input.rest()), [](const auto& path) { return read_tum(path); },
                                [](const auto& path, const auto& poses) { write_tum(path, poses); });
                          }};

}  // namespace
