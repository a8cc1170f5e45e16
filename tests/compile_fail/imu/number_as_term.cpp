// expect: an error term needs a State
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
const ErrorModel model{0.015};
