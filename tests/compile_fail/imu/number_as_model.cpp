// expect: the first part of an Imu is its gyroscope.s ErrorModel
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{0.015, 0.019};
