// expect: an Imu has an ErrorModel for each sensor: Imu\{ErrorModel\{WhiteNoise
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/imu.hpp>
using namespace splinertia;
const Imu imu{WhiteNoise{0.015}, WhiteNoise{0.019}};
