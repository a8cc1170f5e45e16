// SPDX-License-Identifier: MIT
// A motion of your own is a type that gives its pose and derivatives at a time. This one is a swing: the IMU hangs 2 m
// below the pivot, and the angle is A sin(wt).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/simulate.hpp>

using namespace splinertia;

struct Swing {
  using Group = SO3xR3<double>;
  using Time = double;  // s

  double length = 2, amplitude = 0.5, frequency = 2;  // m, rad, rad/s

  double start() const { return 0; }
  double end() const { return 60; }

  /// The value and D derivatives: [rotation in the body; translation in the world].
  template <int D>
  Motion<Group, D> evaluate(double t) const {
    const double wave = std::sin(frequency * t), slope = std::cos(frequency * t);
    const double angle = amplitude * wave, rate = amplitude * frequency * slope;
    const double acceleration = -frequency * frequency * angle;
    const Eigen::Vector3d outwards(-std::sin(angle), 0, -std::cos(angle)), along(-std::cos(angle), 0, std::sin(angle));
    Motion<Group, D> m;
    m.value = {Sophus::SO3d::rotY(angle), length * outwards};
    if constexpr (D >= 1) m.velocity << 0, rate, 0, length * rate * along;
    if constexpr (D >= 2)
      m.acceleration << 0, acceleration, 0, length * (acceleration * along - rate * rate * outwards);
    return m;
  }
};
static_assert(Trajectory<Swing, 2>);

int main() {
  double least = 1e9, most = 0;
  for (const auto& r : simulate(Swing{}, Imu{}, {.rate = 1000})) {
    least = std::min(least, r.accel.z());
    most = std::max(most, r.accel.z());
  }
  // g cos(A) at the turning points, where it stands still; g + length (A w)^2 at the bottom.
  std::printf("specific force along the rope: %.3f to %.3f m/s^2\n", least, most);
  std::printf("expected:                      %.3f to %.3f m/s^2\n", 9.80665 * std::cos(0.5), 9.80665 + 2 * 1 * 1);
}

// prints
// specific force along the rope: 8.606 to 11.807 m/s^2
// expected:                      8.606 to 11.807 m/s^2
