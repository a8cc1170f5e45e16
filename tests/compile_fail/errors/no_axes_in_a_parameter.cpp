// expect: a sensor has a fixed number of axes >= 1, which Eigen::Dynamic is not
#include <splinertia/errors/per_axis.hpp>
splinertia::PerAxis<double, Eigen::Dynamic> density(0.1);
