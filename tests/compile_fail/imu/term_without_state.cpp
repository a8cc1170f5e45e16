// expect: an error term needs a State: write .struct State \{\};
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
struct Bad {
  void apply(SensorSample<double>& sample, auto&) const { sample.value.setZero(); }
};
const ErrorModel model{Bad{}};
