// expect: a sensor has a fixed number of axes >= 1, which Eigen::Dynamic is not
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/sensor_errors.hpp>
using namespace splinertia;
SensorErrors<ErrorModel<WhiteNoise<>>, Eigen::Dynamic> sensor(ErrorModel{WhiteNoise{0.1}}, StreamKey(1));
