// expect: the third part of an Imu is the ErrorModel of its stamps
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{}, ErrorModel{}, ErrorModel{WhiteNoise{0.003}}};
