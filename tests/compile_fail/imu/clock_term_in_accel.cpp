// expect: the second part of an Imu is its accelerometer.s ErrorModel
#include <splinertia/imu/imu.hpp>
#include <splinertia/imu/stamp_jitter.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{}, ErrorModel{StampJitter{0.003}}};
