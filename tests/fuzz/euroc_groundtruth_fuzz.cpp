// SPDX-License-Identifier: MIT
// Any bytes as EuRoC ground truth, of 17 columns and of 8 or 17.
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/tum.hpp>

#include "fuzz/samples.hpp"

namespace {

using namespace splinertia;

const fuzz::Target target{"euroc_groundtruth", [](fuzz::Input input) {
                            static fuzz::InputBytes file("groundtruth.csv");
                            const std::string& path = file.with(input.rest());
                            fuzz::expect_round_trip(
                                path, [](const auto& from) { return read_euroc_groundtruth(from); },
                                [&](const auto& to, const std::vector<EurocState>& states) {
                                  std::vector<Stamped<SO3xR3<double>>> poses;
                                  for (const EurocState& state : states) poses.push_back({state.time, state.pose});
                                  fuzz::expect_same(poses, read_euroc_poses(path));
                                  write_euroc_groundtruth(to, states);
                                });
                            // Without the columns behind the pose there is no writer of this format.
                            std::vector<Stamped<SO3xR3<double>>> poses;
                            if (!fuzz::accepted(path, [&] { poses = read_euroc_poses(path); })) return;
                            fuzz::expect_sane(poses);
                            const std::string copy = fuzz::output_path();
                            write_tum(copy, poses);
                            fuzz::expect_same(poses, read_tum(copy));
                          }};

}  // namespace
