// expect: the first part of an Imu is its gyroscope.s ErrorModel
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{ClockOffset{0.003}}, ErrorModel{}};
