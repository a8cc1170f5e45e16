// expect: an ErrorModel holds the terms of either a sensor or a clock
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
using namespace splinertia;
const ErrorModel model{WhiteNoise{0.015}, ClockOffset{0.003}};
