// expect: the errors of an IMU are an Imu
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/imu_errors.hpp>
using namespace splinertia;
const ImuErrors errors(ErrorModel{WhiteNoise{0.02}}, StreamKey(1));
