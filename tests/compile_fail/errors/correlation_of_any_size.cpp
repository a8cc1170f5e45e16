// expect: a parameter of an error term is a number, or a vector or a matrix of fixed size
#include <splinertia/errors/noise/correlated_noise.hpp>
splinertia::CorrelatedNoise noise{0.1, Eigen::MatrixXd(Eigen::MatrixXd::Identity(3, 3))};
