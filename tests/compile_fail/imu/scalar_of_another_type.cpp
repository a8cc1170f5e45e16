// expect: the error terms use another scalar type than the motion
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
using namespace splinertia;
const auto run = simulate(Ellipse<float>{}, Imu{ErrorModel{WhiteNoise{0.015}}, ErrorModel{}}, {.rate = 200});
