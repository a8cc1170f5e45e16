// expect: a parameter of an error term has one value for each of N axes, but the sensor has another number of axes
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/sensor_errors.hpp>
using namespace splinertia;
SensorErrors barometer(ErrorModel{WhiteNoise{PerAxis(0.1, 0.1, 0.3)}}, StreamKey(1));
const auto reading = barometer.apply(0, 120, 0.1);
