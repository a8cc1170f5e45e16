// expect: an error term needs .void apply\(SensorSample<double>& sample, State& state\) const
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
struct Bad {
  struct State {};
  int count = 0;
  void apply(SensorSample<double>& sample, State&) { sample.value.x() += ++count; }
};
const ErrorModel model{Bad{}};
