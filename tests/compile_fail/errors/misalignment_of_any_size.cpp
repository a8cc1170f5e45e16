// expect: a parameter of an error term is a number, or a vector or a matrix of fixed size
#include <splinertia/errors/scale/misalignment.hpp>
splinertia::Misalignment misalignment{Eigen::MatrixXd(Eigen::MatrixXd::Identity(3, 3))};
