// SPDX-License-Identifier: MIT
// Samples and true poses go into the files that other programs read, and come back with the same bits.

#include <chrono>
#include <cstdio>
#include <splinertia/imu/presets.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/tum.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/time.hpp>

using namespace splinertia;

int main() {
  const Ellipse<> motion;
  const auto samples = simulate(motion, presets::euroc, {.rate = 200, .seed = 1, .start = 0.0, .end = 10.0});

  // A writer takes one sample at a time. Its file appears with commit(), complete, or not at all.
  EurocImuWriter imu("example_imu.csv");
  TumWriter poses("example_poses.tum");
  for (const auto& r : samples) {
    imu.append(r);
    poses.append(Stamped<SO3xR3<double>, double>{r.time, motion.evaluate<0>(r.time).value});
  }
  imu.commit();
  poses.commit();

  // Readers are strict: the first thing wrong is an exception with file and line. Times are in nanoseconds.
  const auto read = read_euroc_imu("example_imu.csv");
  bool same = read.size() == samples.size();
  std::size_t i = 0;
  for (const auto& r : samples) {
    same = same && read[i].time == to_nanoseconds(r.time) && read[i].gyro == r.gyro && read[i].accel == r.accel;
    ++i;
  }
  std::printf("example_imu.csv: %zu samples, the last at %lld ns, %s\n", read.size(),
              static_cast<long long>(read.back().time.count()), same ? "the same bits" : "not the same");
  std::printf("example_poses.tum: %zu poses\n", read_tum("example_poses.tum").size());
}

// prints
// example_imu.csv: 2001 samples, the last at 10000000000 ns, the same bits
// example_poses.tum: 2001 poses
