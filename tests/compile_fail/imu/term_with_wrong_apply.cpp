// expect: an error term needs .void apply\(SensorSample<double>& sample, State& state\) const
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
struct Bad {
  struct State {};
  void apply(Eigen::Vector3<double>& reading, State&) const { reading.setZero(); }
};
const ErrorModel model{Bad{}};
