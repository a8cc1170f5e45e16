// expect: or are not for sensors with three axes
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
using namespace splinertia;
const ErrorModel gyro{Misalignment{Eigen::Matrix2d::Identity()}};
const auto run = simulate(Ellipse<>{}, Imu{gyro, ErrorModel{}}, {.rate = 200});
