// expect: Spline: orders 2 \(linear\) to 8 are supported
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/spline.hpp>
splinertia::Spline<Eigen::Vector3d, 1> curve({0, 1}, {});
