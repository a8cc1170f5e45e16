// expect: the second part of an Imu is its accelerometer.s ErrorModel
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{}, ErrorModel{StampJitter{0.003}}};
