// SPDX-License-Identifier: MIT
// Any bytes as a TUM file.
#include <splinertia/io/tum.hpp>

#include "fuzz/samples.hpp"

namespace splinertia::fuzz::tum_target {

const Target target{"tum", [](Input input) {
                      static InputBytes file("poses.txt");
                      expect_round_trip(
                          file.with(input.rest()), [](const auto& path) { return read_tum(path); },
                          [](const auto& path, const auto& poses) { write_tum(path, poses); });
                    }};

}  // namespace splinertia::fuzz::tum_target
