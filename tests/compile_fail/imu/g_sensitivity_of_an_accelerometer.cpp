// expect: the second part of an Imu is its accelerometer.s ErrorModel, but a term in it is for gyroscopes
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{}, ErrorModel{GSensitivity{Eigen::Matrix3d::Zero()}}};
