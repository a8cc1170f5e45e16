// expect: deleted.*Sophus::SE3<double
#include <splinertia/group/sophus.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>
const std::vector<Sophus::SE3d> poses(4);
splinertia::Spline<Sophus::SO3d, 4> curve({0, 1}, poses);
