// expect: an ErrorModel has the terms of one sensor or of one clock
#include <splinertia/imu/clock_offset.hpp>
#include <splinertia/imu/error_model.hpp>
#include <splinertia/imu/white_noise.hpp>
using namespace splinertia;
const ErrorModel model{WhiteNoise{0.015}, ClockOffset{0.003}};
