// expect: the errors of an IMU are an Imu
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
using namespace splinertia;
const auto samples = simulate(Ellipse<>{}, WhiteNoise{0.1}, {.rate = 200, .start = 0.0, .end = 1.0});
