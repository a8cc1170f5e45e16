// expect: the first part of an Imu is its gyroscope.s ErrorModel, but a term in it is for accelerometers
#include <splinertia/imu/errors/size_effect.hpp>
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{ErrorModel{SizeEffect{Eigen::Matrix3d::Zero()}}, ErrorModel{}};
