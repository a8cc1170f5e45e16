// SPDX-License-Identifier: MIT
// Any bytes as a trajectory: options, a line of columns, stamps up to a form feed if they are in a file of their own,
// and the file.
#include <splinertia/io/trajectory.hpp>
#include <splinertia/io/tum.hpp>

#include "fuzz/samples.hpp"

namespace splinertia::fuzz::trajectory_target {

const Target target{
    "trajectory", [](Input input) {
      static InputBytes file("trajectory.txt"), times("times.txt");
      TrajectoryFormat format;
      format.kind = static_cast<TrajectoryFormat::Kind>(input.integer(0, 7));
      if (const int order = input.integer(0, 2)) format.quaternion_order = static_cast<QuaternionOrder>(order - 1);
      if (const int unit = input.integer(0, 4)) format.time_unit = static_cast<TimeUnit>(3 * (unit - 1));
      const int stamps = input.integer(0, 3);
      if (stamps == 1) format.rate = input.real();
      format.skip_bad_rows = input.flag();
      format.columns = std::string(input.line());
      std::string_view text = input.rest();
      if (stamps == 2) {
        const std::string_view own = text.substr(0, text.find('\f'));
        text.remove_prefix(std::min(own.size() + 1, text.size()));
        format.times = times.with(own);
      }
      const std::string& path = file.with(text);
      const bool plain = format.kind == TrajectoryFormat::Kind::automatic && format.columns.empty() && stamps != 1 &&
                         stamps != 2 && !format.quaternion_order && !format.time_unit;
      TrajectoryFile read;
      if (!accepted(plain ? path : "", [&] { read = read_trajectory(path, format); })) return;
      expect_sane(read.poses);
      for (const auto* vectors : {&read.velocities, &read.gyro_biases, &read.accel_biases}) {
        expect(vectors->empty() || vectors->size() == read.poses.size(), vectors->size(), " vectors for ",
               read.poses.size(), " poses");
        for (const Eigen::Vector3d& vector : *vectors) expect_finite(vector, "a vector");
      }
      const std::string copy = output_path();
      write_tum(copy, read.poses);
      expect_same(read.poses, read_tum(copy));
      TrajectoryFile again;
      if (accepted(copy, [&] { again = read_trajectory(copy, {.kind = TrajectoryFormat::Kind::tum}); })) {
        expect_same(read.poses, again.poses);
      }
    }};

}  // namespace splinertia::fuzz::trajectory_target
