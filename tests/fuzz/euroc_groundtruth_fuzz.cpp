// SPDX-License-Identifier: MIT
// Any bytes as EuRoC ground truth, of 17 columns and of 8 or 17.
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/tum.hpp>

#include "fuzz/samples.hpp"

namespace splinertia::fuzz::euroc_groundtruth_target {

const Target target{"euroc_groundtruth", [](Input input) {
                      static InputBytes file("groundtruth.csv");
                      const std::string& path = file.with(input.rest());
                      expect_round_trip(
                          path, [](const auto& from) { return read_euroc_groundtruth(from); },
                          [&](const auto& to, const std::vector<EurocState>& states) {
                            std::vector<Stamped<SO3xR3<double>>> poses;
                            for (const EurocState& state : states) poses.push_back({state.time, state.value});
                            expect_same(poses, read_euroc_poses(path));
                            write_euroc_groundtruth(to, states);
                          });
                      // Without the columns behind the pose there is no writer of this format.
                      std::vector<Stamped<SO3xR3<double>>> poses;
                      if (!accepted(path, [&] { poses = read_euroc_poses(path); })) return;
                      expect_sane(poses);
                      const std::string copy = output_path();
                      write_tum(copy, poses);
                      expect_same(poses, read_tum(copy));
                    }};

}  // namespace splinertia::fuzz::euroc_groundtruth_target
