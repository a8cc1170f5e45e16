// expect: or it needs the truth of an IMU, as GSensitivity does
#include <splinertia/errors/sensor_errors.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
using namespace splinertia;
const auto sensor = sensor_errors<3>(ErrorModel{GSensitivity{Eigen::Matrix3d::Identity()}}, StreamKey(1));
