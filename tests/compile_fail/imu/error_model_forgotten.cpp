// expect: an Imu has an ErrorModel for each sensor: Imu\{ErrorModel\{WhiteNoise
#include <splinertia/imu/imu.hpp>
#include <splinertia/imu/white_noise.hpp>
using namespace splinertia;
const Imu imu{WhiteNoise{0.015}, WhiteNoise{0.019}};
