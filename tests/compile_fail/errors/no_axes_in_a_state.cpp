// expect: a sensor has a fixed number of axes >= 1, which Eigen::Dynamic is not
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
using namespace splinertia;
auto state = ErrorModel{WhiteNoise{0.1}}.start<Eigen::Dynamic>(StreamKey(1));
