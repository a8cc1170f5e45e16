// expect: a term of the error model does not apply to a sensor with this number of axes and this scalar type
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/sensor_errors.hpp>
using namespace splinertia;
const auto sensor = sensor_errors<1, float>(ErrorModel{WhiteNoise{0.01}}, StreamKey(1));
