// expect: the Mounting has another scalar type than the motion
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
using namespace splinertia;
const auto run = simulate(Ellipse<>{}, Imu{}, Mounting<float>{});
