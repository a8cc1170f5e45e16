// expect: a parameter of an error term is a number, or a vector or a matrix of fixed size
#include <splinertia/errors/noise/white_noise.hpp>
splinertia::WhiteNoise noise{Eigen::VectorXd(Eigen::VectorXd::Ones(3))};
