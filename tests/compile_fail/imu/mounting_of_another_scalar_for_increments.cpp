// expect: the Mounting has another scalar type than the motion
#include <splinertia/imu/simulate_increments.hpp>
#include <splinertia/motion/ellipse.hpp>
using namespace splinertia;
const auto run = simulate_increments(Ellipse<>{}, Imu{}, Mounting<float>{});
