// expect: the third part of an Imu is the ErrorModel of its stamps
#include <splinertia/imu/imu.hpp>
#include <splinertia/imu/white_noise.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{}, ErrorModel{}, ErrorModel{WhiteNoise{0.003}}};
