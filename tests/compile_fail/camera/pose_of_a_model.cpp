// expect: a camera model differentiates by Wrt::point and Wrt::parameters
#include <splinertia/camera/pinhole.hpp>
using namespace splinertia;
const Pinhole<NoDistortion<double>> camera(460, 460, 320, 240, {});
const auto pixel = camera.linearize<Wrt::pose>(Eigen::Vector3d(0, 0, 1));
