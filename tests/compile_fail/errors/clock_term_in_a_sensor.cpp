// expect: errors of time stamps \(ClockOffset, DroppedSamples
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/sensor_errors.hpp>
using namespace splinertia;
const auto sensor = sensor_errors<3>(ErrorModel{DroppedSamples{0.1}}, StreamKey(1));
