// expect: a sensor has an ErrorModel: SensorErrors\(ErrorModel\{WhiteNoise
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/sensor_errors.hpp>
using namespace splinertia;
const SensorErrors sensor(WhiteNoise{0.02}, StreamKey(1));
